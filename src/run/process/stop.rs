//! Signals, and a launcher that is gone.

use std::io::Read;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use coupler::{CouplerError, FrameHeader, Interrupt};
use signal_hook::consts::{SIGINT, SIGTERM};

use crate::run::RunError;

/// What has asked this process to stop.
#[derive(Clone, Debug, Default)]
pub struct Stop {
    interrupt: Arc<AtomicBool>,
    terminate: Arc<AtomicBool>,
    launcher_gone: Arc<AtomicBool>,
}

impl Stop {
    /// Listens to SIGINT and SIGTERM from now on: the step under way is finished, files are closed.
    ///
    /// - errors: the signals cannot be caught.
    pub fn on_signals() -> Result<Self, RunError> {
        let stop = Self::default();
        for (signal, flag) in [(SIGINT, &stop.interrupt), (SIGTERM, &stop.terminate)] {
            signal_hook::flag::register(signal, Arc::clone(flag))
                .map_err(|source| RunError::Start { what: "signal handling".to_owned(), source })?;
        }
        Ok(stop)
    }

    /// Asks for the end, as SIGINT does.
    pub fn interrupt(&self) {
        self.interrupt.store(true, Ordering::Relaxed);
    }

    /// Watches standard input, which the launcher holds open: its end means that the launcher is gone.
    pub fn watch_launcher(&self) {
        let gone = Arc::clone(&self.launcher_gone);
        std::thread::spawn(move || {
            let mut buffer = [0; 64];
            while matches!(std::io::stdin().read(&mut buffer), Ok(n) if n > 0) {}
            gone.store(true, Ordering::Relaxed);
        });
    }

    /// The flags of a frame that tell the peer of it.
    pub fn flags(&self) -> u32 {
        let terminate = self.terminate.load(Ordering::Relaxed) || self.launcher_gone.load(Ordering::Relaxed);
        if terminate {
            FrameHeader::STOP_TERMINATE
        } else if self.interrupt.load(Ordering::Relaxed) {
            FrameHeader::STOP_INTERRUPT
        } else {
            0
        }
    }

    /// The error with which a run ends that was asked to stop by the flags of a frame.
    pub fn error(flags: u32) -> Option<RunError> {
        if flags & FrameHeader::STOP_TERMINATE != 0 {
            Some(RunError::Terminated)
        } else if flags & FrameHeader::STOP_INTERRUPT != 0 {
            Some(RunError::Interrupted)
        } else {
            None
        }
    }

    /// Ends a wait for the peer: at once when the launcher is gone, and while `connecting` on any request.
    pub fn hook(&self, connected: Arc<AtomicBool>) -> Interrupt {
        let stop = self.clone();
        Box::new(move || {
            if stop.launcher_gone.load(Ordering::Relaxed) {
                return Err(CouplerError::Interrupted { reason: "the launcher is gone".to_owned() });
            }
            if !connected.load(Ordering::Relaxed) && stop.flags() != 0 {
                return Err(CouplerError::Interrupted {
                    reason: "asked to stop while waiting for the peer".to_owned(),
                });
            }
            Ok(())
        })
    }
}
