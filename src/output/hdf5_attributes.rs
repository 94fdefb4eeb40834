//! Text attributes of HDF5 objects.

use std::path::Path;

use hdf5::types::VarLenUnicode;
use hdf5::{File, Location};

use super::{OutputError, safe_file};

/// Attaches `value` to an object as the text attribute `name`; one that exists is overwritten.
pub(super) fn set_text(location: &Location, name: &str, value: &str) -> hdf5::Result<()> {
    let text: VarLenUnicode =
        value.parse().map_err(|_| hdf5::Error::from(format!("attribute {name} holds a zero byte")))?;
    if location.attr_names()?.iter().any(|existing| existing == name) {
        location.delete_attr(name)?;
    }
    location.new_attr::<VarLenUnicode>().create(name)?.write_scalar(&text)
}

/// Attaches all of `attributes`, pairs of name and value.
pub(super) fn set_texts(location: &Location, attributes: &[(&str, impl AsRef<str>)]) -> hdf5::Result<()> {
    attributes.iter().try_for_each(|(name, value)| set_text(location, name, value.as_ref()))
}

/// Attaches all of `attributes` to an existing file as a whole.
pub fn set_of_file(path: &Path, attributes: &[(&str, impl AsRef<str>)]) -> Result<(), OutputError> {
    safe_file::update_hdf5(path, safe_file::HDF5_OVERHEAD, |copy| {
        let set = || -> hdf5::Result<()> {
            let file = File::open_rw(copy)?;
            set_texts(&file, attributes)?;
            file.close()
        };
        set().map_err(OutputError::hdf5(path, "set attributes of"))
    })
}

/// The text attribute `name`, or `None` where there is none or it is not a text.
pub(super) fn text(location: &Location, name: &str) -> Option<String> {
    let value: VarLenUnicode = location.attr(name).ok()?.read_scalar().ok()?;
    Some(value.as_str().to_owned())
}

/// The text attribute `name` of a file as a whole, or `None` where there is none or no such file.
pub fn root_attribute(path: &Path, name: &str) -> Option<String> {
    let file = File::open(path).ok()?;
    text(&file, name)
}
