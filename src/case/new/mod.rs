//! `cav new`: short, commented case files for what is asked most often.
//!
//! Domain, grid, times and snapshots follow from a bubble's size, what drives it and the resolution wanted. What comes out is the
//! text of a case file; it reads without a warning, and is meant to be changed.

mod checks;
mod collapse;
mod free;
mod gilmore;
mod grid;
mod laser;
mod laser_radii;
mod load;
mod parts;
mod quantity;
mod shock;
mod wall;

pub use collapse::Collapse;
pub use free::FreeBubble;
pub use laser::LaserBubble;
pub use laser_radii::LaserRadii;
pub use load::WallLoad;
pub use quantity::Dimension;
pub use shock::ShockedBubble;
pub use wall::Wall;
