pub struct FluidTrace { pub pressure: f64, pub velocity: f64, pub density: f64, pub gamma: f64, pub pi: f64 }
pub fn star_density(f: &FluidTrace, p: f64) -> f64 { f.density * ((p + f.pi) / (f.pressure + f.pi)).powf(1.0 / f.gamma) }
