//! How long the stages of a step take.

use std::time::{Duration, Instant};

/// One block of so many is timed: reading the clock between stages would else cost two percent of a step.
const TIMED: u64 = 32;

/// The most stages that a step may have.
const MOST_STAGES: usize = 12;

/// Times of the stages of blocks' steps in one thread, from a sample of the blocks.
#[derive(Clone, Debug, Default)]
pub struct StageTimer {
    times: [Duration; MOST_STAGES],
    blocks: u64,
    timed: u64,
    /// When the present stage began, if this block is timed.
    began: Option<Instant>,
}

impl StageTimer {
    /// A block begins its step.
    pub fn begin(&mut self) {
        self.began = self.blocks.is_multiple_of(TIMED).then(Instant::now);
        self.timed += u64::from(self.began.is_some());
        self.blocks += 1;
    }

    /// A stage has ended, and the next one begins.
    pub fn end(&mut self, stage: usize) {
        if let Some(began) = &mut self.began {
            let now = Instant::now();
            self.times[stage] += now - *began;
            *began = now;
        }
    }

    /// What the stages of all blocks have taken, as the sample tells, s.
    pub fn seconds(&self, stage: usize) -> f64 {
        self.times[stage].as_secs_f64() * self.blocks as f64 / self.timed.max(1) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_stands_for_all_blocks() {
        let mut timer = StageTimer::default();
        for block in 0..3 * TIMED {
            timer.begin();
            if block.is_multiple_of(TIMED) {
                std::thread::sleep(Duration::from_millis(2));
            }
            timer.end(0);
            timer.end(1);
        }
        let least = 2e-3 * 3.0 * TIMED as f64;
        assert!(timer.seconds(0) >= least, "{} s", timer.seconds(0));
        assert!(timer.seconds(1) < 0.5 * timer.seconds(0));
        assert_eq!(timer.seconds(2), 0.0);
    }
}
