//! Tests that start many processes, in a process of their own beside all others.
//!
//! A process that is started while a test has a file open gets that file, too, and with it the HDF5 library's lock on it, until it is
//! another program. Tests that start processes all the time and tests that keep files open do not go together in one.

use std::process::{Command, Stdio};

use crate::processes::{alone, text};

/// One after the other: they look for what runs leave in shared memory.
#[test]
fn both_sides_and_faults_of_runs_in_processes() {
    let mut tests = Command::new(std::env::current_exe().unwrap());
    tests.args(["--include-ignored", "--test-threads=1", "both_sides::", "faults::"]);
    tests.stdin(Stdio::null()).stdout(Stdio::piped()).stderr(Stdio::piped());
    let started = {
        let _turn = alone();
        tests.spawn().unwrap()
    };
    let output = started.wait_with_output().unwrap();
    let said = text(&output);
    assert!(output.status.success() && said.contains("2 passed; 0 failed; 0 ignored"), "{said}");
}
