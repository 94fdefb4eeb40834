//! Tells the program the git revision that it is built from, which every run writes into its files.

use std::path::Path;
use std::process::Command;

fn main() {
    let asked = Command::new("git").args(["rev-parse", "--short=12", "HEAD"]).output();
    // A build outside a checkout has none.
    let revision = (asked.ok().filter(|output| output.status.success()))
        .map_or_else(|| "unknown".into(), |output| String::from_utf8_lossy(&output.stdout).trim().to_owned());
    println!("cargo::rustc-env=CAV_GIT_REVISION={revision}");
    println!("cargo::rerun-if-changed=build.rs");
    // Grows with every commit and checkout.
    if Path::new(".git/logs/HEAD").exists() {
        println!("cargo::rerun-if-changed=.git/logs/HEAD");
    }
}
