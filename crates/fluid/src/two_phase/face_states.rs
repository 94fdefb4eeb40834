//! Where the states on the faces of mixed cells are kept.

use super::cells::FaceState;
use super::windows::{LANES, Lane};

/// ρ, v_z, v_r, p, φ and the gas's part of the mass.
type Rows = [Lane; 6];

/// Lanes whose cells were bounded, bit by bit: phase densities, pressure, gas fraction; and those that kept half, and none, of
/// their slopes.
pub(crate) type Bounded = [u8; 5];

const EMPTY: [Rows; 4] = [[[0.0; LANES]; 6]; 4];

/// The states on the four faces of cells, in the lanes of the windows that they were made in.
#[derive(Clone, Debug, Default)]
pub(crate) struct FaceStates {
    windows: Vec<[Rows; 4]>,
    /// Of each window but those that were pushed.
    bounded: Vec<Bounded>,
    /// How many cells were put behind those of the windows.
    pushed: usize,
}

impl FaceStates {
    /// Room for the states of so many windows, and for what was bounded in them, all to be written over; what was pushed goes.
    pub fn of_windows(&mut self, count: usize) -> impl Iterator<Item = (&mut [Rows; 4], &mut Bounded)> {
        self.pushed = 0;
        self.windows.resize(count, EMPTY);
        self.bounded.resize(count, Bounded::default());
        self.windows.iter_mut().zip(&mut self.bounded)
    }

    /// What was bounded in each window.
    pub fn bounded(&self) -> &[Bounded] {
        &self.bounded
    }

    /// What the cell in a place has on one of its faces.
    #[inline(always)]
    pub fn of(&self, place: usize, face: usize) -> FaceState {
        let [rho, v_z, v_r, p, phi, gas_share] = &self.windows[place / LANES][face];
        let lane = place % LANES;
        FaceState { w: [rho[lane], v_z[lane], v_r[lane], p[lane], phi[lane]], gas_share: gas_share[lane] }
    }

    /// Puts a state in its place.
    pub fn set(&mut self, place: usize, face: usize, state: FaceState) {
        let [rho, v_z, v_r, p, phi] = state.w;
        for (row, value) in
            self.windows[place / LANES][face].iter_mut().zip([rho, v_z, v_r, p, phi, state.gas_share])
        {
            row[place % LANES] = value;
        }
    }

    /// Puts a cell behind the others.
    ///
    /// - returns: its place.
    pub fn push(&mut self, states: [FaceState; 4]) -> usize {
        if self.pushed.is_multiple_of(LANES) {
            self.windows.push(EMPTY);
        }
        let place = LANES * (self.windows.len() - 1) + self.pushed % LANES;
        self.pushed += 1;
        states.into_iter().enumerate().for_each(|(face, state)| self.set(place, face, state));
        place
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_pushed_lies_behind_the_windows_and_goes_with_them() {
        let state =
            |n: usize| FaceState { w: [0.0, 1.0, 2.0, 3.0, 4.0].map(|c| c + n as f64), gas_share: n as f64 };
        let mut states = FaceStates::default();
        for windows in [2, 1] {
            states.of_windows(windows).for_each(|(faces, _)| *faces = [[[7.0; LANES]; 6]; 4]);
            let places: Vec<usize> =
                (0..10).map(|n| states.push([0, 1, 2, 3].map(|face| state(4 * n + face)))).collect();
            assert_eq!(places, Vec::from_iter(windows * LANES..windows * LANES + 10));
            for (n, place) in places.into_iter().enumerate() {
                for face in 0..4 {
                    assert_eq!(states.of(place, face), state(4 * n + face));
                }
            }
            assert_eq!(states.of(LANES - 1, 3), FaceState { w: [7.0; 5], gas_share: 7.0 });
        }
    }
}
