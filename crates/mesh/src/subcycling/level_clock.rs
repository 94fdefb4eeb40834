//! Which levels step when: subcycling in time.

/// A step that a group of levels is about to make.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GroupStep {
    /// The group's number, from the coarsest on.
    pub group: usize,
    /// When it begins, s.
    pub begin: f64,
    /// Its length, s.
    pub dt: f64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Span {
    begin: f64,
    dt: f64,
    end: f64,
}

/// Groups of levels, each with steps of its own, within one step of the whole.
///
/// Group 0 has the levels up to `base`, each further level is a group of its own. A group makes its step before the next
/// finer one makes as many as it needs within it. That one asks again before each of its steps how many are left: so
/// steps stay within their limits while speeds change, and ratios may be any whole numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct LevelClock {
    base: u8,
    now: f64,
    whole: Option<Span>,
    spans: Vec<Span>,
}

/// A step may be this much longer than its limit, rather than that one more is made: of levels that differ by two in
/// width the limits hardly ever differ by exactly two.
const TOLERANCE: f64 = 1.05;

/// Into how many equal steps a time is divided if none may be longer than `limit`, but for a tolerance of 5 %; at least one.
pub fn steps_in(time: f64, limit: f64) -> f64 {
    (time / (TOLERANCE * limit)).ceil().max(1.0)
}

impl LevelClock {
    /// Begins a step of length `dt` of levels up to `finest`.
    pub fn begin(&mut self, base: u8, finest: u8, now: f64, dt: f64) {
        let past = Span { begin: now, dt: 0.0, end: now };
        self.base = base;
        self.now = now;
        self.whole = Some(Span { begin: now, dt, end: now + dt });
        self.spans.clear();
        self.spans.resize(1 + usize::from(finest.saturating_sub(base)), past);
    }

    /// The group of a level.
    pub fn group(&self, level: u8) -> usize {
        usize::from(level.saturating_sub(self.base)).min(self.spans.len().saturating_sub(1))
    }

    /// How many groups there are.
    pub fn groups(&self) -> usize {
        self.spans.len()
    }

    /// The number of the finest group.
    pub fn finest(&self) -> usize {
        self.spans.len() - 1
    }

    /// The time that the finest group has reached, s.
    pub fn now(&self) -> f64 {
        self.now
    }

    /// Whether the whole step has been made.
    pub fn is_over(&self) -> bool {
        self.whole.is_none_or(|whole| self.now >= whole.end)
    }

    /// The coarsest group whose next step is due; `None` once all are under way, or over.
    pub fn due(&self) -> Option<usize> {
        if self.is_over() { None } else { self.spans.iter().position(|span| span.end <= self.now) }
    }

    /// Starts the next step of the group that is due.
    ///
    /// - `limit`: how long it may be, s; what is left of the coarser group's step is divided into as few equal steps as
    ///   that allows, but for a tolerance.
    ///
    /// # Panics
    /// If none is due.
    pub fn start(&mut self, limit: f64) -> GroupStep {
        let group = self.due().expect("a group is due");
        let around = if group == 0 { self.whole.expect("a step has begun") } else { self.spans[group - 1] };
        let left = if around.begin == self.now { around.dt } else { around.end - self.now };
        let steps = steps_in(left, limit);
        let (dt, end) =
            if steps == 1.0 { (left, around.end) } else { (left / steps, self.now + left / steps) };
        self.spans[group] = Span { begin: self.now, dt, end };
        GroupStep { group, begin: self.now, dt }
    }

    /// Takes notice that the finest group has made its step.
    pub fn advance(&mut self) {
        self.now = self.spans[self.finest()].end;
    }

    /// Whether the present step of a group ends with the whole.
    pub fn is_last(&self, group: usize) -> bool {
        self.whole.is_some_and(|whole| self.spans[group].end == whole.end)
    }

    /// When the present step of a group ends, s.
    pub fn end(&self, group: usize) -> f64 {
        self.spans[group].end
    }

    /// The length of a group's present step, s.
    pub fn length(&self, group: usize) -> f64 {
        self.spans[group].dt
    }

    /// The middle of a group's present or last step, s.
    pub fn middle(&self, group: usize) -> f64 {
        self.spans[group].begin + 0.5 * self.spans[group].dt
    }

    /// What the present step of a group counts in the running mean over the coarser group's step; 1 if it is the first.
    pub fn weight(&self, group: usize) -> f64 {
        let span = self.spans[group];
        match group.checked_sub(1).map(|coarser| self.spans[coarser]) {
            Some(around) if around.begin < span.begin => span.dt / (span.end - around.begin),
            _ => 1.0,
        }
    }

    /// The share of what is left of a group's present step that passes until `later`.
    pub fn share_until(&self, group: usize, later: f64) -> f64 {
        (later - self.now) / (self.spans[group].end - self.now)
    }

    /// When the finest group's present step ends, s.
    pub fn next(&self) -> f64 {
        self.spans[self.finest()].end
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The steps that are made within a whole one of length `dt` if group g may make steps of `limit(g, number)`.
    fn steps(base: u8, finest: u8, dt: f64, limit: impl Fn(usize, usize) -> f64) -> Vec<GroupStep> {
        let mut clock = LevelClock::default();
        clock.begin(base, finest, 1.0, dt);
        let mut made = Vec::new();
        while !clock.is_over() {
            while let Some(group) = clock.due() {
                made.push(clock.start(limit(group, made.len())));
            }
            clock.advance();
        }
        assert_eq!(clock.now(), 1.0 + dt);
        made
    }

    #[test]
    fn levels_halve_their_steps_and_the_coarser_goes_first() {
        let made = steps(3, 5, 8.0, |group, _| 8.0 / f64::from(1 << group));
        let order: Vec<(usize, f64, f64)> = made.iter().map(|s| (s.group, s.begin, s.dt)).collect();
        assert_eq!(
            order,
            [
                (0, 1.0, 8.0),
                (1, 1.0, 4.0),
                (2, 1.0, 2.0),
                (2, 3.0, 2.0),
                (1, 5.0, 4.0),
                (2, 5.0, 2.0),
                (2, 7.0, 2.0)
            ]
        );
    }

    #[test]
    fn one_group_makes_the_whole_step_to_the_last_bit() {
        let dt = 0.1 + 0.2;
        assert_eq!(steps(4, 4, dt, |_, _| f64::INFINITY), [GroupStep { group: 0, begin: 1.0, dt }]);
    }

    #[test]
    fn limits_that_shrink_on_the_way_make_more_steps() {
        // After the first fine step speeds double.
        let made = steps(0, 1, 2.0, |group, made| {
            if group == 0 {
                2.0
            } else if made < 2 {
                1.0
            } else {
                0.4
            }
        });
        let fine: Vec<f64> = made.iter().filter(|step| step.group == 1).map(|step| step.dt).collect();
        assert_eq!(fine.len(), 4);
        assert_eq!(fine[0], 1.0);
        assert!(fine[1..].iter().all(|dt| (dt - 1.0 / 3.0).abs() < 1e-15), "{fine:?}");
        // A limit that is hardly passed is none.
        assert_eq!(steps(0, 1, 2.0, |group, _| if group == 0 { 2.0 } else { 0.97 }).len(), 3);
    }

    #[test]
    fn weights_make_the_running_mean_a_mean() {
        let mut clock = LevelClock::default();
        clock.begin(0, 1, 0.0, 1.0);
        let limits = [1.0, 0.4, 0.3, 0.11];
        let (mut mean, mut integral, mut made) = (0.0, 0.0, 0);
        while !clock.is_over() {
            while clock.due().is_some() {
                let step = clock.start(limits[made.min(3)]);
                if step.group == 1 {
                    let value = 3.0 + (made as f64).sin();
                    integral += step.dt * value;
                    mean += clock.weight(1) * (value - mean);
                }
                made += 1;
            }
            clock.advance();
        }
        assert!(made > 5);
        assert!((mean - integral).abs() < 1e-15, "{mean} {integral}");
    }
}
