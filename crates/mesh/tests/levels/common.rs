//! Random meshes and what is known of them without the code under test.

use mesh::{
    Adaptation, Adapted, BlockId, ComponentsOfCell, Domain, Field, Geometry, MOST_COMPONENTS, Mesh,
    Multiresolution, Neighbour, Patch, ScratchPool, Side,
};
use proptest::prelude::*;

/// Cells along a block in these tests.
pub const N: usize = 8;

/// Splitmix64: random numbers that a seed determines.
#[derive(Clone)]
pub struct Random(pub u64);

impl Random {
    pub fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        mix(self.0)
    }

    /// In [0, 1).
    pub fn unit(&mut self) -> f64 {
        (self.bits() >> 11) as f64 / (1u64 << 53) as f64
    }

    pub fn below(&mut self, n: usize) -> usize {
        (self.bits() % n as u64) as usize
    }

    pub fn fill(&mut self, values: &mut [f64]) {
        values.iter_mut().for_each(|value| *value = 2.0 * self.unit() - 1.0);
    }
}

pub fn mix(x: u64) -> u64 {
    let x = (x ^ (x >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    let x = (x ^ (x >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    x ^ (x >> 31)
}

/// What the analysis knows of the fields of a test.
#[derive(Clone, Copy)]
pub struct Rule {
    /// Continued where `None`, else reflected with that sign.
    pub parity: Option<f64>,
    /// Whether prediction takes a share of its deviations that varies from cell to cell.
    pub shares: bool,
    /// Whether the significance of a cell is its first component; else nothing is significant.
    pub told: bool,
}

pub const SILENT: Rule = Rule { parity: None, shares: false, told: false };
pub const TOLD: Rule = Rule { told: true, ..SILENT };

impl Multiresolution for Rule {
    fn parity(&self, _: Side, _: usize) -> Option<f64> {
        self.parity
    }

    fn share(&self, mean: &[f64], _: &[[f64; MOST_COMPONENTS]; 4]) -> f64 {
        if self.shares { (mix(mean[0].to_bits()) % 5) as f64 / 4.0 } else { 1.0 }
    }

    fn significance(&self, cell: &ComponentsOfCell, _: &ComponentsOfCell) -> f64 {
        if self.told { cell[0] } else { 0.0 }
    }
}

pub const EVERYWHERE: Adaptation = Adaptation::by_details(1.0, 1);

/// The threshold of [`EVERYWHERE`] on a level.
pub fn threshold(mesh: &Mesh<N>, level: u8) -> f64 {
    1.0 / f64::from(1u32 << (mesh.tree().finest() - level))
}

/// A coarsest grid, and how to grow random leaves over it.
#[derive(Clone, Debug)]
pub struct Plan {
    pub domain: Domain,
    pub coarsest: [usize; 2],
    pub levels: u8,
    pub start: u8,
    pub periodic: [bool; 2],
    pub seed: u64,
}

pub fn plans(levels: u8) -> impl Strategy<Value = Plan> {
    let roots = (1usize..=3, 1usize..=2, any::<bool>());
    let kinds = (any::<bool>(), any::<bool>(), any::<bool>(), any::<bool>());
    (roots, kinds, 1..=levels, 0..=levels, any::<u64>()).prop_map(
        |((across, up, higher), (axisymmetric, hollow, along_z, along_r), levels, start, seed)| {
            let geometry = if axisymmetric { Geometry::Axisymmetric } else { Geometry::Planar };
            // Roots on level 0 or 1: a coarsest grid smaller than a block lifts them.
            let (cells, levels) = if higher { (N / 2, levels + 1) } else { (N, levels) };
            let r_min = if hollow { 0.25 } else { 0.0 };
            Plan {
                domain: Domain { geometry, z: [-0.5, 0.25], r: [r_min, r_min + 0.5] },
                coarsest: [across * cells, up * cells],
                levels,
                start: start.min(levels),
                periodic: [along_z, along_r && !axisymmetric],
                seed,
            }
        },
    )
}

impl Plan {
    pub fn mesh(&self) -> Mesh<N> {
        Mesh::on_level(self.domain, self.coarsest, self.start, self.levels, self.periodic).unwrap()
    }

    /// A mesh of random leaves, after a few adaptations.
    pub fn grown(&self, random: &mut Random) -> Mesh<N> {
        let mut mesh = self.mesh();
        for _ in 0..4 {
            let wanted = random_levels(&mesh, random, [0.4, 0.3]);
            if let Some(adapted) = towards(&mesh, &wanted) {
                mesh = adapted.mesh;
            }
        }
        mesh
    }
}

/// Levels around the present ones: one finer and one coarser with the given probabilities.
pub fn random_levels(mesh: &Mesh<N>, random: &mut Random, [finer, coarser]: [f64; 2]) -> Vec<u8> {
    (mesh.tree().leaves().iter())
        .map(|id| match random.unit() {
            x if x < finer => id.level + 1,
            x if x < finer + coarser => id.level.saturating_sub(1),
            _ => id.level,
        })
        .collect()
}

/// Adapts as near to the wanted levels as grading admits.
pub fn towards(mesh: &Mesh<N>, wanted: &[u8]) -> Option<Adapted<N>> {
    let field = Field::zeros(mesh.blocks(), N * N, 1);
    let scratch = ScratchPool::new(|| Patch::zeros(1));
    mesh.adapted(&field, &SILENT, &EVERYWHERE, &scratch, |_| 0.0, |slot| wanted[slot])
}

/// Which leaf covers each finest block, painted leaf by leaf.
pub struct Map {
    pub extent: [i64; 2],
    periodic: [bool; 2],
    slots: Vec<usize>,
}

impl Map {
    /// Paints the leaves; panics unless every finest block is covered once.
    pub fn paint(mesh: &Mesh<N>, periodic: [bool; 2]) -> Self {
        let tree = mesh.tree();
        let extent = tree.blocks_on(tree.finest()).map(i64::from);
        let mut map = Self { extent, periodic, slots: vec![usize::MAX; (extent[0] * extent[1]) as usize] };
        for (slot, id) in tree.leaves().iter().enumerate() {
            let ([x, y], size) = square(mesh, *id);
            for b in y..y + size {
                for a in x..x + size {
                    let covered = &mut map.slots[(b * extent[0] + a) as usize];
                    assert_eq!(*covered, usize::MAX, "leaves overlap");
                    *covered = slot;
                }
            }
        }
        assert!(!map.slots.contains(&usize::MAX), "the leaves leave a gap");
        map
    }

    /// The leaf over a finest block, which may lie in a periodic image.
    pub fn at(&self, place: [i64; 2]) -> Option<usize> {
        let mut inside = place;
        for axis in 0..2 {
            if self.periodic[axis] {
                inside[axis] = place[axis].rem_euclid(self.extent[axis]);
            } else if !(0..self.extent[axis]).contains(&place[axis]) {
                return None;
            }
        }
        Some(self.slots[(inside[1] * self.extent[0] + inside[0]) as usize])
    }

    /// The leaves beyond a side or corner of a leaf, in ascending order along it, each one once.
    pub fn beyond(&self, mesh: &Mesh<N>, slot: usize, offset: [i64; 2]) -> Vec<usize> {
        let (low, size) = square(mesh, mesh.tree().leaves()[slot]);
        let range = |axis: usize| match offset[axis] {
            -1 => low[axis] - 1..low[axis],
            0 => low[axis]..low[axis] + size,
            _ => low[axis] + size..low[axis] + size + 1,
        };
        let mut found: Vec<usize> = Vec::new();
        for b in range(1) {
            for a in range(0) {
                if let Some(other) = self.at([a, b])
                    && found.last() != Some(&other)
                {
                    found.push(other);
                }
            }
        }
        found
    }
}

/// Lower corner and side of a block in units of finest blocks.
pub fn square(mesh: &Mesh<N>, id: BlockId) -> ([i64; 2], i64) {
    let size = 1i64 << (mesh.tree().finest() - id.level);
    ([i64::from(id.i) * size, i64::from(id.j) * size], size)
}

/// Sets one component to the cell averages of a function `(centre, widths) -> average`.
pub fn sample<const M: usize>(
    mesh: &Mesh<M>,
    field: &mut Field,
    component: usize,
    average: impl Fn([f64; 2], [f64; 2]) -> f64,
) {
    for (slot, id) in mesh.tree().leaves().iter().enumerate() {
        let widths = mesh.widths(id.level);
        for j in 0..M {
            for i in 0..M {
                field.block_mut(slot)[(component * M + j) * M + i] = average(mesh.centre(*id, i, j), widths);
            }
        }
    }
}

/// Whether a block touches a side of the domain that is no periodic one, or a corner there.
pub fn is_at_boundary(mesh: &Mesh<N>, slot: usize) -> bool {
    mesh.tree().neighbours(slot).contains(&Neighbour::Boundary)
}
