//! What the bubbles have done lately, as the far field must know it: sound takes its time from them to the sides.

use std::collections::VecDeque;

use mesh::{Domain, Side};
use serde::{Deserialize, Serialize};

use super::FarField;
use crate::{Boundary, Bubble, BubbleCuts};

/// Samples are this share of the time apart that sound takes to the nearest open side.
const INTERVAL: f64 = 0.02;

/// Where the bubbles were and how large, at one time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
struct Sample {
    time: f64,
    /// Volume, m³, and mean z, m, of each bubble, the lowest first.
    bubbles: Vec<[f64; 2]>,
}

/// How a bubble moves and grows.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Motion {
    /// How far it has moved since the start, m.
    pub moved: f64,
    /// The first and the second derivative of its volume, m³/s and m³/s².
    pub rate: f64,
    pub acceleration: f64,
}

/// The volumes and places of the bubbles, back to when sound left them that reaches the farthest face now.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct SourceHistory {
    /// How they are told apart.
    pub cuts: BubbleCuts,
    /// Between two samples, s, and how long they are kept, s.
    interval: f64,
    span: f64,
    /// The bubbles' mean z at t = 0, m.
    start: Vec<f64>,
    samples: VecDeque<Sample>,
}

impl SourceHistory {
    /// Of the bubbles of a far field in a domain; none yet.
    pub fn new(far_field: &FarField, domain: &Domain, boundaries: [Boundary; 4]) -> Self {
        let open = Side::ALL.into_iter().filter(|side| boundaries[*side as usize] == Boundary::FarField);
        let nearest = open.map(|side| far_field.distance(domain, side)).fold(f64::INFINITY, f64::min);
        // Images are as far beyond the wall as the bubbles are above it.
        let farthest = domain.r[1].hypot(2.0 * (domain.z[1] - domain.z[0]));
        let sound = far_field.incident.sound();
        Self {
            cuts: far_field.cuts.clone(),
            interval: INTERVAL * nearest / sound,
            span: farthest / sound,
            ..Self::default()
        }
    }

    /// Whether the next sample is due.
    pub fn is_due(&self, time: f64) -> bool {
        self.interval > 0.0 && self.samples.back().is_none_or(|last| time >= last.time + self.interval)
    }

    /// Takes a sample of the bubbles, as [`SourceHistory::cuts`] tell them apart.
    pub fn sample(&mut self, time: f64, bubbles: &[Bubble]) {
        let last = self.samples.back();
        // A bubble that is gone is where it was.
        let place = |k: usize, bubble: &Bubble| {
            if bubble.volume > 0.0 { bubble.centroid_z } else { last.map_or(0.0, |last| last.bubbles[k][1]) }
        };
        let bubbles = bubbles.iter().enumerate().map(|(k, bubble)| [bubble.volume, place(k, bubble)]);
        let sample = Sample { time, bubbles: bubbles.collect() };
        if self.samples.is_empty() {
            self.start = sample.bubbles.iter().map(|[_, z]| *z).collect();
        }
        self.samples.push_back(sample);
        while self.samples.get(1).is_some_and(|second| second.time < time - self.span) {
            self.samples.pop_front();
        }
    }

    /// How a bubble moved and grew at a time; `None` before the start.
    pub fn at(&self, bubble: usize, time: f64) -> Option<Motion> {
        let after = self.samples.partition_point(|sample| sample.time <= time);
        if after == 0 || self.samples.len() < 2 {
            return None;
        }
        let after = after.min(self.samples.len() - 1);
        let [[t0, _, z0], [t1, _, z1]] = [after - 1, after].map(|k| self.row(k, bubble));
        let share = ((time - t0) / (t1 - t0)).min(1.0);
        // The rates belong to the middles between samples.
        let nearer = if share < 0.5 { (after - 1).max(1) } else { (after + 1).min(self.samples.len() - 1) };
        let ((middle, rate), (other, other_rate)) = (self.rate(after, bubble), self.rate(nearer, bubble));
        let acceleration = if nearer == after { 0.0 } else { (other_rate - rate) / (other - middle) };
        Some(Motion {
            moved: z0 + share * (z1 - z0) - self.start[bubble],
            rate: rate + (time.min(t1) - middle) * acceleration,
            acceleration,
        })
    }

    /// Time, volume and place of a bubble in a sample.
    fn row(&self, sample: usize, bubble: usize) -> [f64; 3] {
        let Sample { time, bubbles } = &self.samples[sample];
        [*time, bubbles[bubble][0], bubbles[bubble][1]]
    }

    /// How fast a volume changed between a sample and the one before, and the time in the middle.
    fn rate(&self, sample: usize, bubble: usize) -> (f64, f64) {
        let [[t0, v0, _], [t1, v1, _]] = [sample - 1, sample].map(|k| self.row(k, bubble));
        (0.5 * (t0 + t1), (v1 - v0) / (t1 - t0))
    }
}
