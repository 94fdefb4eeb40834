//! The waves of which a case says how they run: what would pass over the open sides if there were no bubbles.

use mesh::{Domain, Side};

use crate::{Boundary, InitialCondition, NobleAbelStiffenedGas, PressureHistory, Pulse, PulseShape};

/// What waves have at a point: pressure above the ambient one, Pa, and velocity (z, r), m/s.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Wave {
    pub pressure: f64,
    pub velocity: [f64; 2],
}

/// The pulses of the initial condition, what enters through an inflow side, and their images in a wall, by linear acoustics.
///
/// The far field is that of flow from the bubbles. A wave that comes from elsewhere has no afterflow, or another one, and must not
/// be taken for theirs.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Incident {
    pulses: Vec<Pulse>,
    inflow: Option<Entering>,
    /// c, m/s; ρc, Pa s/m.
    sound: f64,
    impedance: f64,
}

/// A plane wave from z_min or z_max.
#[derive(Clone, Debug, PartialEq)]
struct Entering {
    history: PressureHistory,
    ambient: f64,
    /// Where it enters, and its direction along z, ±1.
    from: f64,
    direction: f64,
    /// Where it is reflected, and how much of its pressure.
    wall: Option<(f64, f64)>,
}

impl Incident {
    /// - `wall`: where waves are reflected, m, and how much of their pressure.
    pub fn of(
        initial: &InitialCondition,
        liquid: NobleAbelStiffenedGas,
        domain: &Domain,
        boundaries: [Boundary; 4],
        inflow: Option<&PressureHistory>,
        wall: Option<(f64, f64)>,
    ) -> Self {
        let ambient = &initial.ambient;
        let sound = liquid.sound_speed(ambient.density, ambient.pressure);
        let mut pulses: Vec<Pulse> = initial.pulses.iter().flat_map(halves).collect();
        if let Some((wall, share)) = wall {
            let images: Vec<Pulse> = pulses.iter().map(|pulse| mirrored(*pulse, wall, share)).collect();
            pulses.extend(images);
        }
        let enters = |side: Side| boundaries[side as usize] == Boundary::Inflow;
        let entrance = [(Side::ZMin, domain.z[0], 1.0), (Side::ZMax, domain.z[1], -1.0)];
        let inflow =
            entrance.into_iter().find(|(side, ..)| enters(*side)).and_then(|(_, from, direction)| {
                let history = inflow?.clone();
                Some(Entering { history, ambient: ambient.pressure, from, direction, wall })
            });
        Self { pulses, inflow, sound, impedance: ambient.density * sound }
    }

    /// c of the liquid at rest, m/s.
    pub fn sound(&self) -> f64 {
        self.sound
    }

    /// At a point (z, r), m, and a time, s.
    pub fn at(&self, point: [f64; 2], time: f64) -> Wave {
        let mut wave = Wave::default();
        let mut add = |other: Wave| {
            wave.pressure += other.pressure;
            wave.velocity[0] += other.velocity[0];
            wave.velocity[1] += other.velocity[1];
        };
        for pulse in &self.pulses {
            add(match pulse.shape {
                PulseShape::Plane { direction } => {
                    plane(pulse, direction.unwrap_or([1.0, 0.0]), point, time, self.sound, self.impedance)
                }
                PulseShape::Sphere => sphere(pulse, point, time, self.sound, self.impedance),
            });
        }
        if let Some(entering) = &self.inflow {
            add(entering.at(point[0], time, self.sound, self.impedance));
        }
        wave
    }
}

/// A plane pulse at rest is two that run either way.
fn halves(pulse: &Pulse) -> Vec<Pulse> {
    match pulse.shape {
        PulseShape::Plane { direction: None } => [1.0, -1.0]
            .map(|way| Pulse {
                shape: PulseShape::Plane { direction: Some([way, 0.0]) },
                amplitude: 0.5 * pulse.amplitude,
                ..*pulse
            })
            .to_vec(),
        _ => vec![*pulse],
    }
}

/// The image of a pulse in the plane z = `wall`.
fn mirrored(pulse: Pulse, wall: f64, share: f64) -> Pulse {
    let shape = match pulse.shape {
        PulseShape::Plane { direction: Some([z, r]) } => PulseShape::Plane { direction: Some([-z, r]) },
        other => other,
    };
    let [z, r] = pulse.centre;
    Pulse { shape, centre: [2.0 * wall - z, r], amplitude: share * pulse.amplitude, ..pulse }
}

/// p = A exp(−(n·(x − x₀) − ct)²/a²), v = n p/(ρc).
fn plane(pulse: &Pulse, n: [f64; 2], [z, r]: [f64; 2], time: f64, sound: f64, impedance: f64) -> Wave {
    let along = (z - pulse.centre[0]) * n[0] + (r - pulse.centre[1]) * n[1] - sound * time;
    let pressure = pulse.amplitude * (-(along / pulse.width).powi(2)).exp();
    Wave { pressure, velocity: n.map(|n| n * pressure / impedance) }
}

/// The spherical wave of a pulse A exp(−s²/a²) at rest.
///
/// p = [F(s − ct) + F(s + ct)]/s with F(x) = ½ x A exp(−x²/a²), and from the potential φ = [G(s − ct) − G(s + ct)]/s with
/// G' = F/(ρc), G(x) = −¼ a² A exp(−x²/a²)/(ρc), the velocity ∂φ/∂s.
fn sphere(pulse: &Pulse, [z, r]: [f64; 2], time: f64, sound: f64, impedance: f64) -> Wave {
    let (along, across) = (z - pulse.centre[0], r - pulse.centre[1]);
    let s = along.hypot(across);
    let bell = |x: f64| pulse.amplitude * (-(x / pulse.width).powi(2)).exp();
    let [out, back] = [s - sound * time, s + sound * time];
    let f = |x: f64| 0.5 * x * bell(x);
    let g = |x: f64| -0.25 * pulse.width * pulse.width * bell(x);
    let pressure = (f(out) + f(back)) / s;
    let velocity = ((f(out) - f(back)) / s - (g(out) - g(back)) / (s * s)) / impedance;
    Wave { pressure, velocity: [velocity * along / s, velocity * across / s] }
}

impl Entering {
    fn at(&self, z: f64, time: f64, sound: f64, impedance: f64) -> Wave {
        let after = |path: f64| {
            let since = time - path / sound;
            if since >= 0.0 { self.history.at(since) - self.ambient } else { 0.0 }
        };
        let way = self.direction * (z - self.from);
        let arriving = after(way);
        let reflected = self.wall.map_or(0.0, |(wall, share)| {
            let to_wall = self.direction * (wall - self.from);
            share * after(to_wall + (to_wall - way))
        });
        let velocity = self.direction * (arriving - reflected) / impedance;
        Wave { pressure: arriving + reflected, velocity: [velocity, 0.0] }
    }
}
