//! cav
pub mod output;
