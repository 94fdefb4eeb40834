//! Two processes and what happens between them. Each test has its own domain, so they run side by side.

#![allow(clippy::unwrap_used)]

mod death;
mod exchange;
mod helper;
mod meeting;
mod waiting;
