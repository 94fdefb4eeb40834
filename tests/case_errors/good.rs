//! Cases that are right: read, written out, told apart.

use std::path::{Path, PathBuf};

use cav::case::{Case, LoadCase};
use fluid::PulseShape;

use crate::{good, good_text, with};

/// The case files of the repository.
fn shipped() -> Vec<PathBuf> {
    let dir = Path::new(env!("CARGO_MANIFEST_DIR")).join("cases");
    let mut paths: Vec<PathBuf> = [dir.clone(), dir.join("validation")]
        .iter()
        .flat_map(|dir| std::fs::read_dir(dir).expect("the cases are there"))
        .map(|entry| entry.expect("readable").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    paths.sort();
    assert!(paths.len() >= 4);
    paths
}

fn load(path: &Path) -> Case {
    Case::load(path, &[]).unwrap_or_else(|errors| panic!("{errors}"))
}

/// One of the cases that come with the program, changed.
fn of_file(name: &str, sets: &[&str]) -> Case {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("cases/{name}.toml"));
    let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
    Case::load(&path, &sets).unwrap_or_else(|errors| panic!("{errors}"))
}

/// Written out in full and read again, a case is the same, and so is its hash.
pub fn round_trip(case: &Case) {
    let text = case.effective_toml();
    let again = Case::from_toml(&text, &case.name, &[]).unwrap_or_else(|errors| panic!("{errors}\n{text}"));
    assert_eq!(again, *case, "{text}");
    assert_eq!(again.hash(), case.hash());
    assert_eq!(again.effective_toml(), text);
}

#[test]
fn shipped_cases_load_without_warnings_and_survive_being_written_out() {
    let listed =
        std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/reference/cases.md"))
            .expect("docs/reference/cases.md is there");
    for path in shipped() {
        let case = load(&path);
        assert!(case.warnings().is_empty(), "{}: {:?}", path.display(), case.warnings());
        round_trip(&case);
        let report = cav::case::report(&case);
        assert!(report.contains("time step") && report.contains("run time"), "{report}");
        let text = std::fs::read_to_string(&path).expect("readable");
        for part in ["# Source:", "# Expected", "# Cost:"] {
            assert!(text.contains(part), "{} does not say `{part}`", path.display());
        }
        let name = path.file_name().expect("a file").to_string_lossy().into_owned();
        assert!(listed.contains(&name), "docs/reference/cases.md does not list {name}");
    }
}

#[test]
fn every_kind_of_value_survives_being_written_out() {
    round_trip(&good());
    let all = with(&[
        "time.snapshot_every=3.1e-7",
        "fluid.riemann=exact",
        "fluid.limiter=eno",
        "fluid.initial_pressure=rayleigh",
        "fluid.boundary={ z_max = \"inflow\", r_max = \"wall\" }",
        "fluid.inflow.pressure=[[0, 1e6], [0.1e-6, 2e7]]",
        "fluid.pulse=[{ shape = \"plane\", centre = 0.008, width = 1e-3, amplitude = 1e5, direction = [-2, 0] }, \
         { shape = \"sphere\", centre = [0.008, 0], width = 1e-3, amplitude = 1e5 }]",
        "solid.material={ name = \"m\\\"x\", density = 7850, young = 210e9, poisson = 0.29, yield_strength = 3e8 }",
        "solid.initial_stress=hydrostatic",
        "solid.pulse=[{ centre = [-0.004, 0.0], width = 1e-3, amplitude = 1e-9 }]",
        "fluid.epsilon=2e-4",
        "fluid.adapt_every=3",
        "fluid.scale_density=7.5",
        "fluid.refine=[{ shape = \"sphere\", centre = [0.004, 0.0], radius = 1e-3, at_least = 3 }, \
         { shape = \"sphere\", centre = [0.004, 0.0], radius = 5e-3, where = \"outside\", at_most = 2 }, \
         { shape = \"box\", z = [0, 1e-3], r = [1e-3, 2e-3], at_least = 2, at_most = 3 }]",
        "solid.refine=[{ shape = \"interface\", at_least = 3 }]",
        "coupling.scheme=weak",
        "coupling.kappa=jump",
        "coupling.star=acoustic",
        "coupling.connect_timeout=3",
        "output={ directory = \"a \\\"b\\\"\", fields = [\"pressure\"], compression = 0, interface_cells = 7 }",
        "output.interface_every=1e-8",
        "output.mean_time=1e-7",
    ]);
    let times = [0.0, 3.1e-7, 6.2e-7, 9.3e-7, 1e-6];
    assert!(all.time.snapshots.iter().zip(times).all(|(a, b)| (a - b).abs() < 1e-18), "{:?}", all.time);
    assert_eq!(all.time.snapshots.len(), times.len());
    let direction = all.fluid.as_ref().map(|fluid| fluid.initial.pulses[0].shape);
    assert_eq!(direction, Some(PulseShape::Plane { direction: Some([-1.0, 0.0]) }));
    round_trip(&all);

    let planar = "geometry = \"planar\"\n[time]\nend = 1.0\n[solid]\nz = [0, 1]\nr = [-1, 0]\ncells = [16, 16]\n\
        material = \"gelatine\"\n[solid.boundary]\nz_min = \"periodic\"\nz_max = \"periodic\"\n[coupling]\nscheme = \"none\"\n";
    let planar = Case::from_toml(planar, "planar", &[]).unwrap_or_else(|errors| panic!("{errors}"));
    let sides = planar.solid.as_ref().map(|solid| solid.boundary);
    let periodic = solid::Boundary::Periodic;
    assert_eq!(sides, Some([periodic, periodic, solid::Boundary::Symmetry, solid::Boundary::Absorbing]));
    round_trip(&planar);
}

/// What a wave loses to adaptation is the same whether there is a bubble beside it or not.
#[test]
fn a_bubble_does_not_coarsen_the_waves_beside_it() {
    const PULSE: &str =
        "fluid.pulse=[{ shape = \"sphere\", centre = [0.002, 0.0], width = 1e-3, amplitude = 1e4 }]";
    // In pascals, on the finest level of the fluid and of the solid.
    let thresholds = |sets: &[&str]| {
        let case = with(sets);
        let (fluid, solid) = (case.fluid.expect("a fluid"), case.solid.expect("a solid"));
        let epsilon = solid.grid.adaptation.expect("adaptive").epsilon;
        [fluid.wave_epsilon * fluid.scale_pressure, epsilon * solid.scale_stress]
    };
    let alone = thresholds(&[PULSE, "fluid.region=[]"]);
    let beside = thresholds(&[PULSE]);
    for (beside, alone) in beside.into_iter().zip(alone) {
        assert!((beside / alone - 1.0).abs() < 0.06, "{beside} Pa, not {alone} Pa: ε has two digits");
    }
}

#[test]
fn grids_adapt_unless_they_are_told_not_to_or_cannot() {
    use mesh::{LevelBound, Side, Zone};
    let fluid = good().fluid.expect("a fluid");
    let adaptation = fluid.grid.adaptation.as_ref().expect("adaptive");
    assert_eq!((fluid.grid.root_level(), fluid.grid.cells_on(2)), (2, [16, 16]));
    assert_eq!((adaptation.epsilon, fluid.wave_epsilon), (3e-4, 1e-4));
    let solid = good().solid.expect("a solid");
    assert_eq!(solid.grid.adaptation.map(|adaptation| adaptation.epsilon), Some(1e-4));

    assert_eq!((adaptation.every, adaptation.bounds.len()), (8, 0));
    // The bubble's differences to the liquid; the solid's scale is the fluid's.
    assert_eq!((fluid.scale_pressure, fluid.scale_density), (9e5, 998.8));
    assert_eq!(good().solid.map(|solid| solid.scale_stress), Some(9e5));

    let levels = |sets: &[&str]| with(sets).fluid.expect("a fluid").grid.adaptation;
    assert_eq!(levels(&["fluid.adapt=false"]), None);
    assert_eq!(levels(&["fluid.cells=[32, 48]", "fluid.levels=0"]), None);
    assert_eq!(levels(&["fluid.levels=2"]), None, "the roots are on level 2");

    // Next to the wall it rises where that costs little, or where it is told to.
    let near = |sets: &[&str]| {
        let fluid = with(sets).fluid.expect("a fluid");
        let above = fluid.grid.adaptation.map_or(0, |adaptation| adaptation.above);
        (fluid.near_wall.shock_levels, fluid.near_wall.film_levels, fluid.near_wall.film_cells, above)
    };
    assert_eq!(near(&[]), (0, 0, 8, 0));
    assert_eq!(near(&["time.local_steps=auto"]), (0, 0, 8, 0));
    assert_eq!(near(&["time.local_steps=true"]), (2, 0, 8, 2));
    assert_eq!(near(&["time.local_steps=true", "fluid.adapt=false"]), (0, 0, 8, 0));
    assert_eq!(near(&["time.local_steps=true", "fluid.near_wall.shock_levels=0"]), (0, 0, 8, 0));
    assert_eq!(near(&["fluid.near_wall.shock_levels=1", "fluid.near_wall.film_levels=3"]), (1, 3, 8, 3));

    // Levels below the roots' are the roots'; what is not given does not bound.
    let case = with(&[
        "fluid.refine=[{ shape = \"sphere\", centre = [0, 0], radius = 0.01, where = \"outside\", at_most = 0 }]",
        "solid.refine=[{ shape = \"interface\", at_least = 3 }, { shape = \"box\", z = [-1, 0], r = [0, 1], at_least = 1 }]",
    ]);
    let bounds = |grid: &cav::case::GridCase| grid.adaptation.as_ref().map(|a| a.bounds.clone());
    let zone = Zone::Beyond { centre: [0.0; 2], radius: 0.01 };
    let outside = LevelBound { zone, at_least: 2, at_most: 2 };
    assert_eq!(case.fluid.as_ref().and_then(|fluid| bounds(&fluid.grid)), Some(vec![outside]));
    let surface = LevelBound { zone: Zone::Along(Side::ZMax), at_least: 3, at_most: 3 };
    let all = LevelBound { zone: Zone::Box { z: [-1.0, 0.0], r: [0.0, 1.0] }, at_least: 2, at_most: 3 };
    assert_eq!(case.solid.as_ref().and_then(|solid| bounds(&solid.grid)), Some(vec![surface, all]));
    round_trip(&case);

    // A threshold of the fluid is both of its thresholds, unless waves have one of their own.
    let thresholds = |sets: &[&str]| {
        let fluid = with(sets).fluid.expect("a fluid");
        (fluid.grid.adaptation.map(|adaptation| adaptation.epsilon), fluid.wave_epsilon)
    };
    assert_eq!(thresholds(&["fluid.epsilon=2e-3"]), (Some(2e-3), 2e-3));
    assert_eq!(thresholds(&["fluid.epsilon=2e-3", "fluid.epsilon_waves=1e-5"]), (Some(2e-3), 1e-5));
    assert_eq!(thresholds(&["fluid.error=1e-3"]), (Some(3e-5), 1e-5));

    let text = case.effective_toml();
    for part in
        ["adapt = true\nepsilon = 0.0003\nadapt_every = 8", "scale_stress = 900000.0", "where = \"outside\""]
    {
        assert!(text.contains(part), "no `{part}` in:\n{text}");
    }
}

#[test]
fn a_load_on_a_solid_alone_survives_being_written_out() {
    let text = "[time]\nend = 1e-6\n[solid]\nz = [-0.01, 0]\nr = [0, 0.01]\ncells = [16, 16]\nmaterial = \"copper\"\n\
        [coupling]\nscheme = \"load\"\n[coupling.load]\namplitude = -2e6\nradius = 1e-3\n\
        history = [[0, 0], [1e-7, 1.5]]\n[[probe]]\nname = \"s\"\nposition = [0, 0]\nmedium = \"solid\"\n";
    let case = Case::from_toml(text, "load", &[]).unwrap_or_else(|errors| panic!("{errors}"));
    round_trip(&case);
    let Some(LoadCase::Gaussian(load)) = &case.coupling.load else { panic!("{:?}", case.coupling.load) };
    assert_eq!((load.amplitude, load.radius, load.history.len()), (-2e6, 1e-3, 2));
    let solid = case.solid.as_ref().expect("the solid");
    // Thresholds are relative to the largest pressure of the history.
    assert_eq!(solid.scale_stress, 3e6);
    assert_eq!(solid.boundary[1], solid::Boundary::Interface);
    let stronger =
        Case::from_toml(text, "load", &["coupling.load.amplitude=3e6".to_owned()]).expect("a case");
    assert_ne!(stronger.hash(), case.hash());
    let waiting = text.replace("end = 1e-6", "end = \"settled\"\nlongest = 1e-6");
    let waiting = Case::from_toml(&waiting, "load", &[]).unwrap_or_else(|errors| panic!("{errors}"));
    round_trip(&waiting);
    assert!(waiting.time.settles && waiting.time.end == case.time.end);
    assert_ne!(waiting.hash(), case.hash());
}

#[test]
fn sides_that_are_not_named_have_what_the_scheme_means() {
    use fluid::Boundary::{Axis, FarField, Interface, Wall};
    let fluid_sides = |case: &Case| case.fluid.as_ref().map(|fluid| fluid.boundary);
    assert_eq!(fluid_sides(&good()), Some([Interface, FarField, Axis, FarField]));
    assert_eq!(
        good().solid.map(|solid| solid.boundary),
        Some([
            solid::Boundary::Absorbing,
            solid::Boundary::Interface,
            solid::Boundary::Axis,
            solid::Boundary::Absorbing
        ])
    );
    let rigid = with(&["coupling.scheme=rigid", "probe.0.medium=solid"]);
    assert_eq!(fluid_sides(&rigid), Some([Wall, FarField, Axis, FarField]));
    assert!(rigid.solid.is_none() && rigid.probes.is_empty());
    let named = with(&["fluid.boundary={ z_min = \"interface\", r_min = \"axis\" }"]);
    assert_eq!(named, good());
    assert_eq!(rigid.warnings().len(), 2, "{:?}", rigid.warnings());
    round_trip(&rigid);
}

#[test]
fn the_hash_ignores_form_and_output_and_nothing_else() {
    let hash = good().hash();
    let same =
        |text: &str| Case::from_toml(text, "other", &[]).unwrap_or_else(|errors| panic!("{errors}")).hash();
    assert_eq!(
        same(&format!("# a comment\n{}\n[output]\ncompression = 9\ndirectory = \"x\"\n", good_text())),
        hash
    );
    assert_eq!(
        same(&good_text().replace("1000.0", "1e3").replace("end = 1e-6", "end = 0.000001\ncfl = 0.45")),
        hash
    );
    assert_eq!(same(&good_text().replace("scheme = \"riemann\"", "patience = 5\nconnect_timeout = 1")), hash);
    let mut hashes = vec![hash];
    for set in [
        "time.end=1.1e-6",
        "time.cfl=0.4",
        "time.snapshots=[5e-7]",
        "fluid.z=[0.0, 0.02]",
        "fluid.levels=4",
        "fluid.cells=[8, 4]",
        "fluid.riemann=exact",
        "fluid.limiter=minmod",
        "fluid.adapt=false",
        "fluid.epsilon=2e-3",
        "fluid.adapt_every=4",
        "fluid.scale_pressure=1e6",
        "fluid.scale_density=1.0",
        "fluid.initial_pressure=rayleigh",
        "fluid.refine=[{ shape = \"interface\", at_least = 3 }]",
        "solid.scale_stress=1e7",
        "fluid.liquid.gamma=7.0",
        "fluid.liquid.pi=3.1e8",
        "fluid.gas.gamma=1.3",
        "fluid.ambient.pressure=1.0000000001e6",
        "fluid.ambient.velocity=[1.0, 0.0]",
        "fluid.region.0.radius=0.0021",
        "fluid.region.0.density=1.3",
        "fluid.boundary.r_max=wall",
        "solid.z=[-0.02, 0.0]",
        "solid.material=aluminium",
        "solid.material=stainless-steel",
        "solid.limiter=eno",
        "solid.initial_stress=hydrostatic",
        "solid.boundary.z_min=fixed",
        "coupling.scheme=weak",
        "coupling={ scheme = \"weak\", first = \"solid\" }",
        "coupling.scheme=explicit",
        "coupling.scheme=strong",
        "coupling={ scheme = \"strong\", first = \"solid\" }",
        "coupling={ scheme = \"strong\", tolerance = 1e-3 }",
        "coupling={ scheme = \"strong\", max_iterations = 7 }",
        "coupling.star=acoustic",
        "probe.0.position=[0.001, 0.0]",
    ] {
        let other = with(&[set]).hash();
        assert!(!hashes.contains(&other), "{set} does not change the hash");
        hashes.push(other);
    }
}

#[test]
fn set_changes_what_it_names() {
    let case =
        with(&["fluid.region.0.radius = 1e-3", "fluid.region.0.centre.0=0.005", "coupling.scheme=\"weak\""]);
    let region = case.fluid.map(|fluid| fluid.initial.regions[0].shape);
    assert_eq!(region, Some(fluid::Shape::Sphere { centre: [0.005, 0.0], radius: 1e-3 }));
    assert_eq!(case.coupling.scheme, coupler::Scheme::Weak);

    // A later change wins, and a name gives way to a table and a table to a name.
    let table = "solid.material={ density = 1000, lambda = 1e9, mu = 1e9 }";
    let material = |sets: &[&str]| with(sets).solid.map(|solid| solid.material);
    assert_eq!(material(&[table]).map(|m| m.density()), Some(1000.0));
    assert_eq!(material(&[table, "solid.material=copper"]), solid::Material::by_name("copper"));
    let text = good_text()
        .replace("material = \"structural-steel\"", "[solid.material]\ndensity = 1\nc1 = 2\nc2 = 1");
    let sets = ["solid.material=copper".to_owned()];
    let case = Case::from_toml(&text, "good", &sets).unwrap_or_else(|errors| panic!("{errors}"));
    assert_eq!(case.solid.map(|solid| solid.material), solid::Material::by_name("copper"));
    assert!(material(&["solid.material=copper", table]).is_some_and(|m| m.name() == "custom"));
}

/// What `cav check` says of a case, which has all of this.
fn says(case: &Case, parts: &[&str]) -> String {
    let report = cav::case::report(case);
    for part in parts {
        assert!(report.contains(part), "no `{part}` in:\n{report}");
    }
    report
}

#[test]
fn the_report_knows_the_papers_case() {
    let case = of_file("dickopp2012-coarse", &[]);
    let report = says(
        &case,
        &[
            "256 x 256 = 65536 cells of 195.3 µm",
            "256 blocks of 16 x 16",
            "51.2 cells per radius",
            "stand-off d/R = 2.000",
            "Rayleigh collapse time 40.91 µs",
            "reflection coefficient of pressure 0.934501",
            "4 in one of the fluid's",
        ],
    );
    assert!(!report.contains("adaptive") && !report.contains("warning"), "{report}");
    says(
        &of_file("dickopp2012", &[]),
        &[
            "adaptive, level 2 to 9: 16 x 16 to 2048 x 2048 cells of 24.41 µm",
            "adaptive, level 0 to 9: 16 x 16 to 8192 x 8192 cells of 6.104 µm",
            "thresholds on the finest level 50 kPa (0.001 of 50 MPa)",
            "67108864 cells",
            "if all cells were on the finest level",
            "409.6 cells per radius at the finest level",
            "a guess",
        ],
    );
    // Two mirrored spheres at one potential: by the series of image charges 11.25 MPa on the plane between them.
    let start = of_file("dickopp2012-coarse", &["fluid.initial_pressure=rayleigh"]);
    says(&start, &["rayleigh, 11.25 MPa at z_min on the axis"]);
    // The same bubble above a rigid wall is the rigid case, to the last key.
    let rigid = of_file("rigid-wall", &[]);
    let text = case.effective_toml();
    let same = Case::from_toml(&text, "rigid-wall", &["coupling.scheme=rigid".to_owned()]);
    assert_eq!(same.unwrap_or_else(|errors| panic!("{errors}")).hash(), rigid.hash());
    let coarse = of_file("dickopp2012-coarse", &["fluid.levels=2", "time.cfl=0.6"]);
    let warnings = coarse.warnings().join("\n");
    assert!(warnings.contains("3.2 cells per radius") && warnings.contains("time.cfl = 0.6"), "{warnings}");
    let table = cav::case::materials_table();
    assert!(table.contains("structural-steel") && table.contains("gelatine"), "{table}");
}

#[test]
fn every_hardening_law_survives_being_written_out() {
    let laws = [
        "{ law = \"perfect\" }",
        "{ law = \"perfect\", yield_strength = 4e8 }",
        "{ law = \"linear\", hardening_modulus = 1e9 }",
        "{ law = \"johnson-cook\" }",
        "{ law = \"johnson-cook\", yield_strength = 3e8, hardening_exponent = 0.5, rate_coefficient = 0.0 }",
        "{ law = \"table\", table = [[0.0, 3e8], [0.1, 4e8]] }",
        "{ law = \"table\", table = [[0.0, 3e8]], rate_coefficient = 0.01, reference_rate = 2.0 }",
    ];
    for law in laws {
        let case = with(&[&format!("solid.plasticity={law}")]);
        assert!(case.solid.as_ref().is_some_and(|solid| solid.plasticity.is_some()), "{law}");
        round_trip(&case);
        assert_ne!(case.hash(), good().hash());
    }
    // Of its own the material has the law's constants, not the strength that its standard promises.
    let strength =
        |law: &str| with(&[&format!("solid.plasticity={law}")]).solid.and_then(|s| s.yield_strength());
    assert_eq!(strength(laws[0]), Some(250e6));
    assert_eq!(strength(laws[3]), Some(286.1e6));
}
