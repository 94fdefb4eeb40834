//! Fields of a snapshot: declared once, with all that files and case readers want to know of them.

/// A field of the snapshots `S`, one or three numbers a cell.
#[derive(Debug)]
pub struct CellField<S: 'static> {
    /// As in case files and in snapshots.
    pub name: &'static str,
    /// 1 for a scalar, 3 for a vector (z, r, 0).
    pub components: usize,
    /// SI unit, as `kg/m3`; `1` for a pure number.
    pub unit: &'static str,
    /// What it is, in a few words.
    pub description: &'static str,
    /// Its numbers.
    pub values: fn(&mut S) -> &mut Vec<f64>,
}

/// Declares a snapshot: a struct with a vector for each field, and the table of its [`CellField`]s in this order. An output field is
/// added here, and where the snapshot is filled.
#[macro_export]
macro_rules! cell_fields {
    ($Snapshot:ident, $FIELDS:ident {
        $($name:ident: $components:literal, $unit:literal, $description:literal;)*
    }) => {
        /// The fields of a snapshot, cell by cell: blocks in the order of their slots, rows of r, z within a row.
        #[derive(Clone, Debug, Default, PartialEq)]
        pub struct $Snapshot {
            $(#[doc = concat!($description, ", ", $unit, ".")] pub $name: Vec<f64>,)*
        }

        /// What a snapshot holds.
        pub const $FIELDS: &[$crate::CellField<$Snapshot>] = &[
            $($crate::CellField {
                name: stringify!($name),
                components: $components,
                unit: $unit,
                description: $description,
                values: |snapshot: &mut $Snapshot| &mut snapshot.$name,
            }),*
        ];
    };
}
