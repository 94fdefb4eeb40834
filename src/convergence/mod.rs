//! Grid convergence: a case on grids that are finer and finer, and what its numbers come to.
//!
//! | module | is |
//! |---|---|
//! | [`numbers`] | which numbers of a summary are looked at, and their units |
//! | [`analysis`] | observed order, Richardson's value, grid-convergence index of one of them |
//! | [`plan`] | the grids: their cases, what is there of their runs already |
//! | [`study`] | the runs, one after the other |
//! | [`record`] | `convergence.json` |
//! | [`table`] | the same to be read |

pub mod analysis;
pub mod numbers;
pub mod plan;
pub mod record;
pub mod study;
pub mod table;
