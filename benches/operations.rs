//! What one number costs this machine: `cargo bench --bench operations` prints nanoseconds per division, root, sum, load and
//! store, in the widest registers that there are and in those of AVX2. Loops of nothing else, one thread.
//!
//! Times the counts of `scripts/instruction_counts.py` that is what a step must cost at least: `docs/performance/fluid-limit.md`.

#![allow(clippy::print_stdout, reason = "the table is what the program is for")]

use std::hint::black_box;
use std::time::Instant;

/// Numbers in a row: with its neighbours it stays in the first-level cache.
const ROW: usize = 1024;
/// A row that begins a cache line: no register's numbers are in two.
#[repr(align(64))]
struct Row([f64; ROW]);

/// Rows per sample.
const REPEATS: usize = 2000;
/// Samples; the least counts, since nothing makes a loop faster than it is.
const SAMPLES: usize = 30;

/// What is timed, in the order of the functions of a [`Width`].
const NAMES: [&str; 5] = ["divisions", "roots", "sums and products", "loads", "stores"];

/// One row of each operation, in registers of one width; numbers that each works on.
type Operation = fn(&mut [f64; ROW], &[f64; ROW]) -> usize;
type Width = [Operation; NAMES.len()];

fn main() {
    let widths = widths();
    if widths.is_empty() {
        println!("this machine has neither AVX2 nor AVX-512");
        return;
    }
    let heads: Vec<String> = widths.iter().map(|(name, _)| format!(" {name}, ns each |")).collect();
    println!("| |{}\n|---|{}", heads.concat(), "---|".repeat(widths.len()));
    for (k, name) in NAMES.iter().enumerate() {
        let cells: Vec<String> =
            widths.iter().map(|(_, width)| format!(" {:.4} |", nanoseconds(width[k]))).collect();
        println!("| {name} |{}", cells.concat());
    }
}

/// The registers that this machine has.
#[cfg(target_arch = "x86_64")]
fn widths() -> Vec<(&'static str, Width)> {
    let avx2 = is_x86_feature_detected!("avx2").then_some(("AVX2", wide::AVX2));
    let avx512 = is_x86_feature_detected!("avx512f").then_some(("AVX-512", wide::AVX512));
    avx2.into_iter().chain(avx512).collect()
}

#[cfg(not(target_arch = "x86_64"))]
fn widths() -> Vec<(&'static str, Width)> {
    Vec::new()
}

/// Nanoseconds per number.
fn nanoseconds(operation: Operation) -> f64 {
    let from = Row(std::array::from_fn(|k| 1.0 + 0.37 * k as f64));
    let mut to = Row(from.0);
    let sample = |Row(to): &mut Row| {
        let start = Instant::now();
        let mut numbers = 0;
        for _ in 0..REPEATS {
            numbers += operation(black_box(&mut *to), black_box(&from.0));
        }
        start.elapsed().as_secs_f64() * 1e9 / numbers as f64
    };
    (0..SAMPLES).map(|_| sample(&mut to)).fold(f64::INFINITY, f64::min)
}

#[cfg(target_arch = "x86_64")]
mod wide {
    use std::arch::x86_64::*;

    use super::{ROW, Width};

    /// The operations for one width of registers.
    ///
    /// - `$lanes`: numbers in a register; `$zero`, `$add`, `$mul`, `$div`, `$root`, `$load`, `$store`: its intrinsics.
    macro_rules! width {
        ($name:ident, $module:ident, $feature:literal, $lanes:literal,
         $zero:ident, $add:ident, $mul:ident, $div:ident, $root:ident, $load:ident, $store:ident) => {
            mod $module {
                use super::*;

                /// Registers that are added to: more than a sum takes cycles times those made in a cycle, and no more than AVX2 has.
                const SUMS: usize = 12;

                #[target_feature(enable = $feature)]
                fn divide(to: &mut [f64; ROW], from: &[f64; ROW]) -> usize {
                    for (to, from) in to.chunks_exact_mut($lanes).zip(from.chunks_exact($lanes)) {
                        // SAFETY: both chunks hold as many numbers as a register.
                        unsafe {
                            let from = $load(from.as_ptr());
                            $store(to.as_mut_ptr(), $div(from, $add(from, from)));
                        }
                    }
                    ROW
                }

                #[target_feature(enable = $feature)]
                fn root(to: &mut [f64; ROW], from: &[f64; ROW]) -> usize {
                    for (to, from) in to.chunks_exact_mut($lanes).zip(from.chunks_exact($lanes)) {
                        // SAFETY: as above.
                        unsafe { $store(to.as_mut_ptr(), $root($load(from.as_ptr()))) };
                    }
                    ROW
                }

                #[target_feature(enable = $feature)]
                fn sum(to: &mut [f64; ROW], from: &[f64; ROW]) -> usize {
                    // SAFETY: a row holds more numbers than a register.
                    let term = unsafe { $load(from.as_ptr()) };
                    let mut sums = [$zero(); SUMS];
                    for _ in 0..ROW / 16 {
                        for sum in &mut sums {
                            *sum = $add(*sum, term);
                        }
                        for sum in &mut sums {
                            *sum = $mul(*sum, term);
                        }
                    }
                    let all = sums.into_iter().fold($zero(), |all, sum| $add(all, sum));
                    // SAFETY: as above.
                    unsafe { $store(to.as_mut_ptr(), all) };
                    2 * SUMS * $lanes * (ROW / 16)
                }

                /// Adds rows up: a sum has its number from memory.
                #[target_feature(enable = $feature)]
                fn load(to: &mut [f64; ROW], from: &[f64; ROW]) -> usize {
                    const PASSES: usize = 8;
                    let mut sums = [$zero(); 8];
                    for _ in 0..PASSES {
                        for from in from.chunks_exact(8 * $lanes) {
                            for (sum, from) in sums.iter_mut().zip(from.chunks_exact($lanes)) {
                                // SAFETY: as above.
                                *sum = $add(*sum, unsafe { $load(from.as_ptr()) });
                            }
                        }
                    }
                    let all = sums.into_iter().fold($zero(), |all, sum| $add(all, sum));
                    // SAFETY: as above.
                    unsafe { $store(to.as_mut_ptr(), all) };
                    PASSES * ROW
                }

                #[target_feature(enable = $feature)]
                fn store(to: &mut [f64; ROW], from: &[f64; ROW]) -> usize {
                    // SAFETY: as above.
                    let number = unsafe { $load(from.as_ptr()) };
                    for to in to.chunks_exact_mut($lanes) {
                        // SAFETY: as above.
                        unsafe { $store(to.as_mut_ptr(), number) };
                    }
                    ROW
                }

                /// What `main` chooses where the machine has the registers.
                pub const OPERATIONS: Width = [
                    // SAFETY: main asks for the feature first.
                    |to, from| unsafe { divide(to, from) },
                    |to, from| unsafe { root(to, from) },
                    |to, from| unsafe { sum(to, from) },
                    |to, from| unsafe { load(to, from) },
                    |to, from| unsafe { store(to, from) },
                ];
            }
            pub const $name: Width = $module::OPERATIONS;
        };
    }

    width!(
        AVX2,
        avx2,
        "avx2",
        4,
        _mm256_setzero_pd,
        _mm256_add_pd,
        _mm256_mul_pd,
        _mm256_div_pd,
        _mm256_sqrt_pd,
        _mm256_loadu_pd,
        _mm256_storeu_pd
    );
    width!(
        AVX512,
        avx512,
        "avx512f",
        8,
        _mm512_setzero_pd,
        _mm512_add_pd,
        _mm512_mul_pd,
        _mm512_div_pd,
        _mm512_sqrt_pd,
        _mm512_loadu_pd,
        _mm512_storeu_pd
    );
}
