//! `cav keys`.

use clap::Args;

use super::print::print;
use crate::case::{describe_keys, keys_page};

/// Which keys.
#[derive(Args)]
pub(super) struct KeysArgs {
    /// A table (fluid.boundary), a key (fluid.epsilon), or its last name alone (epsilon). Without it all keys, one line each.
    path: Option<String>,
    /// Write the reference page in Markdown.
    #[arg(long, conflicts_with = "path")]
    markdown: bool,
}

/// Shows them; returns the exit code.
pub(super) fn keys(args: &KeysArgs) -> u8 {
    let text = if args.markdown { Ok(keys_page()) } else { describe_keys(args.path.as_deref()) };
    match text {
        Ok(text) => {
            let _ = print(&text);
            0
        }
        Err(error) => {
            eprintln!("error: {error}");
            2
        }
    }
}
