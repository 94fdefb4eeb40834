//! Where a file ends: how many rows its datasets have.

use hdf5::Group;

use super::layout::set_rows;
use super::{CellMesh, End, Offsets};

/// Datasets of the group `Steps` with one row per snapshot; those of `CellDataOffsets` come besides.
const STEP_DATASETS: [&str; 6] =
    ["Values", "PartOffsets", "NumberOfParts", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets"];

impl End {
    /// The end after one more snapshot.
    pub(super) fn after(&self, mesh: &dyn CellMesh, is_new_mesh: bool) -> Self {
        let mut end = *self;
        end.steps += 1;
        end.field_rows += mesh.cells();
        if is_new_mesh {
            end.last = self.next;
            end.next.meshes += 1;
            end.next.points += mesh.points();
            end.next.cells += mesh.cells();
            end.next.connectivity += 4 * mesh.cells();
        }
        end
    }

    /// Cuts all datasets down to this end.
    pub(super) fn cut(&self, root: &Group) -> hdf5::Result<()> {
        let of_steps = root.group("Steps")?;
        for name in STEP_DATASETS {
            set_rows(&of_steps.dataset(name)?, self.steps)?;
        }
        for offsets in of_steps.group("CellDataOffsets")?.datasets()? {
            set_rows(&offsets, self.steps)?;
        }
        let Offsets { meshes, points, cells, connectivity } = self.next;
        for name in ["NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"] {
            set_rows(&root.dataset(name)?, meshes)?;
        }
        let per_mesh = [
            ("Points", points),
            ("Connectivity", connectivity),
            // One offset more than cells for each mesh.
            ("Offsets", cells + meshes),
            ("Types", cells),
        ];
        for (name, rows) in per_mesh {
            set_rows(&root.dataset(name)?, rows)?;
        }
        root.group("CellData")?.datasets()?.iter().try_for_each(|field| set_rows(field, self.field_rows))
    }

    /// The end of the first `steps` snapshots of a file, from what the last of them points to.
    pub(super) fn read(root: &Group, steps: usize) -> hdf5::Result<Self> {
        if steps == 0 {
            return Ok(Self::default());
        }
        let entry = |group: &Group, name: &str, row: usize| -> hdf5::Result<usize> {
            let values: Vec<i64> = group.dataset(name)?.read_raw()?;
            let value = values.get(row).ok_or_else(|| format!("{name} has no entry {row}"))?;
            Ok((*value).max(0) as usize)
        };
        let of_steps = root.group("Steps")?;
        let last = Offsets {
            meshes: entry(&of_steps, "PartOffsets", steps - 1)?,
            points: entry(&of_steps, "PointOffsets", steps - 1)?,
            cells: entry(&of_steps, "CellOffsets", steps - 1)?,
            connectivity: entry(&of_steps, "ConnectivityIdOffsets", steps - 1)?,
        };
        let cells = entry(root, "NumberOfCells", last.meshes)?;
        let next = Offsets {
            meshes: last.meshes + 1,
            points: last.points + entry(root, "NumberOfPoints", last.meshes)?,
            cells: last.cells + cells,
            connectivity: last.connectivity + entry(root, "NumberOfConnectivityIds", last.meshes)?,
        };
        let data = of_steps.group("CellDataOffsets")?;
        let field_rows = match data.member_names()?.first() {
            Some(name) => entry(&data, name, steps - 1)? + cells,
            None => 0,
        };
        Ok(Self { steps, last, next, field_rows })
    }
}
