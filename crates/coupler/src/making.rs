//! Participants of a domain make what others will open one at a time, and so can clear away what one was killed over.
//!
//! iceoryx2 makes a shared object in three moves: it takes the name, gives it its length, lets it be read. One killed in
//! between leaves an object that nobody ever finishes; others wait for it until a time limit, or, before it has its
//! length, without end (version 0.10). Behind a lock that the system takes from the killed, an object that is not finished
//! belongs to somebody dead.

use std::fs::{self, File};
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};
use std::thread;
use std::time::{Duration, Instant};

use iceoryx2::config::Config;
use iceoryx2::node::NodeView;
use iceoryx2::prelude::{CallbackProgression, Node, NodeState};

use crate::domain::{Domain, Ipc, Presence, shared_objects};
use crate::error::CouplerError;

/// Making takes milliseconds; only one that is stopped over it holds the lock for longer.
const PATIENCE: Duration = Duration::from_secs(5);

/// Other runs' frames and connections are made without the lock, in microseconds. After this they never will be.
const ABANDONED: Duration = Duration::from_secs(1);

/// What is made behind the lock alone, in shared memory: the counter of participants, services' lists of members.
const MADE_BEHIND_LOCK: [&str; 2] = [".global_mgmt", ".dynamic"];

/// Held while making what others will open. To be had by one who is present in the domain.
#[derive(Debug)]
pub(crate) struct Making {
    _lock: File,
}

impl Making {
    /// Waits for its turn, then clears away what the dead left, whole or half made.
    pub(crate) fn begin(domain: &Domain, config: &Config) -> Result<Self, CouplerError> {
        let start = Instant::now();
        loop {
            if let Some(begun) = Self::try_begin(domain, config)? {
                return Ok(begun);
            }
            if start.elapsed() > PATIENCE {
                return Err(CouplerError::SharedMemory {
                    what: "joining after another participant that is just starting",
                    cause: format!("it holds the lock below {} for {PATIENCE:?}", domain.root.display()),
                });
            }
            thread::sleep(Duration::from_millis(1));
        }
    }

    /// As [`Making::begin`], but `None` if it is another's turn.
    pub(crate) fn try_begin(domain: &Domain, config: &Config) -> Result<Option<Self>, CouplerError> {
        let path = domain.root.join("making");
        let refuse = |error: std::io::Error| CouplerError::BadRoot {
            path: domain.root.clone(),
            reason: format!("{} cannot be locked: {error}", path.display()),
        };
        let lock = File::options().create(true).truncate(false).write(true).open(&path).map_err(refuse)?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(fs::TryLockError::WouldBlock) => return Ok(None),
            Err(fs::TryLockError::Error(error)) => return Err(refuse(error)),
        }
        remove_half_made(domain);
        remove_dead(config)?;
        Ok(Some(Self { _lock: lock }))
    }
}

/// Removes what participants of this domain left behind when they were killed. Safe at any time: the living keep theirs.
pub fn clean_up_dead(domain: &Domain) -> Result<(), CouplerError> {
    let config = domain.config()?;
    let _presence = Presence::enter(domain)?;
    Making::begin(domain, &config).map(drop)
}

/// Removes what the dead had whole. To be called behind the lock.
fn remove_dead(config: &Config) -> Result<(), CouplerError> {
    let mut removed = 0;
    Node::<Ipc>::list(config, |state| {
        if let NodeState::Dead(node) = state {
            let id = *node.id();
            match node.try_remove_stale_resources() {
                Ok(()) => removed += 1,
                // Another participant is at it, which is as good.
                Err(cause) => tracing::debug!(%id, %cause, "a dead participant was not cleared away here"),
            }
        }
        CallbackProgression::Continue
    })
    .map_err(|cause| CouplerError::SharedMemory {
        what: "listing the participants",
        cause: cause.to_string(),
    })?;
    if removed > 0 {
        tracing::info!(removed, "cleared away participants that were killed");
    }
    Ok(())
}

/// Removes what can never be opened, for to clear away the dead is to open what they had. To be called behind the lock.
fn remove_half_made(domain: &Domain) {
    // The last thing that iceoryx2 does to a service's description is to take its owner's right to write to it.
    let services = fs::read_dir(domain.root.join("services")).into_iter().flatten().flatten();
    services.map(|entry| entry.path()).filter(|path| owner_may(path, WRITE)).for_each(remove);
    let start = Instant::now();
    loop {
        let is_over = start.elapsed() > ABANDONED;
        let mut is_being_made = false;
        // The last thing that it does to an object in shared memory is to give its owner the right to read it.
        for (name, path) in shared_objects(&domain.prefix).filter(|(_, path)| !owner_may(path, READ)) {
            if is_over || MADE_BEHIND_LOCK.iter().any(|suffix| name.ends_with(suffix)) {
                remove(path);
            } else {
                is_being_made = true;
            }
        }
        if !is_being_made {
            return;
        }
        thread::sleep(Duration::from_millis(1));
    }
}

fn remove(path: PathBuf) {
    tracing::debug!(path = %path.display(), "half made by one who was killed");
    // Another user's cannot be removed, and need not be.
    let _ = fs::remove_file(path);
}

const READ: u32 = 0o400;
const WRITE: u32 = 0o200;

/// Of what has gone meanwhile: that it may read and not write.
fn owner_may(path: &Path, right: u32) -> bool {
    fs::metadata(path).map_or(READ, |data| data.mode()) & right != 0
}

#[cfg(test)]
mod tests {
    use std::fs::Permissions;
    use std::os::unix::fs::PermissionsExt;

    use iceoryx2::prelude::NodeBuilder;

    use super::*;

    #[test]
    fn what_was_half_made_by_the_killed_is_cleared_away_and_what_is_whole_stays() {
        let name = format!("cavt{}m_", std::process::id());
        let domain = Domain { prefix: name.clone(), root: PathBuf::from(format!("/tmp/{name}")) };
        let config = domain.config().unwrap();
        let objects = || shared_objects(&name).map(|(_, path)| path).collect::<Vec<_>>();
        let presence = Presence::enter(&domain).unwrap();
        let make_node = || drop(NodeBuilder::new().config(&config).create::<Ipc>().unwrap());
        make_node();
        let counter = objects();
        assert_eq!(counter.len(), 1, "{counter:?}");
        drop(Making::begin(&domain, &config).unwrap());
        assert_eq!(objects(), counter, "what is whole stays");

        let service = domain.root.join("services").join("half.service");
        fs::create_dir_all(service.parent().unwrap()).unwrap();
        let connection = counter[0].with_extension("connection");
        // Named, but without its length; with its length, but not yet to be read.
        for length in [0, 16] {
            for (path, mode) in [(&counter[0], 0o200), (&connection, 0o200), (&service, 0o600)] {
                let _ = fs::remove_file(path);
                File::create(path).unwrap().set_len(length).unwrap();
                fs::set_permissions(path, Permissions::from_mode(mode)).unwrap();
            }
            let making = Making::begin(&domain, &config).unwrap();
            assert!(objects().is_empty());
            assert!(!service.exists());
            assert!(Making::try_begin(&domain, &config).unwrap().is_none(), "one at a time");
            drop(making);

            // One that is being made is waited for.
            File::create(&connection).unwrap();
            fs::set_permissions(&connection, Permissions::from_mode(0o200)).unwrap();
            let finished = connection.clone();
            let maker = thread::spawn(move || {
                thread::sleep(Duration::from_millis(50));
                fs::set_permissions(finished, Permissions::from_mode(0o600)).unwrap();
            });
            drop(Making::begin(&domain, &config).unwrap());
            maker.join().unwrap();
            fs::remove_file(&connection).expect("it was left alone");
            make_node();
            assert_eq!(objects(), counter);
        }
        drop(presence);
        assert!(objects().is_empty(), "the last one out leaves nothing");
        fs::remove_dir(&domain.root).expect("and nothing below the root");
    }
}
