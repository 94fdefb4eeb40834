//! What the HDF5 library keeps of memory it has done with.

use std::sync::Once;

use hdf5_sys::h5::H5set_free_list_limits;

/// Makes the library give memory back as soon as it has done with it.
///
/// It keeps what it frees in lists, one for each kind and each length, up to 16 MiB in all. Batches of histories are of all
/// lengths, so the lists would grow for as long as a run lasts: by some 0.7 MiB in 10⁵ steps. To allocate anew costs nothing
/// that could be measured.
///
/// To be called before any file is made or opened; again does nothing.
pub(super) fn keep_none() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        #[expect(unsafe_code, reason = "the safe interface does not have it")]
        // SAFETY: takes numbers alone, and `sync` lets one thread at a time into the library, which it has opened before.
        // It can only fail on a library that does not open, which the next call says.
        hdf5::sync::sync(|| unsafe {
            H5set_free_list_limits(0, 0, 0, 0, 0, 0);
        });
    });
}
