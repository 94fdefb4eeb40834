//! What reads bytes that others have made: none of them may panic, hang, or take memory without bounds.
//!
//! The same functions are run by cargo-fuzz for hours and by `tests/coupled/hostile.rs` for seconds.

#![allow(dead_code, clippy::unwrap_used)]

use std::cell::RefCell;
use std::fs;

use cav::case::Case;
use cav::output::checkpoint::{self, Head, VERSION, layout_of};
use cav::output::{RunDirectory, summary};
use cav::run::checkpoints::Checkpoints;
use cav::run::setup::{fluid_solver, solid_solver};
use cav::run::side::fluid_side::saved::FluidSideState;
use cav::run::side::solid_side::saved::SolidSideState;
use fluid::{FluidSolver, FluidState};
use mesh::BLOCK;
use sha2::{Digest, Sha256};
use solid::{SolidSolver, SolidState};

#[path = "frames.rs"]
pub mod frames;

pub use frames::interface_frame;

/// A small coupled case.
pub const SMALL: &str = include_str!("small.toml");

/// A case file: refused with a message, or read; and what is read is read the same from its effective text.
pub fn case_file(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    match Case::from_toml(text, "hostile", &[]) {
        Err(errors) => assert!(!errors.to_string().is_empty()),
        Ok(case) => {
            let written = case.effective_toml();
            let again =
                Case::from_toml(&written, "hostile", &[]).unwrap_or_else(|e| panic!("{e}\n{written}"));
            assert_eq!(case.hash(), again.hash(), "{written}");
        }
    }
}

thread_local! {
    /// What hostile states are restored into; made once.
    static SOLVERS: RefCell<(FluidSolver<BLOCK>, SolidSolver<BLOCK>)> = RefCell::new({
        let case = Case::from_toml(SMALL, "small", &[]).unwrap();
        (
            fluid_solver(&case, case.fluid.as_ref().unwrap()).unwrap(),
            solid_solver(&case, case.solid.as_ref().unwrap()).unwrap(),
        )
    });
}

/// The bytes as a file; and as the content of one whose checksum is right.
pub fn checkpoint(bytes: &[u8]) {
    let _ = checkpoint::decode::<FluidSideState<'static>>(bytes);
    let head = Head { program: String::new(), case: [0; 32], side: "fluid".to_owned(), step: 1 };
    let file = |layout: [u8; 32]| {
        let head = postcard::to_stdvec(&head).unwrap();
        let mut file = [&b"cav\0ckpt"[..], &VERSION.to_le_bytes(), &layout, &head, bytes].concat();
        let sum = Sha256::digest(&file);
        file.extend(sum);
        file
    };
    let (fluids, solids) =
        (file(layout_of::<FluidSideState<'static>>()), file(layout_of::<SolidSideState<'static>>()));
    let _ = checkpoint::decode::<FluidSideState<'static>>(&fluids);
    let _ = checkpoint::decode::<SolidSideState<'static>>(&solids);
    assert!(checkpoint::decode::<FluidSideState<'static>>(&solids).is_err(), "of another layout");
    SOLVERS.with_borrow_mut(|(fluid, solid)| {
        // Bytes after the state do not matter here: prefixes of whole checkpoints are states.
        if let Ok((state, _)) = postcard::take_from_bytes::<FluidState<'_, BLOCK>>(bytes) {
            let _ = fluid.restore(state);
        }
        if let Ok((state, _)) = postcard::take_from_bytes::<SolidState<'_>>(bytes) {
            let _ = solid.restore(state);
        }
    });
}

/// A run directory: the bytes in every file that `--resume` reads.
pub fn run_directory(bytes: &[u8]) {
    let place = tempfile::tempdir().unwrap();
    let case = Case::from_toml(SMALL, "small", &[]).unwrap();
    let directory = RunDirectory::resume(place.path()).unwrap();
    fs::write(directory.file("summary.json"), bytes).unwrap();
    let _ = summary::read(&directory.file("summary.json"));
    let checkpoints = Checkpoints::of(&case, &directory);
    fs::create_dir(directory.file("checkpoints")).unwrap();
    for name in ["fluid-000000000007.ckpt", "solid-000000000007.ckpt", "fluid-x.ckpt", "solid-1.ckpt.tmp"] {
        fs::write(directory.file("checkpoints").join(name), bytes).unwrap();
    }
    let name: String =
        String::from_utf8_lossy(bytes).chars().filter(|c| !"/\0".contains(*c)).take(40).collect();
    let _ = fs::write(directory.file("checkpoints").join(format!("fluid-{name}")), b"");
    assert!(!matches!(checkpoints.newest(|_| {}), Ok(Some(_))), "bytes of any kind are no checkpoint");
}
