//! The largest of some means on the faces of a wall.

use serde::{Deserialize, Serialize};
use serde_json::{Map, Value, json};

use crate::run::side::wall_faces::WallFaces;

/// The largest so far, where and when.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct WallPeak {
    /// On any face.
    pub value: f64,
    /// In the middle of that face, m.
    pub position: f64,
    /// At the end of that step, s.
    pub time: f64,
}

impl WallPeak {
    /// Before the first step.
    pub fn of(value: f64) -> Self {
        Self { value, position: 0.0, time: 0.0 }
    }

    /// Takes notice of a step that ended at `time` with these means on the faces; `exceeds` compares one of them with the largest so far.
    pub fn after_step(
        &mut self,
        faces: &WallFaces,
        means: &[f64],
        time: f64,
        exceeds: impl Fn(f64, f64) -> bool,
    ) {
        let mut low = faces.begin();
        for (edge, mean) in faces.edges().iter().zip(means) {
            if exceeds(*mean, self.value) {
                *self = Self { value: *mean, position: 0.5 * (low + edge), time };
            }
            low = *edge;
        }
    }

    /// Its part of the summary: `name`, `name_position`, `name_time`.
    pub fn summary(&self, name: &str) -> Map<String, Value> {
        let Self { value, position, time } = self;
        let parts = [("", value), ("_position", position), ("_time", time)];
        parts.into_iter().map(|(end, number)| (format!("{name}{end}"), json!(number))).collect()
    }
}
