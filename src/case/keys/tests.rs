//! The table of keys is what the reader reads by, and says what is so.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use toml::de::DeTable;

use super::declared::{Interval, Preset, Values};
use super::{describe_keys, keys_page, links, sections, seen};
use crate::case::reader::{Faults, Table};
use crate::case::{Case, read};

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// What no shipped case has, beside a good fluid and a good solid.
const RARE: [&str; 8] = [
    "region_of_interest = {}",
    "fluid = { bubble = { region = 0, reset = {} } }",
    "fluid = { terms = { phase_change = {}, cavitation = {}, conduction = {} } }",
    "fluid = { near_wall = {}, refine = [{ shape = 'sphere' }, { shape = 'box' }, { shape = 'interface' }] }",
    "fluid = { region = [{ shape = 'box' }], tracer = { shape = 'sphere' }, pulse = [{ shape = 'plane' }] }",
    "fluid = { z = [0, 1], r = [0, 1], cells = [16, 16], liquid = { gamma = 7, pi = 3e8 }, \
     ambient = { density = 1e3, pressure = 1e5 }, tracer = { shape = 'box' }, boundary = { z_max = 'inflow' }, \
     inflow = {}, gas = {}, terms = { viscosity = {} } }",
    "solid = { refine = [{ shape = 'sphere' }, { shape = 'box' }], material = {}, plasticity = {}, pulse = [{}], boundary = {} }\n\
     probe = [{}]\nsensor = [{}]\noutput = {}\ntime = {}",
    "coupling = { scheme = 'load', load = {} }\ntime = { end = 'settled' }",
];

#[test]
fn every_key_that_is_declared_is_asked_for() {
    for directory in ["cases", "cases/validation"] {
        for entry in fs::read_dir(root().join(directory)).expect("cases").flatten() {
            if entry.path().extension().is_some_and(|extension| extension == "toml") {
                Case::load(&entry.path(), &[]).expect("a shipped case is right");
            }
        }
    }
    for text in RARE.iter().map(|text| (*text).to_owned()).chain([
        // The keys of a recorded load, and those of a side that is free.
        "coupling = { scheme = 'load', load = { run = 'x' } }".to_owned(),
        format!(
            "geometry = 'planar'\ncoupling = {{ scheme = 'none' }}\n{}",
            RARE[4].replace("z_max", "z_min")
        ),
        format!("geometry = 'planar'\ncoupling = {{ scheme = 'none' }}\n{}", RARE[5]),
    ]) {
        let faults = read::case(&text, "rare").expect_err("none of them is whole");
        for fault in &faults {
            assert!(!fault.message.contains("defect"), "{fault}");
        }
    }
    let asked = seen::all();
    let declared = sections().flat_map(|section| section.keys.iter().map(|key| section.path_of(key)));
    let idle: Vec<String> = declared.filter(|path| !asked.contains(path)).collect();
    assert!(idle.is_empty(), "declared, and asked for by no case: {idle:?}");
}

#[test]
fn a_key_that_is_not_declared_makes_a_case_unreadable() {
    let document = DeTable::parse("levels = 3\nlimiter = \"mc\"").expect("TOML");
    let faults_of = |ask: fn(&mut Table<'_>, &mut Faults)| {
        let (mut table, mut faults) = (Table::root(&document), Faults::default());
        table.path = "fluid".to_owned();
        ask(&mut table, &mut faults);
        let _ = (table.raw("levels"), table.raw("limiter"));
        table.finish(&mut faults);
        faults.0.iter().map(ToString::to_string).collect::<Vec<_>>().join("; ")
    };
    assert_eq!(faults_of(|_, _| {}), "");
    let said = faults_of(|table, _| {
        table.raw("colour");
    });
    assert!(
        said.contains("fluid.colour: a defect of this program") && said.contains("not declared"),
        "{said}"
    );
    let names = faults_of(|table, faults| {
        table.choice("limiter", &[("mc", 1), ("new", 2)], faults);
    });
    assert!(names.contains("its names are not those"), "{names}");
    let range = faults_of(|table, faults| {
        table.whole("limiter", faults);
    });
    assert!(range.contains("its range is not declared"), "{range}");
}

#[test]
fn defaults_are_allowed_and_no_key_stands_twice() {
    let mut paths = BTreeSet::new();
    for (section, key) in sections().flat_map(|section| section.keys.iter().map(move |key| (section, key))) {
        let path = section.path_of(key);
        assert!(paths.insert(path.clone()), "{path} is declared twice");
        let is_allowed = match (key.default, key.values) {
            (Preset::Name(default), Values::Names(names)) => names.iter().any(|(name, _)| *name == default),
            (Preset::Name(_), Values::Words(_)) => true,
            (Preset::Name(_), _) => false,
            (Preset::Whole(default), Values::Whole(low, high)) => (low..=high).contains(&default),
            (Preset::Number(default), Values::Within(interval)) => interval.contains(default),
            (Preset::Flag(_), values) => matches!(values, Values::Flag),
            _ => true,
        };
        assert!(is_allowed, "{path}: {:?} is none of {:?}", key.default, key.values);
    }
    assert!(paths.len() > 100);
}

#[test]
fn links_lead_to_headings_that_are_there() {
    for (name, target) in links::LINKS {
        let (page, heading) = target.split_once('#').unwrap_or((target, ""));
        let text = fs::read_to_string(root().join(page)).unwrap_or_else(|error| panic!("{page}: {error}"));
        let slug = |line: &str| -> String {
            let words = line.trim_start_matches('#').trim().to_lowercase().replace(' ', "-");
            words.chars().filter(|c| c.is_alphanumeric() || matches!(c, '-' | '_')).collect()
        };
        let is_there = heading.is_empty()
            || text.lines().filter(|line| line.starts_with('#')).any(|line| slug(line) == heading);
        assert!(is_there, "{target} has no such heading");
        assert!(keys_page().contains(&format!("]({}", links::from_page(target))), "nothing leads to {name}");
    }
    assert!(!keys_page().contains("]["), "a link without a page: {}", keys_page());
}

#[test]
fn sentences_are_short() {
    for section in sections() {
        let of_keys = section.keys.iter().map(|key| key.about);
        for text in std::iter::once(section.about).chain(of_keys) {
            for sentence in text.split(['.', ':', ';']) {
                let words = sentence.split_whitespace().count();
                assert!(words <= 30, "{words} words: {sentence}");
            }
        }
    }
}

#[test]
fn a_path_gives_a_table_a_key_or_the_nearest_names() {
    let said = |path: &str| describe_keys(Some(path)).unwrap_or_else(|error| panic!("{error}"));
    let epsilon = said("fluid.epsilon");
    assert!(
        epsilon.starts_with("fluid.epsilon\n") && epsilon.contains("default: 3/100 of error"),
        "{epsilon}"
    );
    assert!(epsilon.contains("Instead of error"), "{epsilon}");
    let radius = said("fluid.region.0.radius");
    assert!(radius.starts_with("fluid.region.radius  [m]\n"), "{radius}");
    let boundary = said("fluid.boundary");
    for part in ["[fluid.boundary]  ", "z_min\n", "\"far-field\" ", "see docs/"] {
        assert!(boundary.contains(part), "no `{part}` in {boundary}");
    }
    assert!(!boundary.contains("[fluid.region]") && !boundary.contains('`'), "{boundary}");
    let both = said("epsilon");
    assert!(both.contains("fluid.epsilon\n") && both.contains("solid.epsilon\n"), "{both}");
    assert!(said("refine").contains("[[solid.refine]]"));
    assert!(said("solid.material").contains("[solid.material]"));
    let fluid = said("fluid");
    assert!(fluid.contains("[[fluid.region]]") && !fluid.contains("[solid]"), "{fluid}");
    for (wrong, nearest) in [
        ("fluid.boundry", "fluid.boundary"),
        ("epsilonn", "fluid.epsilon"),
        ("fluid.region.radus", "fluid.region.radius"),
        ("output.snapshot_every", "time.snapshot_every"),
        ("tracr", "fluid.tracer"),
    ] {
        let error = describe_keys(Some(wrong)).expect_err("it is not there");
        assert!(error.nearest.iter().any(|path| path == nearest), "{wrong}: {error}");
    }
    let error = describe_keys(Some("quite.another.thing")).expect_err("it is not there");
    assert!(error.nearest.is_empty() && error.to_string().contains("`cav keys` lists all"), "{error}");
    let all = describe_keys(None).expect("all");
    for section in sections() {
        assert!(all.contains(&section.head()), "{}", section.path);
    }
    assert!(all.lines().all(|line| line.chars().count() <= 110), "{all}");
}

#[test]
fn intervals_are_written_and_have_their_ends() {
    let share = Interval::open(0.0, 1.0);
    assert_eq!(
        (share.to_string(), share.contains(0.0), share.contains(1.0)),
        ("(0, 1)".into(), false, false)
    );
    let cfl = Interval::above(0.0, 0.9);
    assert_eq!(
        (cfl.to_string(), cfl.contains(0.9), cfl.contains(f64::NAN)),
        ("(0, 0.9]".into(), true, false)
    );
    assert_eq!(Interval::closed(1e-3, 1e9).to_string(), "[0.001, 1e9]");
}
