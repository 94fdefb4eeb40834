//! `cav check`.

use std::path::PathBuf;

use clap::{Args, ValueHint};

use super::print::print;
use crate::case::{Case, report, sketch};
use crate::output::OutputError;
use crate::run::{RunError, wall};

/// What is checked.
#[derive(Args)]
pub(super) struct CheckArgs {
    /// The case file.
    #[arg(value_hint = ValueHint::FilePath)]
    case: PathBuf,
    /// Change a key of the case, as fluid.region.0.radius=0.01; may be given several times. `cav keys` lists them.
    #[arg(long = "set", value_name = "KEY=VALUE")]
    sets: Vec<String>,
    /// Draw the start of the case, with the blocks of its grids, into a file.
    #[arg(long, value_name = "FILE", value_hint = ValueHint::FilePath, value_parser = png_file)]
    png: Option<PathBuf>,
}

/// A name that says what is in the file.
fn png_file(name: &str) -> Result<PathBuf, String> {
    let path = PathBuf::from(name);
    let is_png = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("png"));
    if is_png { Ok(path) } else { Err("what is drawn is a PNG: give a name that ends in .png".to_owned()) }
}

/// What a case means, drawn and in numbers.
pub(super) fn check(args: &CheckArgs) -> Result<(), RunError> {
    let case = Case::load(&args.case, &args.sets)?;
    wall::check(&case)?;
    if let Some(file) = &args.png {
        sketch::png(&case, file).map_err(|source| OutputError::Io {
            path: file.clone(),
            action: "write",
            source,
        })?;
    }
    let drawn = sketch::letters(&case).unwrap_or_default();
    print(&format!("{drawn}\n{}", report(&case)))
}
