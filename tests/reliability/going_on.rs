//! A run that is cut off and taken up again, over and over, leaves what an undisturbed one does: every dataset to the last bit,
//! for every scheme and model, on an adaptive grid, with local and different steps, under other numbers of threads.

use std::path::Path;
use std::time::Duration;

use cav::case::Case;
use cav::output::RunDirectory;
use cav::run::checkpoints::Checkpoints;
use cav::run::process::drive::{Keeping, in_process};
use cav::run::process::session::{Session, Solvers};
use cav::run::process::stop::Stop;
use cav::run::record::conclusion::conclude;
use cav::run::side::fluid_side::Turn;

use crate::cases::{coupled, fluid_alone, growing, loaded, second_bubble, solid};
use crate::compare::{assert_same, datasets, summary};
use crate::processes::without_processes;

/// Never, within a test.
const NEVER: Duration = Duration::from_secs(1 << 20);

fn pool(threads: usize) -> rayon::ThreadPool {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap()
}

fn undisturbed(case: &Case, path: &Path) {
    let directory = RunDirectory::prepare(path, false).unwrap();
    in_process(case, &directory, Keeping::default(), &Stop::default(), &mut |_| {}).unwrap();
    conclude(&directory, case, None).unwrap();
}

/// Runs a case in pieces of `piece` steps. After each a checkpoint is kept; then some more steps are made and written, and all
/// that is in memory is lost.
///
/// - returns: how many pieces there were.
fn in_pieces(case: &Case, path: &Path, piece: usize) -> usize {
    drop(RunDirectory::prepare(path, false).unwrap());
    let mut pieces = 0;
    loop {
        let directory = RunDirectory::resume(path).unwrap();
        let from = Checkpoints::of(case, &directory).newest(|warning| panic!("{warning}")).unwrap();
        assert_eq!(from.is_some(), pieces > 0);
        let is_over = pool(1 + pieces % 3).install(|| {
            let mut session = match from {
                Some(step) => Session::resume(case, &directory, step).unwrap(),
                None => Session::new(case, Some(&directory), Solvers::default()).unwrap(),
            };
            let stop = Stop::default();
            let mut result = Ok(Turn::Continues);
            // More steps than to the checkpoint, and not always as many.
            for step in 0..piece + 1 + pieces % 4 {
                session.keep_checkpoints(
                    case,
                    &directory,
                    if step == piece - 1 { Duration::ZERO } else { NEVER },
                );
                result = session.step(&stop);
                if !matches!(result, Ok(Turn::Continues)) {
                    session.end(Some(&directory), result).unwrap();
                    return true;
                }
            }
            assert!(matches!(result, Ok(Turn::Continues)));
            if pieces % 2 == 0 {
                session.flush().unwrap();
            }
            false
        });
        pieces += 1;
        if is_over {
            conclude(&directory, case, None).unwrap();
            let kept = std::fs::read_dir(path.join("checkpoints")).unwrap().count();
            assert!((1..=2).contains(&kept), "a finished run keeps its last checkpoint, not {kept} parts");
            return pieces;
        }
    }
}

fn check(what: &str, text: &str, sets: &[&str], piece: usize) {
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    let case = Case::from_toml(text, "pieces", &sets).unwrap_or_else(|errors| panic!("{what}: {errors}"));
    let workshop = tempfile::tempdir().unwrap();
    let [whole, parts] = ["whole", "parts"].map(|name| workshop.path().join(name));
    undisturbed(&case, &whole);
    let pieces = in_pieces(&case, &parts, piece);
    assert!(pieces > 3, "{what}: only {pieces} pieces");
    assert!(assert_same(what, &whole, &parts, true) > 20, "{what}");
}

/// Tests that check one case after the other: what it is, its text, what is set, after how many steps each piece ends.
macro_rules! goes_on {
    ($($name:ident: $(($what:literal, $text:expr, [$($set:expr),*], $piece:literal)),+;)+) => {
        $(
            #[test]
            fn $name() {
                let _turn = without_processes();
                $(check($what, &$text, &[$($set),*], $piece);)+
            }
        )+
    };
}

/// A solid whose waves are no faster than the liquid's.
const SOFT: &str = "solid.material={ density = 1100.0, c1 = 1550.0, c2 = 20.0 }";
/// Friction that is felt on these grids.
const THICK: &str = "fluid.terms.viscosity={ liquid = 1e2, gas = 1.0 }";

goes_on! {
    the_riemann_scheme:
        ("riemann", coupled(), [], 31),
        ("short pieces", coupled(), ["time.end=1e-5"], 7);
    the_five_equation_model: ("five-equation", coupled(), ["fluid.model=five-equation"], 37);
    steps_that_are_the_same_on_both_sides: ("one step", coupled(), ["coupling.step_ratio=1", "time.end=2e-5"], 41);
    local_steps_where_the_fluids_are_the_longer: ("local", coupled(), ["time.local_steps=true"], 13);
    local_steps_where_the_solids_are_the_longer:
        ("soft", coupled(), [SOFT, "time.local_steps=true", "time.end=2e-5"], 5),
        ("soft, common", coupled(), [SOFT, "time.end=2e-5"], 9);
    viscous_fluids:
        ("viscous", coupled(), [THICK, "time.local_steps=true", "time.end=2e-5"], 7),
        ("viscous, five-equation", coupled(), [THICK, "fluid.model=five-equation", "time.end=2e-5"], 13);
    several_bubbles: ("bubbles", (coupled() + &second_bubble()), ["time.end=2e-5"], 23);
    a_fluid_alone:
        ("fluid", fluid_alone(), [], 43),
        ("fluid, local", fluid_alone(), ["time.local_steps=true", "fluid.model=five-equation"], 17);
    a_solid_under_a_load:
        ("load", loaded(), [], 7),
        ("load, local", loaded(), ["time.local_steps=true"], 5);
    a_solid_alone:
        ("solid", solid(), [], 11),
        ("solid, local", solid(), ["time.local_steps=true"], 5);
}

#[test]
fn the_weak_scheme() {
    let _turn = without_processes();
    for kappa in ["off", "printed", "jump"] {
        let sets = ["coupling.scheme=weak", &format!("coupling.kappa={kappa}"), "time.end=2e-5"];
        check(&format!("weak, {kappa}"), &coupled(), &sets, 41);
    }
}

#[test]
fn the_papers_other_schemes() {
    let _turn = without_processes();
    for scheme in ["explicit", "weak", "strong"] {
        for first in ["fluid", "solid"] {
            if scheme == "explicit" && first == "solid" {
                continue;
            }
            let mut sets = vec![format!("coupling.scheme={scheme}"), "time.end=1.2e-5".to_owned()];
            if scheme != "explicit" {
                sets.push(format!("coupling.first={first}"));
            }
            let sets: Vec<&str> = sets.iter().map(String::as_str).collect();
            check(&format!("{scheme}, {first} first"), &coupled(), &sets, 29);
        }
    }
}

#[test]
fn a_bubble_that_grows_and_whose_gas_is_cut() {
    let _turn = without_processes();
    check("cut", &growing(), &[], 43);
    check(
        "cut, local, the paper's mixture",
        &growing(),
        &["time.local_steps=true", "fluid.model=saurel-abgrall"],
        17,
    );
    // It has been cut, once, and the ledgers know.
    let case = Case::from_toml(&growing(), "cut", &[]).unwrap();
    let workshop = tempfile::tempdir().unwrap();
    undisturbed(&case, &workshop.path().join("run"));
    let told = summary(&workshop.path().join("run"));
    let number = |key: &str| told[key].as_f64().unwrap_or_else(|| panic!("no {key} in {told:#}"));
    assert!(number("reset_time") < number("collapse_time"), "{told:#}");
    assert!((number("reset_time") / number("growth_time") - 1.0).abs() < 0.02, "{told:#}");
    assert!((number("reset_equivalent_radius") / number("max_equivalent_radius") - 1.0).abs() < 1e-3);
    let kept = number("reset_gas_mass_after") / number("reset_gas_mass_before");
    assert!((kept / 0.125 - 1.0).abs() < 0.2, "{kept}");
    let history = hdf5::File::open(workshop.path().join("run/history.h5")).unwrap();
    let column = |name: &str| -> Vec<f64> {
        history.dataset(&format!("conservation/fluid/{name}")).unwrap().read_raw().unwrap()
    };
    let [mass, energy, floor] = ["mass", "energy", "energy_from_floor"].map(column);
    let sides = |what: &str| -> Vec<f64> {
        let all = ["z_min", "z_max", "r_min", "r_max"].map(|side| column(&format!("{what}_in_{side}")));
        (0..mass.len()).map(|row| all.iter().map(|side| side[row]).sum()).collect()
    };
    let (mass_in, energy_in) = (sides("mass"), sides("energy"));
    let [cut_mass, cut_energy] = ["mass_from_reset", "energy_from_reset"].map(column);
    assert!(cut_mass[0] == 0.0 && cut_mass.last().is_some_and(|cut| *cut < 0.0));
    for row in 0..mass.len() {
        let off = [
            (mass[row] - mass[0] - mass_in[row] - cut_mass[row]) / mass[0],
            (energy[row] - energy[0] - energy_in[row] - cut_energy[row] - floor[row]) / energy[0],
        ];
        assert!(off.iter().all(|part| part.abs() < 1e-12), "row {row}: {off:?}");
    }
}

#[test]
fn phases_that_change_into_each_other() {
    let _turn = without_processes();
    let media = ["fluid.liquid={fluid = \"water-nasg\"}", "fluid.gas={fluid = \"water-vapour\"}"];
    let terms = "fluid.terms={phase_change={law=\"ptg\", vapour_fraction=0.8}, cavitation={threshold=-1e5}}";
    check("phases", &fluid_alone(), &[media[0], media[1], terms, "time.local_steps=true"], 17);
}

/// All terms together, with as much of each as a bubble of micrometres has; heat and momentum spread in stages.
#[test]
fn all_terms_above_a_wall_that_conducts() {
    let _turn = without_processes();
    let sets = [
        "fluid.liquid={fluid = \"water-nasg\"}",
        "fluid.gas={fluid = \"water-vapour\"}",
        "fluid.terms.surface_tension=70.0",
        "fluid.terms.contact_angle=90.0",
        "fluid.terms.viscosity={liquid=10.0, gas=0.05, thin_gas=\"super-time-stepping\"}",
        "fluid.terms.conduction={liquid=6e3, gas=30.0, thin_gas=\"super-time-stepping\", wall=\"conducting\", wall_temperature=293.15}",
        "fluid.terms.phase_change={law=\"hertz-knudsen\", accommodation=0.5, vapour_fraction=0.8}",
        "fluid.terms.cavitation={threshold=-1e5}",
        "time.local_steps=true",
    ];
    check("all terms", &coupled(), &sets, 29);
}

/// The comparison sees a number that is off by one bit.
#[test]
fn one_bit_would_be_seen() {
    let _turn = without_processes();
    let case = Case::from_toml(&solid(), "bit", &[]).unwrap();
    let workshop = tempfile::tempdir().unwrap();
    undisturbed(&case, &workshop.path().join("one"));
    undisturbed(&case, &workshop.path().join("other"));
    let path = workshop.path().join("other/solid.vtkhdf");
    let file = hdf5::File::open_rw(&path).unwrap();
    let dataset = file.dataset("VTKHDF/CellData/stress_zz").unwrap();
    let mut numbers: Vec<f64> = dataset.read_raw().unwrap();
    numbers[777] = f64::from_bits(numbers[777].to_bits() ^ 1);
    dataset.write(&numbers).unwrap();
    file.close().unwrap();
    let seen = std::panic::catch_unwind(|| {
        assert_same("bit", &workshop.path().join("one"), &workshop.path().join("other"), true)
    });
    assert!(seen.is_err());
    assert!(datasets(&path).len() > 10);
}
