//! A virtual environment with the Python package, which is built and installed once for all tests that need it.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;

/// Runs a command and fails with what it printed if it fails.
pub fn run(what: &str, command: &mut Command) {
    let output = command.stdin(Stdio::null()).output();
    let output = output.unwrap_or_else(|error| panic!("{what}: cannot start {command:?}: {error}"));
    let text = [&output.stdout, &output.stderr].map(|bytes| String::from_utf8_lossy(bytes).into_owned());
    assert!(output.status.success(), "{what} failed: {command:?}\n{}\n{}", text[0], text[1]);
}

/// A command without what `cargo test` tells the tests of this package, which would mislead the build of another one.
pub fn command(program: impl AsRef<std::ffi::OsStr>) -> Command {
    let mut command = Command::new(program);
    for (name, _) in std::env::vars_os() {
        let text = name.to_string_lossy();
        let is_of_package = ["CARGO_PKG_", "CARGO_BIN_", "CARGO_MANIFEST_", "CARGO_CRATE_", "CARGO_PRIMARY_"]
            .iter()
            .any(|start| text.starts_with(start));
        let misleads = matches!(
            &*text,
            // The last one, as images of containers set it: hundreds of interpreters would each compile all that they import.
            "LD_LIBRARY_PATH" | "CARGO" | "PYTHONPATH" | "PYTHONHOME" | "PYTHONDONTWRITEBYTECODE"
        );
        if is_of_package || misleads {
            command.env_remove(&name);
        }
    }
    command
}

/// The directory that cargo builds in, and the profile that it builds this with.
pub fn target() -> (PathBuf, String) {
    let directory = Path::new(env!("CARGO_BIN_EXE_cav")).parent().expect("target/debug/cav");
    let name = directory.file_name().expect("debug").to_string_lossy();
    // The one profile whose directory has another name.
    let profile = if name == "debug" { "dev".into() } else { name };
    (directory.parent().expect("target").to_owned(), profile.into_owned())
}

/// What a package and its tests need, as its `pyproject.toml` says.
fn needed(project: &Path) -> Vec<String> {
    let text = std::fs::read_to_string(project).expect("pyproject.toml");
    let project: toml::Table = toml::from_str(&text).expect("TOML");
    let lists = [&project["project"]["dependencies"], &project["project"]["optional-dependencies"]["test"]];
    let entries = lists.into_iter().flat_map(|list| list.as_array().expect("a list"));
    entries.map(|entry| entry.as_str().expect("a requirement").to_owned()).collect()
}

/// The Python of a virtual environment with the package, its tests' packages and the book's. It is made by the test that comes first.
pub fn python() -> &'static Path {
    static PYTHON: OnceLock<PathBuf> = OnceLock::new();
    PYTHON.get_or_init(|| environment(&root().join("crates/pycav"), &root().join("docs/requirements.txt")))
}

pub fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn environment(package: &Path, books: &Path) -> PathBuf {
    let (target, profile) = target();
    let environment = target.join("python");
    let python = environment.join("bin/python");
    if !python.exists() {
        run("making a virtual environment", command("python3").args(["-m", "venv"]).arg(&environment));
    }
    let pip = |arguments: &[&str]| {
        let mut pip = command(&python);
        pip.args(["-m", "pip", "--quiet", "--disable-pip-version-check"]).args(arguments);
        pip.current_dir(package).env("CARGO_TARGET_DIR", &target);
        // By itself it would be the release profile with HDF5 from source, for which all dependencies and the library would be
        // compiled once more. (`.ci/run` tests the package as it is given out.)
        pip.env("MATURIN_PEP517_ARGS", format!("--profile {profile} --features system-hdf5"));
        run("pip", &mut pip);
    };
    let wheels = tempfile::tempdir().expect("a directory for the wheel");
    let directory = wheels.path().to_str().expect("a path in UTF-8");
    // What the package needs is fetched and unpacked while it is compiled.
    std::thread::scope(|scope| {
        scope.spawn(|| pip(&["wheel", "--no-deps", "--wheel-dir", directory, "."]));
        let needed = needed(&package.join("pyproject.toml"));
        let books = books.to_str().expect("a path in UTF-8");
        // Python compiles what it imports itself, when it does so first: a tenth of what is here.
        pip(&[
            &["install", "--no-compile", "-r", books],
            &*needed.iter().map(String::as_str).collect::<Vec<_>>(),
        ]
        .concat());
    });
    let wheel = std::fs::read_dir(directory).expect("wheels").flatten().next().expect("a wheel").path();
    // Of that name and version another one may be there.
    pip(&["install", "--force-reinstall", "--no-deps", &wheel.to_string_lossy()]);
    pip(&["install", &format!("{}[test]", wheel.display())]);
    python
}

/// The Python tests of a directory. Type checkers, browsers and runs side by side: most of them keep one core busy.
pub fn pytest(directory: &Path) {
    let mut tests = command(python());
    tests.args(["-m", "pytest", "-q", "--color=no", "-p", "no:cacheprovider"]).current_dir(directory);
    tests.args(["-n", "2", "--dist", "worksteal"]);
    tests.env("CAV_BINARY", env!("CARGO_BIN_EXE_cav"));
    run("pytest", &mut tests);
}
