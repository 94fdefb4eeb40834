//! The paper's coupling schemes on the fluid's side: cell values cross the interface, and both sides make the same steps.
//!
//! The fluid gives the pressures of its cells at the wall and takes the velocities of the solid's. What of which time, and
//! how often, is the scheme: both of the old time, (31), (32); one after the other, (36), (37); repeated until the values of
//! the new time agree, (34), (35).

use coupler::{Aitken, FluidTrace, Kappa, KappaFactor, Participant, Scheme};
use fluid::FluidSolver;
use mesh::FaceState;
use mesh::{BLOCK, Misfit};
use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use crate::case::CouplingCase;

/// Values below these are taken for rest when relative changes are judged: velocities (m/s), pressures (Pa).
const REST: [f64; 2] = [1e-6, 1.0];

/// What the fluid keeps for these schemes.
#[derive(Debug)]
pub struct CellExchange {
    scheme: Scheme,
    first: Participant,
    kappa: Kappa,
    factor: KappaFactor,
    /// κ̂ of the present step.
    kappa_now: f64,
    tolerance: f64,
    most: u32,
    /// The solid's velocities on the fluid's faces, m/s.
    pub received: Vec<f64>,
    /// The fluid's own states on the wall in the middle of the present step.
    own: Vec<FluidTrace>,
    aitken: Aitken,
    /// What the strong scheme repeats: velocities, or pressures where the solid goes first; and what came of it.
    iterate: Vec<f64>,
    image: Vec<f64>,
    made: u32,
    iterations: Iterations,
}

/// How often the strong scheme has repeated its steps.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
struct Iterations {
    steps: u64,
    total: u64,
    most: u32,
    unsettled: u64,
}

/// What lasts from one step to the next.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct CellsState {
    factor: KappaFactor,
    received: Vec<f64>,
    relaxation: f64,
    iterations: Iterations,
}

impl CellExchange {
    /// What has to be kept of it between two steps.
    pub fn saved(&self) -> CellsState {
        // Field by field, so that a new one cannot be forgotten here.
        let Self {
            scheme: _,
            first: _,
            kappa: _,
            factor,
            kappa_now: _,
            tolerance: _,
            most: _,
            received,
            own: _,
            aitken,
            iterate: _,
            image: _,
            made: _,
            iterations,
        } = self;
        CellsState {
            factor: *factor,
            received: received.clone(),
            relaxation: aitken.factor(),
            iterations: *iterations,
        }
    }

    /// Takes up what was kept, at a wall of the same faces.
    pub fn restore(&mut self, saved: CellsState) -> Result<(), Misfit> {
        let CellsState { factor, received, relaxation, iterations } = saved;
        if received.len() != self.received.len() {
            return Err(Misfit(format!("{} velocities are not the wall's", received.len())));
        }
        self.factor = factor;
        self.received = received;
        self.aitken = Aitken::from_factor(relaxation);
        self.iterations = iterations;
        Ok(())
    }

    /// For a fluid at a wall that is at rest.
    pub fn new(coupling: &CouplingCase, faces: usize) -> Self {
        Self {
            scheme: coupling.scheme,
            first: coupling.first,
            kappa: coupling.kappa,
            factor: KappaFactor::default(),
            kappa_now: 1.0,
            tolerance: coupling.tolerance,
            most: coupling.max_iterations,
            received: vec![0.0; faces],
            own: Vec::new(),
            aitken: Aitken::default(),
            iterate: Vec::new(),
            image: Vec::new(),
            made: 0,
            iterations: Iterations::default(),
        }
    }

    /// Which of them it is.
    pub fn scheme(&self) -> Scheme {
        self.scheme
    }

    /// Who makes the step first.
    pub fn first(&self) -> Participant {
        self.first
    }

    /// Takes notice of a step of length `dt`, the Courant number of which is `courant`.
    pub fn begin(&mut self, solver: &FluidSolver<BLOCK>, dt: f64, courant: f64) {
        solver.traces_at_mid_step(dt, &mut self.own);
        self.kappa_now = if self.kappa == Kappa::Off { 1.0 } else { self.factor.next(courant) };
        if self.scheme == Scheme::Strong {
            self.made = 0;
            self.aitken.begin();
            match self.first {
                Participant::Fluid => self.iterate.clone_from(&self.received),
                Participant::Solid => {
                    self.iterate.clear();
                    solver.wall_cells(false, |_, pressure, _| self.iterate.push(pressure));
                }
            }
        }
    }

    /// The wall moves with the solid's velocity, times κ̂ where the paper's factor is on.
    pub fn set_wall(&self, solver: &mut FluidSolver<BLOCK>) {
        let is_tried = self.scheme == Scheme::Strong && self.first == Participant::Fluid;
        let given = if is_tried { &self.iterate } else { &self.received };
        solver.interface_mut().set_all(|face| {
            let FluidTrace { pressure, velocity: own, .. } = self.own[face];
            let velocity = match self.kappa {
                Kappa::Off => given[face],
                Kappa::Printed => self.kappa_now * given[face],
                Kappa::Jump => own + self.kappa_now * (given[face] - own),
            };
            FaceState { pressure, velocity, power: pressure * velocity, ..FaceState::default() }
        });
    }

    /// The pressures that the solid is to try: of the fluid's new cells, or the iterate itself.
    pub fn trial_pressures(&self, solver: &FluidSolver<BLOCK>, mut put: impl FnMut(usize, f64)) {
        match self.first {
            Participant::Fluid => solver.wall_cells(true, |face, pressure, _| put(face, pressure)),
            Participant::Solid => self.iterate.iter().enumerate().for_each(|(face, p)| put(face, *p)),
        }
    }

    /// Compares what came of the iterate with it, and goes on to the next one; `true` if it may stay.
    pub fn compare(&mut self, solver: &FluidSolver<BLOCK>) -> bool {
        self.image.clear();
        let rest = match self.first {
            Participant::Fluid => {
                self.image.extend_from_slice(&self.received);
                REST[0]
            }
            Participant::Solid => {
                solver.wall_cells(true, |_, pressure, _| self.image.push(pressure));
                REST[1]
            }
        };
        self.made += 1;
        let largest = self.image.iter().fold(rest, |largest, value| largest.max(value.abs()));
        let change = (self.iterate.iter().zip(&self.image)).fold(0.0_f64, |c, (x, y)| c.max((y - x).abs()));
        let is_settled = change <= self.tolerance * largest;
        if !is_settled && self.made < self.most {
            self.aitken.relax(&mut self.iterate, &self.image);
            return false;
        }
        self.iterations.steps += 1;
        self.iterations.total += u64::from(self.made);
        self.iterations.most = self.iterations.most.max(self.made);
        self.iterations.unsettled += u64::from(!is_settled);
        true
    }

    /// For the summary: how often steps were repeated; `None` in the other schemes.
    pub fn summary(&self) -> Option<Value> {
        let Iterations { steps, total, most, unsettled } = self.iterations;
        (self.scheme == Scheme::Strong).then(|| {
            json!({
                "mean": total as f64 / steps.max(1) as f64,
                "largest": most,
                "unsettled_steps": unsettled,
            })
        })
    }
}
