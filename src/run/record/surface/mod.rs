//! What becomes of the solid's surface: its displacement, the pit in it, and whether it is still.
//!
//! | module | is |
//! |---|---|
//! | [`sum`] | sums that lose nothing in millions of steps |
//! | [`displacement`] | the displacement of the surface, from its velocity |
//! | [`pit`] | depth, radius, volume and rim of a profile |
//! | [`rest`] | how far the surface is from rest |
//! | [`surface_record`] | what of it is written |

pub mod displacement;
pub mod pit;
pub mod rest;
pub mod sum;
pub mod surface_record;
