//! The paths that any table was asked for on this thread, for the tests.

use std::cell::RefCell;
use std::collections::BTreeSet;

thread_local! {
    static PATHS: RefCell<BTreeSet<String>> = const { RefCell::new(BTreeSet::new()) };
}

pub(in crate::case) fn note(path: String) {
    PATHS.with(|paths| paths.borrow_mut().insert(path));
}

pub(in crate::case) fn all() -> BTreeSet<String> {
    PATHS.with(|paths| paths.borrow().clone())
}
