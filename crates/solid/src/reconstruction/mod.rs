//! Slopes of the cells, and their states half a step later.

pub(crate) mod predictor;
