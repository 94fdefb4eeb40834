//! What the program is for those who start it: as a command, from Python, as the book says.
//!
//! Tests that take long and leave a core idle in between stand beside each other here. In the order of their names the package comes
//! first and the book last. All start processes, and none keeps a file of HDF5 open in this one: see `tests/output_kill.rs`.

mod bindings;
#[allow(clippy::unwrap_used, reason = "a run that cannot be started is a failure")]
mod every_number;
#[path = "../fixture/mod.rs"]
mod fixture;
mod python;
mod the_book;
