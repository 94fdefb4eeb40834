//! The fluxes through the faces of a padded block.

use mesh::{AlignedRow, Frame};

use crate::riemann::hllc::Face;

/// Rows of [`Face`]s, one number each, indexed by the cell on the lower side of the face.
#[derive(Clone, Debug)]
pub(crate) struct FaceRows {
    pub mass: AlignedRow,
    pub velocity: AlignedRow,
    pub pressure: AlignedRow,
    pub shear: AlignedRow,
    pub energy: AlignedRow,
    pub phi: AlignedRow,
    /// Mass flux of the gas, where the model has one; made by [`FaceRows::gas_mut`], which knows of it.
    gas: AlignedRow,
    /// Whether that or the gas fraction may hold anything but zeros.
    has_gas: bool,
}

impl FaceRows {
    /// For padded rows of `len` cells, `stride` apart along r.
    pub fn zeros(len: usize, stride: usize) -> Self {
        let row = || AlignedRow::zeros(len, stride);
        Self {
            mass: row(),
            velocity: row(),
            pressure: row(),
            shear: row(),
            energy: row(),
            phi: row(),
            gas: row(),
            has_gas: false,
        }
    }

    /// Mass flux of the gas, kg/(m² s).
    pub fn gas(&self) -> &[f64] {
        &self.gas
    }

    /// The mass flux of the gas beside that of the mass, to be written.
    pub fn gas_mut(&mut self) -> (&mut [f64], &[f64]) {
        self.has_gas = true;
        (&mut self.gas, &self.mass)
    }

    /// Gas may pass.
    pub fn with_gas(&mut self) {
        self.has_gas = true;
    }

    /// No gas passes; most blocks leave it at that.
    pub fn without_gas(&mut self) {
        if std::mem::take(&mut self.has_gas) {
            self.gas.fill(0.0);
            self.phi.fill(0.0);
        }
    }

    /// The rows that all models have, in the order of the fields. To take them once saves kernels the way to each row.
    #[inline(always)]
    pub fn fluxes(&self) -> [&[f64]; 6] {
        [&self.mass, &self.velocity, &self.pressure, &self.shear, &self.energy, &self.phi]
    }

    /// See [`FaceRows::fluxes`].
    #[inline(always)]
    pub fn fluxes_mut(&mut self) -> [&mut [f64]; 6] {
        let Self { mass, velocity, pressure, shear, energy, phi, .. } = self;
        [mass, velocity, pressure, shear, energy, phi]
    }

    #[inline(always)]
    pub fn set(&mut self, k: usize, face: Face) {
        set_face(&mut self.fluxes_mut(), k, face);
    }
}

/// Writes one face into [`FaceRows::fluxes_mut`].
#[inline(always)]
pub(crate) fn set_face(
    [mass, velocity, pressure, shear, energy, phi]: &mut [&mut [f64]; 6],
    k: usize,
    face: Face,
) {
    mass[k] = face.mass;
    velocity[k] = face.velocity;
    pressure[k] = face.pressure;
    shear[k] = face.shear;
    energy[k] = face.energy;
    phi[k] = face.phi;
}

/// 1 at the cells above which the face counts, see [`used_face`], else 0.
pub(crate) fn used_faces(frame: Frame, step: usize) -> AlignedRow {
    let mut used = AlignedRow::zeros(frame.len(), frame.stride());
    (0..frame.len()).filter(|k| used_face(frame, *k, step)).for_each(|k| used[k] = 1.0);
    used
}

/// Whether the face above cell `k` (along z for step 1, else along r) bounds a cell of the block or tile.
pub(crate) fn used_face(frame: Frame, k: usize, step: usize) -> bool {
    let (i, j) = (k % frame.stride(), k / frame.stride());
    let inner = mesh::GHOSTS..mesh::GHOSTS + frame.cells();
    let faces = mesh::GHOSTS - 1..mesh::GHOSTS + frame.cells();
    if step == 1 {
        faces.contains(&i) && inner.contains(&j)
    } else {
        inner.contains(&i) && faces.contains(&j)
    }
}
