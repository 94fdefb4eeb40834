//! Where iceoryx2 keeps its objects, who may see them, and how a deserted domain is swept.

use std::fs::{self, DirBuilder, File};
use std::io::ErrorKind;
use std::os::unix::fs::{DirBuilderExt, MetadataExt};
use std::path::{Path, PathBuf};

use iceoryx2::config::Config;
use iceoryx2::prelude::{FileName, LogLevel, Path as IoxPath, SemanticString, set_log_level_from_env_or};

use rustix::fs::{Access, access, statvfs};

use crate::error::CouplerError;

/// Ports can move to the thread that uses them, so the thread-safe flavour.
pub(crate) type Ipc = iceoryx2::prelude::ipc_threadsafe::Service;

/// The event's Unix socket lies below the root, and the system limits the length of its path: 51 worked, 71 did not.
const LONGEST_ROOT: usize = 45;

/// The set of objects that participants can see of each other: a directory and a prefix in `/dev/shm`.
///
/// All runs of a user share one, so that whoever starts next clears away what a killed run left; the run id in the
/// service names keeps them apart. After the last run nothing remains but the directory.
///
/// Permissions: the directory is made 0700 before iceoryx2 sees it and refused if it is open to others or another
/// user's. In `/dev/shm`, frames and connections are 0600; only the 16 bytes of `*.global_mgmt`, a counter, are 0666.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Domain {
    /// Of all names in `/dev/shm`.
    pub prefix: String,
    /// Of node and service descriptions and of the events' sockets; at most 45 characters.
    pub root: PathBuf,
}

impl Default for Domain {
    /// Prefix `cav_<uid>_`, root `/tmp/cav-<uid>`: users do not share, they could not clear up after each other.
    fn default() -> Self {
        let uid = rustix::process::getuid().as_raw();
        Self { prefix: format!("cav_{uid}_"), root: PathBuf::from(format!("/tmp/cav-{uid}")) }
    }
}

impl Domain {
    /// Makes the directory and the configuration for everything in this domain.
    pub(crate) fn config(&self) -> Result<Config, CouplerError> {
        make_private(&self.root)?;
        set_log_level_from_env_or(LogLevel::Error);
        let mut config = Config::default();
        let bad = |what, cause| CouplerError::SharedMemory { what, cause };
        config.global.prefix = FileName::new(self.prefix.as_bytes())
            .map_err(|error| bad("using this prefix", format!("{error:?}")))?;
        let root = IoxPath::new(self.root.as_os_str().as_encoded_bytes())
            .map_err(|error| bad("using this root directory", format!("{error:?}")))?;
        config.global.set_root_path(&root);
        Ok(config)
    }
}

/// Where shared memory lies.
const SHARED_MEMORY: &str = "/dev/shm";

/// Whether shared memory can be written to and has room for so many bytes. To be asked before it is taken: memory that turns
/// out not to be there kills the process that touches it.
pub(crate) fn require_room(needed: u64) -> Result<(), CouplerError> {
    let not_writable = |cause: rustix::io::Errno| CouplerError::NotWritable { cause: cause.to_string() };
    access(SHARED_MEMORY, Access::WRITE_OK | Access::EXEC_OK).map_err(not_writable)?;
    let room = statvfs(SHARED_MEMORY).map_err(not_writable)?;
    let [free, total] = [room.f_bavail, room.f_blocks].map(|blocks| blocks.saturating_mul(room.f_frsize));
    // A file system that does not count its blocks has no bound.
    if total > 0 && free < needed { Err(CouplerError::NoRoom { needed, free, total }) } else { Ok(()) }
}

/// Held by every participant for as long as it may have shared objects; the system lets go of it if it is killed.
#[derive(Debug)]
pub(crate) struct Presence {
    shared_lock: File,
    domain: Domain,
}

impl Presence {
    /// Enters the domain. Whoever finds it deserted sweeps it: iceoryx2 knows the dead by their node, and cannot know
    /// those killed while that was being made.
    pub(crate) fn enter(domain: &Domain) -> Result<Self, CouplerError> {
        let refuse = |error: std::io::Error| CouplerError::BadRoot {
            path: domain.root.clone(),
            reason: format!("cannot be locked: {error}"),
        };
        make_private(&domain.root)?;
        let root = File::open(&domain.root).map_err(refuse)?;
        if root.try_lock().is_ok() {
            sweep(domain);
            root.unlock().map_err(refuse)?;
        }
        root.lock_shared().map_err(refuse)?;
        Ok(Self { shared_lock: root, domain: domain.clone() })
    }
}

impl Drop for Presence {
    /// The last one out sweeps, too: what a killed peer left cannot always be taken apart while it dies.
    fn drop(&mut self) {
        let alone = self.shared_lock.unlock().and_then(|()| self.shared_lock.try_lock().map_err(Into::into));
        if alone.is_ok() {
            sweep(&self.domain);
        }
    }
}

/// Removes everything in the domain. What cannot be removed is in nobody's way.
fn sweep(domain: &Domain) {
    for entry in fs::read_dir(&domain.root).into_iter().flatten().flatten() {
        let path = entry.path();
        let removed = if path.is_dir() { fs::remove_dir_all(&path) } else { fs::remove_file(&path) };
        if let Err(error) = removed {
            tracing::debug!(path = %path.display(), %error, "not swept");
        }
    }
    for (_, path) in shared_objects(&domain.prefix) {
        // Another user's object of that name cannot be removed, and need not be.
        let _ = fs::remove_file(path);
    }
}

/// What iceoryx2 has in shared memory under this prefix, by name and path.
pub(crate) fn shared_objects(prefix: &str) -> impl Iterator<Item = (String, PathBuf)> {
    fs::read_dir(SHARED_MEMORY)
        .into_iter()
        .flatten()
        .flatten()
        .filter_map(|entry| Some((entry.file_name().into_string().ok()?, entry.path())))
        .filter(move |(name, _)| is_of(prefix, name))
}

/// iceoryx2's names are the prefix, 40 hexadecimal digits, `_`, the rest; so `a_` does not claim those of `a_b_`.
fn is_of(prefix: &str, name: &str) -> bool {
    let digits = name.strip_prefix(prefix).and_then(|rest| rest.split_once('_')).map(|(digits, _)| digits);
    digits.is_some_and(|digits| digits.len() == 40 && digits.bytes().all(|b| b.is_ascii_hexdigit()))
}

/// A directory of ours that nobody else can enter; in a shared `/tmp` anyone could have made it first.
fn make_private(root: &Path) -> Result<(), CouplerError> {
    let refuse = |reason: String| Err(CouplerError::BadRoot { path: root.to_owned(), reason });
    if root.as_os_str().len() > LONGEST_ROOT {
        return refuse(format!("has a name of more than {LONGEST_ROOT} characters"));
    }
    match DirBuilder::new().mode(0o700).create(root) {
        Ok(()) => {}
        Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
        Err(error) => return refuse(format!("cannot be made: {error}")),
    }
    let found = match fs::symlink_metadata(root) {
        Ok(found) => found,
        Err(error) => return refuse(format!("cannot be looked at: {error}")),
    };
    if !found.is_dir() {
        return refuse("is not a directory".to_owned());
    }
    if found.uid() != rustix::process::getuid().as_raw() {
        return refuse(format!("belongs to user {}", found.uid()));
    }
    if found.mode() & 0o077 != 0 {
        return refuse(format!("is open to others (mode {:o})", found.mode() & 0o777));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::os::unix::fs::PermissionsExt;

    use super::*;

    #[test]
    fn the_root_is_made_private_and_refused_if_it_is_not() {
        let root = PathBuf::from(format!("/tmp/cavt-{}-root", std::process::id()));
        make_private(&root).unwrap();
        assert_eq!(fs::metadata(&root).unwrap().mode() & 0o777, 0o700);
        make_private(&root).expect("an own private directory is taken again");
        fs::set_permissions(&root, fs::Permissions::from_mode(0o755)).unwrap();
        let error = make_private(&root).expect_err("open to others");
        assert!(error.to_string().contains("mode 755"), "{error}");
        fs::remove_dir(&root).unwrap();
        std::os::unix::fs::symlink("/tmp", &root).unwrap();
        let error = make_private(&root).expect_err("a link leads elsewhere");
        assert!(error.to_string().contains("not a directory"), "{error}");
        fs::remove_file(&root).unwrap();
    }

    #[test]
    fn only_objects_of_exactly_this_prefix_are_swept() {
        let hash = "0354a209029e7d094a819e2d4030ea331e6caaf0";
        assert!(is_of("cav_", &format!("cav_{hash}_1.data")));
        assert!(is_of("cav_", &format!("cav_{hash}_node.0_10_0.global_mgmt")));
        assert!(!is_of("cav_", &format!("cav_b_{hash}_1.data")));
        assert!(!is_of("cav_", "cav_notes_1.txt"));
    }

    #[test]
    fn a_root_too_long_for_a_socket_is_refused() {
        let error = make_private(Path::new("/tmp/a-name-so-long-that-sockets-below-it-cannot-be-made"));
        assert!(matches!(error, Err(CouplerError::BadRoot { .. })));
    }
}
