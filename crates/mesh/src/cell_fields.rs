//! Fields of a snapshot: declared once, with all that files and case readers want to know of them.

use std::ops::Range;

use crate::Mesh;

/// A field of the snapshots `S`, one or three numbers a cell.
#[derive(Debug)]
pub struct CellField<S: 'static> {
    /// As in case files and in snapshots.
    pub name: &'static str,
    /// SI unit, as `kg/m3`; `1` for a pure number.
    pub unit: &'static str,
    /// What it is, in a few words.
    pub description: &'static str,
    numbers: Numbers<S>,
}

/// Where the numbers of a field come from: a snapshot holds what no other numbers say, as it takes memory while the program goes on.
#[derive(Debug)]
enum Numbers<S: 'static> {
    /// One a cell.
    Scalar(fn(&S) -> &[f64]),
    /// (z, r) of each cell; the third is 0.
    Vector(fn(&S) -> &[[f64; 2]]),
    /// Made from others, cell by cell.
    Made(fn(&S, usize) -> f64),
}

/// The cells of a snapshot: blocks in the order of their slots, rows of r, z within a row.
pub trait CellSnapshot: std::fmt::Debug + Send {
    /// Their levels.
    fn levels(&self) -> &CellLevels;

    /// How many there are.
    fn cells(&self) -> usize {
        self.levels().cells()
    }
}

impl<S: CellSnapshot> CellField<S> {
    /// The levels, which all snapshots have.
    pub const LEVEL: Self = Self::made("level", "1", "refinement level", |snapshot, cell| {
        f64::from(snapshot.levels().of_cell(cell))
    });

    /// A field of one number a cell, which snapshots hold.
    pub const fn scalar(
        name: &'static str,
        unit: &'static str,
        description: &'static str,
        values: fn(&S) -> &[f64],
    ) -> Self {
        Self { name, unit, description, numbers: Numbers::Scalar(values) }
    }

    /// A field of a vector (z, r, 0) a cell, of which snapshots hold z and r.
    pub const fn vector(
        name: &'static str,
        unit: &'static str,
        description: &'static str,
        values: fn(&S) -> &[[f64; 2]],
    ) -> Self {
        Self { name, unit, description, numbers: Numbers::Vector(values) }
    }

    /// A field of one number a cell that others say.
    pub const fn made(
        name: &'static str,
        unit: &'static str,
        description: &'static str,
        value: fn(&S, usize) -> f64,
    ) -> Self {
        Self { name, unit, description, numbers: Numbers::Made(value) }
    }

    /// 1 for a scalar, 3 for a vector (z, r, 0).
    pub fn components(&self) -> usize {
        match self.numbers {
            Numbers::Vector(_) => 3,
            Numbers::Scalar(_) | Numbers::Made(_) => 1,
        }
    }

    /// How many cells of a snapshot have it.
    pub fn cells(&self, snapshot: &S) -> usize {
        match self.numbers {
            Numbers::Scalar(values) => values(snapshot).len(),
            Numbers::Vector(values) => values(snapshot).len(),
            Numbers::Made(_) => snapshot.cells(),
        }
    }

    /// Adds the numbers of some cells to a list.
    pub fn add(&self, snapshot: &S, cells: Range<usize>, list: &mut Vec<f64>) {
        match self.numbers {
            Numbers::Scalar(values) => list.extend_from_slice(&values(snapshot)[cells]),
            Numbers::Vector(values) => {
                list.extend(values(snapshot)[cells].iter().flat_map(|[z, r]| [*z, *r, 0.0]))
            }
            Numbers::Made(value) => list.extend(cells.map(|cell| value(snapshot, cell))),
        }
    }
}

/// The levels of the cells of a snapshot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct CellLevels {
    /// Of each block.
    levels: Vec<u8>,
    /// Cells of a block.
    block: usize,
}

impl CellLevels {
    /// Those of a mesh.
    pub fn of<const N: usize>(mesh: &Mesh<N>) -> Self {
        Self { levels: mesh.tree().leaves().iter().map(|id| id.level).collect(), block: N * N }
    }

    /// How many cells there are.
    pub fn cells(&self) -> usize {
        self.levels.len() * self.block
    }

    /// Of a cell.
    pub fn of_cell(&self, cell: usize) -> u8 {
        self.levels[cell / self.block]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[derive(Debug)]
    struct Taken {
        density: Vec<f64>,
        velocity: Vec<[f64; 2]>,
        levels: CellLevels,
    }

    impl CellSnapshot for Taken {
        fn levels(&self) -> &CellLevels {
            &self.levels
        }
    }

    const FIELDS: &[CellField<Taken>] = &[
        CellField::scalar("density", "kg/m3", "density", |taken| &taken.density),
        CellField::vector("velocity", "m/s", "velocity", |taken| &taken.velocity),
        CellField::made("speed", "m/s", "speed", |taken, cell| {
            let [z, r] = taken.velocity[cell];
            z.hypot(r)
        }),
        CellField::LEVEL,
    ];

    #[test]
    fn what_is_held_and_what_is_made_is_added_cell_by_cell() {
        let velocity = vec![[3.0, 4.0], [0.0, -1.0], [6.0, 8.0]];
        let levels = CellLevels { levels: vec![2, 2, 5], block: 1 };
        let taken = Taken { density: vec![1.0, 2.0, 3.0], velocity, levels };
        let mut list = vec![7.0];
        for field in FIELDS {
            assert_eq!(field.cells(&taken), 3, "{}", field.name);
            field.add(&taken, 1..3, &mut list);
        }
        assert_eq!(FIELDS.iter().map(CellField::components).collect::<Vec<_>>(), [1, 3, 1, 1]);
        assert_eq!(list, [7.0, 2.0, 3.0, 0.0, -1.0, 0.0, 6.0, 8.0, 0.0, 1.0, 10.0, 2.0, 5.0]);
    }
}
