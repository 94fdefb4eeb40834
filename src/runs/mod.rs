//! `cav list` and `pycav.runs`: all runs below a folder, what was varied among them, and what they came to.
//!
//! | module | is |
//! |---|---|
//! | [`find`] | the run directories below a folder |
//! | [`record`] | what is kept of a run: its case and its summary, flat |
//! | [`flat`] | keys and values without tables, many of them |
//! | [`index`] | the records of all runs of a folder in SQLite |
//! | [`listing`] | the runs with their states |
//! | [`condition`] | `--where` |
//! | [`varied`] | the keys of the cases that differ |
//! | [`columns`] | which keys are shown, with their units |
//! | [`table`] | the listing for people |
//! | [`export`] | the listing as CSV and JSON |
//! | [`error`] | what can be wrong with what is asked |

pub mod columns;
pub mod condition;
pub mod error;
pub mod export;
pub mod find;
pub mod flat;
pub mod index;
pub mod listing;
pub mod record;
pub mod table;
pub mod varied;

pub use error::ListError;
pub use listing::{Asked, Listing};
