//! Lab.
#![allow(missing_docs)]
use std::sync::OnceLock;
#[derive(Debug)]
pub struct Knobs { pub mid: f64, pub lm: f64, pub vel: f64, pub weight: f64, pub normal: f64, pub a: f64, pub b: f64, pub c: f64 }
pub fn knobs() -> &'static Knobs {
    static K: OnceLock<Knobs> = OnceLock::new();
    K.get_or_init(|| {
        let of = |n: &str| std::env::var(n).ok().map_or(0.0, |v| v.parse().unwrap());
        Knobs { mid: of("K_MID"), lm: of("K_LM"), vel: of("K_VEL"), weight: of("K_WEIGHT"), normal: of("K_NORMAL"), a: of("K_A"), b: of("K_B"), c: of("K_C") }
    })
}
