//! Snapshots written by a thread of their own, so that the solver does not wait for compression and disk.

use std::sync::Arc;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread::JoinHandle;

use super::{CellMesh, CellValues, OutputError, SeriesWriter};

/// A snapshot with its own data.
#[derive(Debug)]
pub struct Snapshot {
    /// Time, s.
    pub time: f64,
    /// The mesh.
    pub mesh: Arc<dyn CellMesh>,
    /// Equal to that of the snapshot before where the mesh is the same.
    pub mesh_id: u64,
    /// Values of each field.
    pub values: Box<dyn CellValues>,
}

/// A [`SeriesWriter`] on a thread of its own.
///
/// A snapshot is handed over when the one before is in the file, so a kill loses no more than the one being written,
/// and no more than one takes memory. Dropping it writes what it has, as [`close`](Self::close) does.
#[derive(Debug)]
pub struct BackgroundWriter {
    /// There until the thread is asked to end.
    thread: Option<Thread>,
    path: std::path::PathBuf,
}

/// What the thread is asked for.
#[derive(Debug)]
enum Job {
    Write(Snapshot),
    /// Whoever hands this over knows then that all before is written.
    Meet,
    /// The same, and counts on it.
    CountOn,
}

/// The thread, and the way to it.
#[derive(Debug)]
struct Thread {
    sender: SyncSender<Job>,
    handle: JoinHandle<Result<(), OutputError>>,
}

impl BackgroundWriter {
    /// Starts the thread.
    pub fn start(writer: SeriesWriter) -> Result<Self, OutputError> {
        // No room in between: handing over is meeting the thread when it has nothing to do.
        let (sender, receiver) = sync_channel(0);
        let path = writer.path().to_path_buf();
        // As many as the solver has, which waits for the last snapshot. They sleep while there is none.
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(rayon::current_num_threads())
            .thread_name(|number| format!("chunks-{number}"))
            .build()
            .map_err(std::io::Error::other)
            .map_err(OutputError::io(&path, "start the threads that compress"))?;
        let handle = std::thread::Builder::new()
            .name("snapshots".to_owned())
            .spawn(move || pool.install(|| write_all(writer, receiver)))
            .map_err(OutputError::io(&path, "start the thread that writes"))?;
        Ok(Self { thread: Some(Thread { sender, handle }), path })
    }

    /// Hands a snapshot over, once the one before is in the file.
    ///
    /// - errors: what went wrong with an earlier snapshot; nothing is written after that.
    pub fn append(&mut self, snapshot: Snapshot) -> Result<(), OutputError> {
        self.hand_over(Job::Write(snapshot))
    }

    /// Waits until all snapshots so far are in the file: a checkpoint counts on them.
    ///
    /// - errors: what went wrong with one of them.
    pub fn catch_up(&mut self) -> Result<(), OutputError> {
        self.hand_over(Job::CountOn)
    }

    /// Waits until all snapshots so far are in the file, and none takes memory any more.
    ///
    /// - errors: what went wrong with one of them.
    pub fn wait(&mut self) -> Result<(), OutputError> {
        self.hand_over(Job::Meet)
    }

    /// The file.
    pub fn path(&self) -> &std::path::Path {
        &self.path
    }

    fn hand_over(&mut self, job: Job) -> Result<(), OutputError> {
        let gone = match &self.thread {
            Some(Thread { sender, .. }) => sender.send(job).is_err(),
            None => true,
        };
        if !gone {
            return Ok(());
        }
        self.close()?;
        Err(OutputError::Closed { path: self.path.clone() })
    }

    /// Whether all is well so far; cheap enough for every step.
    ///
    /// - errors: what went wrong with an earlier snapshot.
    pub fn check(&mut self) -> Result<(), OutputError> {
        if self.thread.as_ref().is_some_and(|thread| thread.handle.is_finished()) {
            self.close()
        } else {
            Ok(())
        }
    }

    /// Waits until everything is in the file, and ends the thread.
    ///
    /// - errors: what went wrong with a snapshot, unless it has been said before.
    pub fn close(&mut self) -> Result<(), OutputError> {
        let Some(Thread { sender, handle }) = self.thread.take() else { return Ok(()) };
        drop(sender);
        handle.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    }
}

impl Drop for BackgroundWriter {
    fn drop(&mut self) {
        let Some(Thread { sender, handle }) = self.thread.take() else { return };
        drop(sender);
        // Who wants to know of errors closes it first.
        if let Ok(Err(error)) = handle.join() {
            tracing::error!("{error}");
        }
    }
}

/// Writes what comes until nothing more can come.
fn write_all(mut writer: SeriesWriter, jobs: Receiver<Job>) -> Result<(), OutputError> {
    for job in jobs {
        let snapshot = match job {
            Job::Write(snapshot) => snapshot,
            Job::Meet => continue,
            Job::CountOn => {
                writer.count_on_it();
                continue;
            }
        };
        writer.append(snapshot.time, &*snapshot.mesh, snapshot.mesh_id, &*snapshot.values)?;
    }
    writer.finish()
}
