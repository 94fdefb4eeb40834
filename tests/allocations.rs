//! A step of a coupled run makes no allocation of the size of a frame's row.

#![allow(unsafe_code)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};

use cav::case::Case;
use cav::run::process::stop::Stop;
use cav::run::side::RunSide;
use cav::run::side::fluid_side::{FluidSide, Turn};
use cav::run::side::solid_side::SolidSide;
use coupler::direct_pair;

mod fixture;

use fixture::{THIN_GAS, bubble, grid, steel, water};

/// Counts allocations of at least [`SIZE`] bytes.
struct Counting;

static SIZE: AtomicUsize = AtomicUsize::new(usize::MAX);
static COUNT: AtomicU64 = AtomicU64::new(0);

fn count(size: usize) {
    if size >= SIZE.load(Ordering::Relaxed) {
        COUNT.fetch_add(1, Ordering::Relaxed);
    }
}

// SAFETY: every call is handed on to the system's allocator as it came.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        count(layout.size());
        // SAFETY: the caller's promises are the system allocator's demands.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        // SAFETY: as above.
        unsafe { System.dealloc(pointer, layout) }
    }

    unsafe fn realloc(&self, pointer: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        count(size);
        // SAFETY: as above.
        unsafe { System.realloc(pointer, layout, size) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

/// A bubble over steel, 1024 fluid faces on 768 solid ones: rows longer than what the thread pool allocates for itself.
fn case(sets: &[&str]) -> Case {
    let text = [
        "[time]\nend = 1e-4\n",
        &water(&grid([0.01, 0.06], 0.05, [16, 1024]), 5e7),
        &bubble([0.03, 0.0], 0.01, THIN_GAS),
        &steel(&grid([-0.04, 0.01], 0.05, [16, 768])),
    ];
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    Case::from_toml(&text.concat(), "allocations", &sets).unwrap_or_else(|errors| panic!("{errors}"))
}

// One function: the counter is the whole process's.
#[test]
fn a_coupled_step_allocates_nothing_of_a_rows_size() {
    let threads = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
    let weak = "coupling.scheme=weak";
    let common = "coupling.step_ratio=1";
    // Of gelatine, whose steps are the longer ones.
    let soft = ["solid.material={ density = 1100.0, c1 = 1550.0, c2 = 20.0 }", "time.cfl=0.4"];
    let weak_too = [
        &[][..],
        &[common],
        &soft,
        &[weak],
        &[weak, "coupling.kappa=printed"],
        &["coupling.scheme=explicit"],
        &["coupling.scheme=strong"],
        &["coupling.scheme=strong", "coupling.first=solid"],
        &[weak, "coupling.kappa=jump"],
    ];
    for sets in weak_too {
        let count = threads.install(|| allocations(sets));
        assert_eq!(count, 0, "{sets:?}");
    }
}

/// Allocations of the size of the shorter side's row in 20 steps.
fn allocations(sets: &[&str]) -> u64 {
    let case = case(sets);
    let (Some(fluid), Some(solid)) = (&case.fluid, &case.solid) else { panic!("both media") };
    let mut fluid = FluidSide::new(&case, fluid, None).expect("the fluid");
    let mut solid = SolidSide::new(&case, solid, None).expect("the solid");
    let (mut to_solid, mut to_fluid) = direct_pair(case.hash());
    let stop = Stop::default();
    solid.open(&mut to_fluid, &stop).expect("opens");
    let mut round = || {
        while !fluid.complete(&mut to_solid).expect("the fluid's step") {
            solid.turn(&mut to_fluid, &stop).expect("the solid's trial");
        }
        solid.settle(&mut to_fluid).expect("the solid's step");
        assert_eq!(fluid.begin(&mut to_solid, &stop).expect("the fluid's turn"), Turn::Continues);
        assert_eq!(solid.turn(&mut to_fluid, &stop).expect("the solid's turn"), Turn::Continues);
    };
    // What grows once, grows here.
    (0..5).for_each(|_| round());
    COUNT.store(0, Ordering::Relaxed);
    SIZE.store(768 * size_of::<f64>(), Ordering::Relaxed);
    (0..20).for_each(|_| round());
    SIZE.store(usize::MAX, Ordering::Relaxed);
    COUNT.load(Ordering::Relaxed)
}
