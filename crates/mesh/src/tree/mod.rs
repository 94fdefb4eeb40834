//! Where the cells lie: the quadtree of blocks over a rectangle, and the fields on it.

pub(crate) mod domain;
pub(crate) mod field;
pub(crate) mod geometry;
pub(crate) mod quadtree;
pub(crate) mod tile;
