//! The interface during one step of the side with the longer steps, as the other side sees it.
//!
//! The interface is a flux register in time: the side with the longer step shows its trace and how it changes, the other
//! meets it in each of its own steps and returns the means. What one gives the other gets, to round-off, whatever the
//! ratio of the steps, and also where the faces do not match.

mod seen;

use rayon::prelude::*;

use crate::error::CouplerError;
use crate::exchange::{RegisterRow, TraceRow};
use crate::kinds::Participant;
use crate::mapping::{CommonRefinement, SubFace};
use crate::options::StarSolver;
use crate::star::{InterfaceStar, acoustic_star, exact_star};
use seen::Seen;

/// A short step, or one of some of a side's faces.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShortStep {
    /// When it begins, s.
    pub begin: f64,
    /// Its length, s.
    pub dt: f64,
}

/// Running means over the long step, on one sub-face.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Means {
    pressure: f64,
    velocity: f64,
    power: f64,
    tangential: f64,
    shear: f64,
}

/// So many sub-faces are worth it to wake a thread: some 20 microseconds.
const FACES_AT_ONCE: usize = 64;

/// What friction does on a sub-face.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Friction {
    /// σ_zr*, Pa.
    shear: f64,
    /// v_r of the wall, m/s.
    velocity: f64,
}

impl Friction {
    /// What the fluid does to the solid per area, W/m²: p*v* − σ_zr* v_r*; p*v* to the last bit without friction.
    fn power(&self, star: &InterfaceStar) -> f64 {
        let normal = star.pressure * star.velocity;
        if self.shear == 0.0 { normal } else { normal - self.shear * self.velocity }
    }
}

/// Both sides' faces, the other side's trace, and what has come of them so far.
///
/// The first side of the refinement is the one with the longer step, the second the own one.
#[derive(Clone, Debug, Default)]
pub struct Meeting {
    refinement: CommonRefinement,
    edges: Vec<f64>,
    generation: Option<u64>,
    trace: Vec<f64>,
    others: usize,
    own: Vec<f64>,
    begin: f64,
    low: f64,
    stars: Vec<InterfaceStar>,
    frictions: Vec<Friction>,
    means: Vec<Means>,
    floored: u64,
}

impl Meeting {
    /// Begins a long step with the other side's trace frame.
    ///
    /// - `payload`: rows of [`TraceRow`], `others` faces long, as [`crate::Frame::trace`] lets them in; `begin`: when the step begins, s.
    /// - `generation`: tells whether the own faces are those of the last time; if not, they are asked for by `edges`.
    /// - `low`: the radius at which the interface begins, m.
    pub fn begin(
        &mut self,
        (payload, others): (&[f64], usize),
        begin: f64,
        (generation, edges): (u64, impl FnOnce() -> Vec<f64>),
        low: f64,
        axisymmetric: bool,
    ) {
        if self.generation != Some(generation) {
            self.edges = edges();
            self.generation = Some(generation);
            self.own.clear();
            self.own.resize(TraceRow::COUNT * self.edges.len(), 0.0);
        }
        self.trace.clear();
        self.trace.extend_from_slice(payload);
        (self.others, self.begin, self.low) = (others, begin, low);
        self.refinement.update(low, TraceRow::Edge.of(payload, others), &self.edges, axisymmetric);
        let sub_faces = self.refinement.sub_faces().len();
        let nothing = InterfaceStar { pressure: 0.0, velocity: 0.0, iterations: 0, floored: false };
        self.stars.resize(sub_faces, nothing);
        self.frictions.resize(sub_faces, Friction::default());
        self.means.resize(sub_faces, Means::default());
    }

    /// Where the own trace goes, as the payload of a trace frame.
    pub fn own_trace(&mut self) -> (&mut [f64], usize) {
        (&mut self.own, self.edges.len())
    }

    /// Solves the Riemann problem between the two media on all sub-faces of some own faces, at the middle of a step that
    /// these are about to make. Their own trace must be there.
    ///
    /// - `own`: which medium this side is; `is_due`: by number of the own face.
    /// - errors: a trace is no state, or the two have none in common; says whose and where.
    pub fn meet(
        &mut self,
        own: Participant,
        step: ShortStep,
        solver: StarSolver,
        is_due: impl Fn(usize) -> bool + Sync,
    ) -> Result<(), CouplerError> {
        // Of the other side's trace as much time has passed as its step is old.
        let (half, age) = (0.5 * step.dt, step.begin - self.begin + 0.5 * step.dt);
        let weight =
            if step.begin == self.begin { 1.0 } else { step.dt / (step.begin + step.dt - self.begin) };
        let Self { refinement, trace, others, own: own_trace, edges, stars, frictions, means, low, .. } =
            self;
        let (trace, own_trace) = (&*trace, &*own_trace);
        let meet = |sub: &SubFace, star: &mut InterfaceStar, friction: &mut Friction, mean: &mut Means| {
            let SubFace { first, second, offset_in_first, offset_in_second, .. } = *sub;
            // Traces are linear along a face: a face that meets several of the other side shows each its own part.
            let theirs =
                Seen { rows: trace, count: *others, face: first, after: age, offset: offset_in_first };
            let ours = Seen {
                rows: own_trace,
                count: edges.len(),
                face: second,
                after: half,
                offset: offset_in_second,
            };
            let (fluid_seen, solid_seen) = match own {
                Participant::Fluid => (&ours, &theirs),
                Participant::Solid => (&theirs, &ours),
            };
            let (fluid, solid) = (fluid_seen.fluid(), solid_seen.solid());
            let no_state = |side: Participant, values: String| {
                let radius = if side == own { ours.radius(*low) } else { theirs.radius(*low) };
                Err(CouplerError::NoState { side, radius, time: step.begin + half, values })
            };
            if !fluid.is_state() {
                return no_state(Participant::Fluid, format!("{fluid:?}"));
            }
            if !solid.is_state() {
                return no_state(Participant::Solid, format!("{solid:?}"));
            }
            *star = match solver {
                StarSolver::Exact => exact_star(&fluid, &solid),
                StarSolver::Acoustic => acoustic_star(&fluid, &solid),
            };
            if !star.is_finite() {
                // Then one of them is far beyond any state; the suspect is the one from elsewhere.
                let values = format!("{fluid:?} and {solid:?} have none in common: {star:?}");
                return no_state(own.peer(), values);
            }
            // The fluid says how it drags the wall, the solid how that moves.
            let shear = fluid_seen.value(TraceRow::Shear);
            *friction = Friction { shear, velocity: solid_seen.tangential_velocity() };
            // By differences, so that the mean of what stays the same is the same to the last bit.
            let add = |mean: &mut f64, value: f64| {
                *mean = if weight == 1.0 { value } else { *mean + weight * (value - *mean) };
            };
            add(&mut mean.pressure, star.pressure);
            add(&mut mean.velocity, star.velocity);
            add(&mut mean.power, friction.power(star));
            add(&mut mean.shear, friction.shear);
            let tangential = [TraceRow::TangentialVelocity, TraceRow::TangentialVelocityRate]
                .map(|row| row.of(own_trace, edges.len())[second]);
            add(&mut mean.tangential, tangential[0] + half * tangential[1]);
            Ok(u64::from(star.floored))
        };
        let parts = (refinement.sub_faces().par_chunks(FACES_AT_ONCE))
            .zip(stars.par_chunks_mut(FACES_AT_ONCE))
            .zip(frictions.par_chunks_mut(FACES_AT_ONCE))
            .zip(means.par_chunks_mut(FACES_AT_ONCE));
        let met: Vec<Result<u64, CouplerError>> = (parts)
            .map(|(((subs, stars), frictions), means)| {
                let places = subs.iter().zip(stars).zip(frictions).zip(means);
                let due = places.filter(|(((sub, _), _), _)| is_due(sub.second));
                due.map(|(((sub, star), friction), mean)| meet(sub, star, friction, mean)).sum()
            })
            .collect();
        // The first that fails is told of, whoever was first to find one.
        self.floored += met.into_iter().sum::<Result<u64, CouplerError>>()?;
        Ok(())
    }

    /// The present step's means over the own faces: `put(face, [p*, v*, power, σ_zr*, v_r*])`, the last two 0 without friction.
    pub fn own_means(&self, put: impl FnMut(usize, [f64; 5])) {
        let state = |k: usize| {
            let (star, friction) = (&self.stars[k], &self.frictions[k]);
            [star.pressure, star.velocity, friction.power(star), friction.shear, friction.velocity]
        };
        self.refinement.means_of(true, state, put);
    }

    /// Writes the payload of the register frame that answers the trace: the means over the long step on the other side's
    /// faces.
    pub fn write_register(&self, payload: &mut [f64]) {
        let rows = [
            RegisterRow::Pressure,
            RegisterRow::NormalVelocity,
            RegisterRow::Power,
            RegisterRow::TangentialVelocity,
            RegisterRow::Shear,
        ];
        let state = |k: usize| {
            let Means { pressure, velocity, power, tangential, shear } = self.means[k];
            [pressure, velocity, power, tangential, shear]
        };
        self.refinement.means_of(false, state, |face, means| {
            for (row, mean) in rows.into_iter().zip(means) {
                payload[row as usize * self.others + face] = mean;
            }
        });
    }

    /// What of it counts beyond the end of a long step: the number of [`Meeting::floored`]. The rest is made anew in the next.
    pub fn saved(&self) -> u64 {
        // Field by field, so that a new one cannot be forgotten here.
        let Self {
            refinement: _,
            edges: _,
            generation: _,
            trace: _,
            others: _,
            own: _,
            begin: _,
            low: _,
            stars: _,
            frictions: _,
            means: _,
            floored,
        } = self;
        *floored
    }

    /// As it was when this was [`Meeting::saved`].
    pub fn restored(floored: u64) -> Self {
        Self { floored, ..Self::default() }
    }

    /// Star states that had to be lifted to the lowest admissible pressure so far.
    pub fn floored(&self) -> u64 {
        self.floored
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WATER: [(TraceRow, f64); 5] = [
        (TraceRow::Pressure, 1e5),
        (TraceRow::NormalVelocity, -3.0),
        (TraceRow::Density, 1000.0),
        (TraceRow::Gamma, 7.15),
        (TraceRow::Pi, 3e8),
    ];
    const STEEL: [(TraceRow, f64); 2] = [(TraceRow::Pressure, 1e5), (TraceRow::Impedance, 4.7e7)];

    /// The rows of a trace that is the same on all faces.
    fn trace(edges: &[f64], values: &[(TraceRow, f64)]) -> Vec<f64> {
        let mut rows = vec![0.0; TraceRow::COUNT * edges.len()];
        rows[..edges.len()].copy_from_slice(edges);
        for (row, value) in values {
            rows[*row as usize * edges.len()..][..edges.len()].fill(*value);
        }
        rows
    }

    /// What a solid of four faces makes of a fluid of three, and what a fluid makes of a solid, if one number is changed.
    fn met(
        own: Participant,
        solver: StarSolver,
        (whose, row, face, value): (Participant, TraceRow, usize, f64),
    ) -> Result<(), CouplerError> {
        let (outer, inner) = ([0.01, 0.02, 0.05], [0.01, 0.02, 0.03, 0.05]);
        let (theirs, ours) = match own {
            Participant::Fluid => (&STEEL[..], &WATER[..]),
            Participant::Solid => (&WATER[..], &STEEL[..]),
        };
        let (mut theirs, mut ours) = (trace(&outer, theirs), trace(&inner, ours));
        if whose == own {
            ours[row as usize * inner.len() + face] = value;
        } else {
            theirs[row as usize * outer.len() + face] = value;
        }
        let mut meeting = Meeting::default();
        meeting.begin((&theirs, outer.len()), 1e-5, (0, || inner.to_vec()), 0.0, true);
        meeting.own_trace().0.copy_from_slice(&ours);
        let step = ShortStep { begin: 1e-5, dt: 1e-8 };
        meeting.meet(own, step, solver, |_| true)?;
        let mut register = vec![f64::NAN; RegisterRow::COUNT * outer.len()];
        meeting.write_register(&mut register);
        assert!(register[..3 * outer.len()].iter().all(|value| value.is_finite()));
        Ok(())
    }

    #[test]
    fn the_side_whose_trace_is_no_state_is_named_with_place_and_time() {
        use Participant::{Fluid, Solid};
        for solver in [StarSolver::Exact, StarSolver::Acoustic] {
            for own in [Fluid, Solid] {
                assert_eq!(met(own, solver, (Solid, TraceRow::Shear, 0, 7.0)), Ok(()));
                for (whose, row, value) in [
                    (Fluid, TraceRow::Density, -0.046),
                    (Fluid, TraceRow::Density, 0.0),
                    (Fluid, TraceRow::DensityRate, -1.1e3 / 5e-9),
                    (Fluid, TraceRow::Pressure, -3e8),
                    (Fluid, TraceRow::PressureRate, -1e17),
                    (Fluid, TraceRow::Gamma, 0.5),
                    (Fluid, TraceRow::Pi, -2e5),
                    (Fluid, TraceRow::NormalVelocity, f64::NAN),
                    (Solid, TraceRow::Impedance, 0.0),
                    (Solid, TraceRow::Impedance, -1.0),
                    (Solid, TraceRow::NormalVelocityRate, f64::INFINITY),
                ] {
                    let error = met(own, solver, (whose, row, 1, value)).expect_err("no state");
                    let CouplerError::NoState { side, radius, time, .. } = &error else { panic!("{error}") };
                    assert_eq!(*side, whose, "{row:?} {error}");
                    assert!((radius - 0.015).abs() < 1e-12 && (time - 1.0005e-5).abs() < 1e-15, "{error}");
                    assert!(
                        error.to_string().starts_with(&format!("the {whose}'s trace at r = 1.5")),
                        "{error}"
                    );
                }
            }
        }
    }

    /// A face's slope may leave the state on one of the sub-faces only.
    #[test]
    fn each_sub_face_is_looked_at() {
        let change = (Participant::Fluid, TraceRow::DensitySlope, 2, -4e5);
        let error = met(Participant::Solid, StarSolver::Exact, change).expect_err("no state");
        assert!(matches!(error, CouplerError::NoState { side: Participant::Fluid, .. }), "{error}");
    }

    /// Two states may be so far apart that what they meet in overflows.
    #[test]
    fn a_star_state_beyond_numbers_is_refused() {
        let change = (Participant::Solid, TraceRow::NormalVelocity, 1, 1e200);
        for own in [Participant::Fluid, Participant::Solid] {
            let error = met(own, StarSolver::Acoustic, change).expect_err("no state in common");
            let CouplerError::NoState { side, values, .. } = error else { panic!("{error}") };
            assert_eq!(side, own.peer());
            assert!(values.contains("none in common"), "{values}");
        }
    }
}
