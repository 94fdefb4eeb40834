//! `history.h5`: the histories of both sides under one roof.
//!
//! While the run goes on (and if it is killed) the file holds links to the sides' files, by names relative to its own
//! place, so that the directory can be moved; they cost nothing and always show the latest batch. At the end it is
//! made anew as a copy, so that it can be taken to another machine alone.

use std::path::Path;

use hdf5::{Dataset, File, Group, LocationType};

use super::hdf5_attributes::{set_text, text};
use super::run_directory::HISTORY;
use super::{OutputError, safe_file};

/// How the joint file holds what it joins.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Join {
    /// Links to the parts, which have to stay beside the file.
    Links,
    /// Copies; the file stands alone.
    Copy,
}

/// Makes `history.h5` in `directory` from the files `parts` there: every group and dataset of a part is found under
/// its own path, and groups that several parts have are merged. Parts that do not exist are left out.
///
/// Returns the paths of datasets that a part has in common with an earlier one (`/time`, say) where the two differ by
/// more than their lengths; the earlier part's is the one that is found.
pub fn join_histories(directory: &Path, parts: &[&str], how: Join) -> Result<Vec<String>, OutputError> {
    let path = directory.join(HISTORY);
    let lengths = parts.iter().filter_map(|part| std::fs::metadata(directory.join(part)).ok());
    let copied: u64 = if how == Join::Copy { lengths.map(|part| part.len()).sum() } else { 0 };
    safe_file::replace_hdf5(&path, safe_file::HDF5_OVERHEAD + copied, |temporary| {
        let join = || -> hdf5::Result<Vec<String>> {
            let joint = File::create(temporary)?;
            let mut differing = Vec::new();
            let mut opened = Vec::new();
            for part in parts.iter().filter(|part| directory.join(part).exists()) {
                opened.push((*part, File::open(directory.join(part))?));
            }
            let sources: Vec<Source<'_>> = opened
                .iter()
                .map(|(name, file)| Ok(Source { part: name, group: file.group("/")? }))
                .collect::<hdf5::Result<_>>()?;
            merge(&joint, "", &sources, how, &mut differing)?;
            joint.close()?;
            Ok(differing)
        };
        join().map_err(OutputError::hdf5(&path, "join the histories in"))
    })
}

/// A group of one of the parts.
struct Source<'a> {
    part: &'a str,
    group: Group,
}

/// Fills `target`, the group `path` of the joint file, with what the same group of each part holds.
fn merge(
    target: &Group,
    path: &str,
    sources: &[Source<'_>],
    how: Join,
    differing: &mut Vec<String>,
) -> hdf5::Result<()> {
    for source in sources.iter().rev() {
        copy_text_attributes(&source.group, target)?;
    }
    let mut done: Vec<String> = Vec::new();
    for (number, source) in sources.iter().enumerate() {
        for name in source.group.member_names()? {
            if done.contains(&name) {
                continue;
            }
            let path = format!("{path}/{name}");
            let holders: Vec<&Source<'_>> =
                sources[number..].iter().filter(|later| later.group.link_exists(&name)).collect();
            let are_groups = |holder: &&Source<'_>| is_group(&holder.group, &name);
            if holders.len() > 1 && holders.iter().all(are_groups) {
                let inner: Vec<Source<'_>> = holders
                    .iter()
                    .map(|holder| Ok(Source { part: holder.part, group: holder.group.group(&name)? }))
                    .collect::<hdf5::Result<_>>()?;
                merge(&target.create_group(&name)?, &path, &inner, how, differing)?;
            } else {
                add(target, &path, source, &name, how)?;
                if holders[1..].iter().any(|later| differ(&source.group, &later.group, &name)) {
                    differing.push(path);
                }
            }
            done.push(name);
        }
    }
    Ok(())
}

/// Adds the object `name` of a part, with all that is in it.
fn add(target: &Group, path: &str, source: &Source<'_>, name: &str, how: Join) -> hdf5::Result<()> {
    match how {
        Join::Links => target.link_external(source.part, path, name),
        Join::Copy if is_group(&source.group, name) => source.group.group(name)?.copy_to(target, name),
        Join::Copy => source.group.dataset(name)?.copy_to(target, name),
    }
}

fn is_group(parent: &Group, name: &str) -> bool {
    parent.loc_type_by_name(name).is_ok_and(|kind| kind == LocationType::Group)
}

/// Whether two datasets differ in the rows that both have.
fn differ(earlier: &Group, later: &Group, name: &str) -> bool {
    let read = |group: &Group| group.dataset(name).and_then(|dataset| dataset.read_raw::<f64>());
    match (read(earlier), read(later)) {
        (Ok(a), Ok(b)) => a.iter().zip(&b).any(|(x, y)| x.to_bits() != y.to_bits()),
        _ => true,
    }
}

fn copy_text_attributes(from: &Group, to: &Group) -> hdf5::Result<()> {
    for name in from.attr_names()? {
        if let Some(value) = text(from, &name) {
            set_text(to, &name, &value)?;
        }
    }
    Ok(())
}

/// A dataset of a history by its path from the root; `None`, and no complaint of HDF5's, where there is none.
pub fn dataset_if_there(file: &File, path: &str) -> Option<Dataset> {
    let group_is_there = path.rsplit_once('/').is_none_or(|(group, _)| file.link_exists(group));
    if group_is_there && file.link_exists(path) { file.dataset(path).ok() } else { None }
}
