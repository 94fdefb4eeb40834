//! The records of all runs of a folder in SQLite: `.cav-index.sqlite`.
//!
//! It holds nothing that the runs' files do not: it may be deleted at any time, and is made anew if it is damaged or another version's.

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use rusqlite::{Connection, OpenFlags, params};

use crate::runs::find::Found;
use crate::runs::record::Record;

/// Its file in the folder.
pub const FILE: &str = ".cav-index.sqlite";

/// What its tables mean; a change counts it up.
const VERSION: i64 = 1;

/// How long another listing that is writing is waited for.
const PATIENCE: Duration = Duration::from_secs(2);

const SCHEMA: &str = "
    DROP TABLE IF EXISTS runs;
    CREATE TABLE runs (
        path TEXT PRIMARY KEY,
        stamp TEXT NOT NULL,
        \"case\" TEXT NOT NULL,
        summary TEXT NOT NULL
    );";

/// The index of a folder.
#[derive(Debug)]
pub struct Index {
    path: PathBuf,
    connection: Connection,
}

impl Index {
    /// Opens the index of a folder, for reading alone where it may not be written; makes it if need be.
    ///
    /// # Errors
    /// There is none that can be read, and none can be made.
    pub fn open(folder: &Path) -> rusqlite::Result<Self> {
        let path = folder.join(FILE);
        let writable =
            Self::prepared(&path, OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_CREATE);
        writable.or_else(|error| match Self::prepared(&path, OpenFlags::SQLITE_OPEN_READ_ONLY) {
            Ok(index) => Ok(index),
            Err(_) if is_damaged(&error) => {
                // Ours, and of no worth as it is.
                let _ = fs::remove_file(&path);
                Self::prepared(&path, OpenFlags::SQLITE_OPEN_READ_WRITE | OpenFlags::SQLITE_OPEN_CREATE)
            }
            Err(_) => Err(error),
        })
    }

    fn prepared(path: &Path, flags: OpenFlags) -> rusqlite::Result<Self> {
        let connection = Connection::open_with_flags(path, flags | OpenFlags::SQLITE_OPEN_NO_MUTEX)?;
        connection.busy_timeout(PATIENCE)?;
        // What a loss of power takes is read again from the runs.
        connection.pragma_update(None, "synchronous", "OFF")?;
        let version: i64 = connection.pragma_query_value(None, "user_version", |row| row.get(0))?;
        if version != VERSION {
            connection.execute_batch(SCHEMA)?;
            connection.pragma_update(None, "user_version", VERSION)?;
        }
        Ok(Self { path: path.to_path_buf(), connection })
    }

    /// Its file.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The records of those of these runs whose files have not changed since, by path.
    ///
    /// # Errors
    /// The file cannot be read.
    pub fn known<'a>(&self, found: &'a [Found]) -> rusqlite::Result<HashMap<&'a str, Record>> {
        let wanted: HashMap<&str, &'a Found> =
            found.iter().map(|found| (found.path.as_str(), found)).collect();
        let mut known = HashMap::new();
        let mut query = self.connection.prepare("SELECT path, stamp, \"case\", summary FROM runs")?;
        let mut rows = query.query([])?;
        while let Some(row) = rows.next()? {
            let current = wanted.get(row.get_ref(0)?.as_str()?);
            let Some(found) =
                current.filter(|found| row.get_ref(1).is_ok_and(|stamp| stamp.as_str() == Ok(&found.stamp)))
            else {
                continue;
            };
            let record = Record { found: (*found).clone(), case: row.get(2)?, summary: row.get(3)? };
            known.insert(found.path.as_str(), record);
        }
        Ok(known)
    }

    /// Takes up records, and forgets the runs that are not among all that there are.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn update(&mut self, new: &[&Record], all: &[Found]) -> rusqlite::Result<()> {
        let act = self.connection.transaction()?;
        {
            let mut put = act.prepare("INSERT OR REPLACE INTO runs VALUES (?1, ?2, ?3, ?4)")?;
            for Record { found, case, summary } in new {
                put.execute(params![found.path, found.stamp, case, summary])?;
            }
            let count: i64 = act.query_row("SELECT COUNT(*) FROM runs", [], |row| row.get(0))?;
            if count > all.len() as i64 {
                act.execute_batch("CREATE TEMP TABLE there (path TEXT PRIMARY KEY)")?;
                let mut put = act.prepare("INSERT INTO there VALUES (?1)")?;
                for found in all {
                    put.execute([&found.path])?;
                }
                act.execute_batch(
                    "DELETE FROM runs WHERE path NOT IN (SELECT path FROM there); DROP TABLE there;",
                )?;
            }
        }
        act.commit()
    }
}

/// Whether a file is no database, or no more one.
fn is_damaged(error: &rusqlite::Error) -> bool {
    use rusqlite::ErrorCode::{DatabaseCorrupt, NotADatabase};
    matches!(error.sqlite_error_code(), Some(DatabaseCorrupt | NotADatabase))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(path: &str, stamp: &str) -> Record {
        let found = Found { path: path.to_owned(), stamp: stamp.to_owned(), started: 0 };
        Record { found, case: format!("{{\"of\":\"{path}\"}}"), summary: "{}".to_owned() }
    }

    #[test]
    fn only_runs_that_are_as_they_were_are_known_and_those_that_are_gone_are_forgotten() {
        let place = tempfile::tempdir().expect("a directory");
        let records = ["a", "b", "c"].map(|path| record(path, "1"));
        let found = records.clone().map(|record| record.found);
        let mut index = Index::open(place.path()).expect("it is made");
        index.update(&records.each_ref(), &found).expect("it is written");
        drop(index);
        let mut index = Index::open(place.path()).expect("it opens");
        let now = [record("a", "1").found, record("b", "2").found];
        let known = index.known(&now).expect("it is read");
        assert_eq!(known.into_iter().collect::<Vec<_>>(), [("a", records[0].clone())]);
        index.update(&[&record("b", "2")], &now).expect("it is written");
        assert_eq!(index.known(&found).expect("it is read").len(), 1, "c is forgotten, b has changed");
    }

    #[test]
    fn a_damaged_index_and_one_of_another_version_are_made_anew() {
        let place = tempfile::tempdir().expect("a directory");
        let found = [record("a", "1").found];
        let mut index = Index::open(place.path()).expect("it is made");
        index.update(&[&record("a", "1")], &found).expect("it is written");
        index.connection.pragma_update(None, "user_version", VERSION + 1).expect("it is written");
        drop(index);
        assert!(Index::open(place.path()).expect("it opens").known(&found).expect("it is read").is_empty());
        fs::write(place.path().join(FILE), "no database, but something else of some length".repeat(100))
            .expect("a file");
        let mut index = Index::open(place.path()).expect("it is made anew");
        index.update(&[&record("a", "1")], &found).expect("it is written");
        assert_eq!(index.known(&found).expect("it is read").len(), 1);
    }
}
