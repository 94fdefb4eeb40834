//! cav
