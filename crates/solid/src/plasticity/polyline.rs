//! The return in closed form: flow stresses that are straight between points, without rate.

use mesh::Blend;
use multiversion::multiversion;

use super::hardening::Hardening;
use super::stress::Stress;

/// Cells that go through the points of a table together (SIMD batches).
const LANES: usize = 16;

/// A table over an elasticity.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Polyline {
    /// From each point to the next; a flat one before the first.
    segments: Vec<Segment>,
    /// Pa.
    three_mu: f64,
}

/// A straight part of the flow stress.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Segment {
    /// ε_p where it begins, and Y there, Pa.
    strain: f64,
    stress: f64,
    /// H = dY/dε_p, Pa.
    modulus: f64,
    /// 3μ ε_p + Y where it begins, Pa: returns end on it where q_trial + 3μ ε_p is no less.
    reach: f64,
    /// 1/(3μ + H), 1/Pa.
    compliance: f64,
}

impl Segment {
    /// Y at a plastic strain, Pa.
    #[inline(always)]
    fn stress_at(&self, strain: f64) -> f64 {
        self.stress + self.modulus * (strain - self.strain)
    }

    /// This one where a condition holds, another one otherwise; of that the reach, which no return needs.
    #[inline(always)]
    fn or(&self, blend: Blend, holds: bool, other: Self) -> Self {
        Self {
            strain: blend.choose(holds, self.strain, other.strain),
            stress: blend.choose(holds, self.stress, other.stress),
            modulus: blend.choose(holds, self.modulus, other.modulus),
            reach: other.reach,
            compliance: blend.choose(holds, self.compliance, other.compliance),
        }
    }
}

/// What a return of cells gives.
struct Returns<const L: usize> {
    /// Of the trial's deviator, what is left.
    left_share: [f64; L],
    /// q at the end, Pa.
    von_mises: [f64; L],
    /// Positive where a cell yields; nothing else means anything otherwise.
    increment: [f64; L],
}

impl<const L: usize> Returns<L> {
    #[inline(always)]
    fn yields(&self, k: usize) -> bool {
        // Inside of its surface a cell is on no segment beyond its own, and that one's line or an earlier one's lies above it.
        self.increment[k] > 0.0
    }
}

impl Polyline {
    /// Of a table without a rate's factor.
    pub fn new(hardening: &Hardening, mu: f64) -> Option<Self> {
        let Hardening::Table(table) = hardening else { return None };
        if table.rate().acts() {
            return None;
        }
        let points: Vec<[f64; 2]> = table.points().collect();
        let three_mu = 3.0 * mu;
        let segment = |[strain, stress]: [f64; 2], modulus| Segment {
            strain,
            stress,
            modulus,
            reach: three_mu * strain + stress,
            compliance: 1.0 / (three_mu + modulus),
        };
        let slope = |a: [f64; 2], b: [f64; 2]| (b[1] - a[1]) / (b[0] - a[0]);
        let before = segment([0.0, points.first()?[1]], 0.0);
        let between = points.windows(2).map(|pair| segment(pair[0], slope(pair[0], pair[1])));
        let beyond = segment(*points.last()?, 0.0);
        Some(Self { segments: [before].into_iter().chain(between).chain([beyond]).collect(), three_mu })
    }

    /// The return of cells with these q of their trial stresses (Pa) and plastic strains.
    #[inline(always)]
    fn returns<const L: usize>(&self, trial: &[f64; L], strain: &[f64; L]) -> Returns<L> {
        let reach: [f64; L] = std::array::from_fn(|k| trial[k] + self.three_mu * strain[k]);
        let (first, further) = (&self.segments[0], &self.segments[1..]);
        // As a rule cells beside each other end on one.
        let before = further.iter().take_while(|segment| reach[0] >= segment.reach).count();
        let own = self.segments[before];
        let begins = if before > 0 { own.reach } else { f64::NEG_INFINITY };
        let ends = further.get(before).map_or(f64::INFINITY, |next| next.reach);
        if reach.iter().fold(true, |alike, reach| alike & (*reach >= begins) & (*reach < ends)) {
            return self.returns_on(trial, strain, |_| own);
        }
        let (mut end, blend) = ([*first; L], Blend::new());
        for segment in further {
            for k in 0..L {
                end[k] = segment.or(blend, reach[k] >= segment.reach, end[k]);
            }
        }
        self.returns_on(trial, strain, |k| end[k])
    }

    /// The same, free of branches, of cells whose returns end on segments that are known.
    ///
    /// From ε = max(ε_p, where the segment begins) with Y = Y(ε),
    ///
    /// Δε_p = ε − ε_p + (q_trial − 3μ (ε − ε_p) − Y)/(3μ + H).
    #[inline(always)]
    fn returns_on<const L: usize>(
        &self,
        trial: &[f64; L],
        strain: &[f64; L],
        end: impl Fn(usize) -> Segment,
    ) -> Returns<L> {
        let (mut left_share, mut von_mises, mut increment) = ([0.0; L], [0.0; L], [0.0; L]);
        for k in 0..L {
            let (q, end) = (trial[k], end(k));
            let from = if end.strain > strain[k] { end.strain } else { strain[k] };
            let ahead = from - strain[k];
            increment[k] = ahead + (q - self.three_mu * ahead - end.stress_at(from)) * end.compliance;
            let line = end.stress_at(strain[k] + increment[k]);
            // Rounding must not put a stress that just yields outside of where it was.
            von_mises[k] = if line < q { line } else { q };
            left_share[k] = von_mises[k] / q;
        }
        Returns { left_share, von_mises, increment }
    }

    /// Δε_p and q at the end, Pa, of one cell; `None` where it stays elastic. Bitwise what [`return_batch`] makes of it.
    pub fn single(&self, trial: f64, strain: f64) -> Option<(f64, f64)> {
        let returns = self.returns(&[trial], &[strain]);
        returns.yields(0).then_some((returns.increment[0], returns.von_mises[0]))
    }

    /// Returns the stresses of cells with these plastic strains; `None` where all lie within what the curve begins with, nothing happens
    /// then.
    #[inline(always)]
    fn return_stresses<const L: usize>(
        &self,
        zz: &mut [f64; L],
        zr: &mut [f64; L],
        rr: &mut [f64; L],
        phiphi: &mut [f64; L],
        strain: &[f64; L],
    ) -> Option<Returns<L>> {
        let cell = |k: usize| Stress { zz: zz[k], zr: zr[k], rr: rr[k], phiphi: phiphi[k] };
        let squared: [f64; L] = std::array::from_fn(|k| cell(k).von_mises_squared());
        let bound = self.segments[0].stress;
        let within = squared.iter().fold(true, |within, squared| within & (*squared <= bound * bound));
        if within {
            return None;
        }
        let (returns, blend) = (self.returns(&squared.map(f64::sqrt), strain), Blend::new());
        for k in 0..L {
            let old = Stress { zz: zz[k], zr: zr[k], rr: rr[k], phiphi: phiphi[k] };
            let new = old.with_deviator_times(returns.left_share[k]).or(blend, returns.yields(k), old);
            (zz[k], zr[k], rr[k], phiphi[k]) = (new.zz, new.zr, new.rr, new.phiphi);
        }
        Some(returns)
    }
}

/// The returns of some cells, rows as in [`super::PlasticRows`]; tells how many flowed.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
#[expect(clippy::too_many_arguments, reason = "slices in a struct lose noalias; the fluid has measured it")]
pub(super) fn return_batch(
    law: &Polyline,
    zz: &mut [f64],
    zr: &mut [f64],
    rr: &mut [f64],
    phiphi: &mut [f64],
    strain: &mut [f64],
    increment: &mut [f64],
    work: &mut [f64],
) -> usize {
    let (n, mut count) = (strain.len(), 0);
    let whole = n - n % LANES;
    for at in (0..whole).step_by(LANES) {
        count += return_part::<LANES>(law, at, zz, zr, rr, phiphi, strain, increment, work);
    }
    for at in whole..n {
        count += return_part::<1>(law, at, zz, zr, rr, phiphi, strain, increment, work);
    }
    count as usize
}

/// The returns of so many cells from number `at` on.
#[expect(clippy::too_many_arguments, reason = "slices in a struct lose noalias; the fluid has measured it")]
#[inline(always)]
fn return_part<const L: usize>(
    law: &Polyline,
    at: usize,
    zz: &mut [f64],
    zr: &mut [f64],
    rr: &mut [f64],
    phiphi: &mut [f64],
    strain: &mut [f64],
    increment: &mut [f64],
    work: &mut [f64],
) -> u64 {
    let [strain, increment, work] = [strain, increment, work].map(|row| part::<L>(row, at));
    let returns = law.return_stresses(part(zz, at), part(zr, at), part(rr, at), part(phiphi, at), strain);
    let Some(returns) = returns else {
        (*increment, *work) = ([0.0; L], [0.0; L]);
        return 0;
    };
    let (mut count, blend) = (0, Blend::new());
    for k in 0..L {
        let select = |new: f64, old: f64| blend.choose(returns.yields(k), new, old);
        strain[k] = select(strain[k] + returns.increment[k], strain[k]);
        increment[k] = select(returns.increment[k], 0.0);
        work[k] = select(returns.von_mises[k] * returns.increment[k], 0.0);
        count += u64::from(returns.yields(k));
    }
    count
}

/// Their stresses alone; plastic strains below zero count as none.
#[multiversion(targets("x86_64+avx512f+avx512vl+avx512dq+fma+bmi2", "x86_64+avx2+fma+bmi2"))]
pub(super) fn return_stresses(
    law: &Polyline,
    zz: &mut [f64],
    zr: &mut [f64],
    rr: &mut [f64],
    phiphi: &mut [f64],
    strain: &[f64],
) {
    let (whole, rest) = strain.as_chunks::<LANES>();
    for (number, strain) in whole.iter().enumerate() {
        let (at, strain) = (number * LANES, strain.map(|strain| strain.max(0.0)));
        law.return_stresses(part(zz, at), part(zr, at), part(rr, at), part(phiphi, at), &strain);
    }
    for (number, strain) in rest.iter().enumerate() {
        let (at, strain) = (whole.len() * LANES + number, [strain.max(0.0)]);
        law.return_stresses(part(zz, at), part(zr, at), part(rr, at), part(phiphi, at), &strain);
    }
}

/// So many cells of a row from number `at` on.
#[inline(always)]
fn part<const L: usize>(row: &mut [f64], at: usize) -> &mut [f64; L] {
    row[at..].first_chunk_mut().expect("rows of unequal length panic")
}
