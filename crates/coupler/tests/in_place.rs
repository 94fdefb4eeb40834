//! Frames are written and read where they lie in shared memory. Alone in its binary for the sake of the allocator.

#![allow(clippy::unwrap_used)]

use std::alloc::{GlobalAlloc, Layout, System};
use std::fs;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use coupler::{Endpoint, FrameHeader, FrameKind, Link, Participant, ProcessLink, direct_pair};

const FIELDS: u64 = 4;
const COUNT: u64 = 5000;
const FRAME: usize = 8 * (FIELDS * COUNT) as usize;

/// Counts allocations that could hold a frame.
struct Counting;

static LARGE: AtomicUsize = AtomicUsize::new(0);

fn note(size: usize) {
    if size >= FRAME {
        LARGE.fetch_add(1, Ordering::Relaxed);
    }
}

// SAFETY: everything is handed to the system's allocator unchanged.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        note(layout.size());
        unsafe { System.alloc(layout) }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        note(layout.size());
        unsafe { System.alloc_zeroed(layout) }
    }

    unsafe fn realloc(&self, ptr: *mut u8, layout: Layout, new_size: usize) -> *mut u8 {
        note(new_size);
        unsafe { System.realloc(ptr, layout, new_size) }
    }

    unsafe fn dealloc(&self, ptr: *mut u8, layout: Layout) {
        unsafe { System.dealloc(ptr, layout) }
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

fn trace(step: u64) -> FrameHeader {
    FrameHeader { step, count: COUNT, fields: FIELDS, ..FrameHeader::new(FrameKind::Trace) }
}

/// Which shared object this address belongs to, and where in it: `(inode, offset)`.
fn shared_object(prefix: &str, address: usize) -> Option<(String, usize)> {
    let maps = fs::read_to_string("/proc/self/maps").unwrap();
    maps.lines().find_map(|line| {
        let words: Vec<&str> = line.split_whitespace().collect();
        let (from, to) = words[0].split_once('-')?;
        let hex = |word| usize::from_str_radix(word, 16).unwrap();
        let inside = (hex(from)..hex(to)).contains(&address);
        let ours = words.get(5).is_some_and(|path| path.starts_with(&format!("/dev/shm/{prefix}")));
        (inside && ours).then(|| (words[4].to_owned(), hex(words[2]) + address - hex(from)))
    })
}

#[test]
fn frames_are_written_and_read_in_shared_memory_without_a_copy() {
    let run_id = format!("in-place-{}", std::process::id());
    let there = Endpoint::new(run_id.clone(), Participant::Solid, [3; 32]);
    let prefix = there.domain.prefix.clone();
    let here_prefix = prefix.clone();
    let (tell, seen) = mpsc::channel();
    let solid = thread::spawn(move || {
        let mut link = ProcessLink::connect(there).unwrap();
        for step in 0..30 {
            link.receive(|frame| {
                assert!(frame.row(3).iter().all(|number| *number == step as f64));
                let place = (step == 20).then(|| shared_object(&prefix, frame.payload.as_ptr().addr()));
                tell.send(place).unwrap();
            })
            .unwrap();
        }
    });
    let mut link = ProcessLink::connect(Endpoint::new(run_id, Participant::Fluid, [3; 32])).unwrap();
    let mut warm = 0;
    for step in 0..30 {
        let mut written = None;
        if step == 10 {
            warm = LARGE.load(Ordering::Relaxed);
        }
        link.send(trace(step), |payload| {
            payload.fill(step as f64);
            if step == 20 {
                written = shared_object(&here_prefix, payload.as_ptr().addr());
            }
        })
        .unwrap();
        let read = seen.recv().unwrap();
        if step == 20 {
            assert!(written.is_some(), "filled outside shared memory");
            assert_eq!(read, Some(written), "read elsewhere than it was written");
        }
    }
    assert_eq!(LARGE.load(Ordering::Relaxed), warm, "allocations of a frame's size");
    solid.join().unwrap();

    // In one process: the mailbox keeps its buffer.
    let (mut fluid, mut solid) = direct_pair([3; 32]);
    let mut exchange = |step| {
        fluid.send(trace(step), |payload| payload.fill(1.0)).unwrap();
        solid.receive(|frame| assert_eq!(frame.payload[0], 1.0)).unwrap();
    };
    exchange(0);
    let warm = LARGE.load(Ordering::Relaxed);
    (1..20).for_each(&mut exchange);
    assert_eq!(LARGE.load(Ordering::Relaxed), warm, "allocations of a frame's size");
}
