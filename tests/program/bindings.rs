//! The Python package, by its own tests.

use crate::python::{pytest, root};

#[test]
fn the_package_installs_from_source_and_passes_its_tests() {
    pytest(&root().join("crates/pycav"));
}
