//! Levels of their own time step, and what passes the faces between them.

pub(crate) mod courant;
pub(crate) mod level_clock;
pub(crate) mod level_steps;
pub(crate) mod register;
