//! `cav watch`: a run looked at from outside, by its files alone.
//!
//! Reading and drawing know nothing of each other but [`Seen`](seen::Seen). Nothing is written, and no file is locked in a way that
//! its writer would notice.
//!
//! | module | is |
//! |---|---|
//! | [`seen`] | what there is to see of a run |
//! | [`reader`] | looks at the directory, again and again |
//! | [`series`] | the rows of one history that have come since the last look |
//! | [`curve`] | a curve with its peaks, however long the run |
//! | [`grids`] | the grid under way in the directory of a study |
//! | [`draw`] | a picture of it on a terminal |
//! | [`plain`] | the same in lines, where there is no terminal |
//! | [`terminal`] | looks, draws, and minds the keys |

pub mod curve;
pub mod draw;
pub mod grids;
pub mod plain;
pub mod reader;
pub mod seen;
pub mod series;
pub mod terminal;
