//! The checkpoints of a run: when one is due, where its parts are, which are kept, and which is the one to go on from.
//!
//! In a coupled run each side writes its own part, at the same coupled time: the fluid before the step that it is about to
//! plan, the solid when the fluid's next frame tells it to, before it looks at anything else in it. A checkpoint counts when
//! all parts are there. The last two are kept, and of a finished run the last: it is taken shortly before the end, where all is
//! still as in a run that ends later.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use coupler::Participant;
use serde::Serialize;
use serde::de::DeserializeOwned;

use crate::case::Case;
use crate::output::checkpoint::{self, CheckpointFault, Head};
use crate::output::run_directory::CHECKPOINTS;
use crate::output::safe_file::TEMPORARY_SUFFIX;
use crate::output::{OutputError, RunDirectory};
use crate::run::RunError;
use crate::run::side::fluid_side::saved::FluidSideState;
use crate::run::side::solid_side::saved::SolidSideState;

/// How often, if nothing else is said.
pub const DEFAULT_INTERVAL: Duration = Duration::from_secs(300);

/// How many are kept.
const KEPT: usize = 2;

const SUFFIX: &str = ".ckpt";

/// The checkpoints in a run directory.
#[derive(Clone, Debug)]
pub struct Checkpoints {
    directory: PathBuf,
    case: [u8; 32],
    /// The case that they may be of besides: the same with an earlier end.
    shorter: Option<[u8; 32]>,
    sides: Vec<Participant>,
}

/// Writes checkpoints at intervals of wall time.
#[derive(Clone, Debug)]
pub struct Keeper {
    checkpoints: Checkpoints,
    every: Duration,
    last: Instant,
    /// Whether there is one from shortly before the end.
    is_before_end: bool,
}

impl Checkpoints {
    /// Those of a case in a directory.
    pub fn of(case: &Case, directory: &RunDirectory) -> Self {
        let fluid = case.fluid.as_ref().map(|_| Participant::Fluid);
        let solid = case.solid.as_ref().map(|_| Participant::Solid);
        Self {
            directory: directory.file(CHECKPOINTS),
            case: case.fingerprint(),
            shorter: None,
            // In the order in which the parts are written.
            sides: fluid.into_iter().chain(solid).collect(),
        }
    }

    /// The same, which may also be those of the case as it was when it ended earlier.
    pub fn or_of(self, shorter: &Case) -> Self {
        Self { shorter: Some(shorter.fingerprint()), ..self }
    }

    /// Where a part is.
    pub fn path(&self, side: Participant, step: u64) -> PathBuf {
        self.directory.join(format!("{side}-{step:012}{SUFFIX}"))
    }

    /// Writes a side's part; with the last part of it, forgets older checkpoints.
    pub fn write<T: Serialize + DeserializeOwned>(
        &self,
        side: Participant,
        step: u64,
        state: &T,
    ) -> Result<(), OutputError> {
        let start = Instant::now();
        match fs::create_dir(&self.directory) {
            Err(error) if error.kind() != std::io::ErrorKind::AlreadyExists => {
                return Err(OutputError::io(&self.directory, "make")(error));
            }
            _ => {}
        }
        let path = self.path(side, step);
        let head = Head::of(self.case, side.name(), step);
        checkpoint::write(&path, &head, state)?;
        let bytes = fs::metadata(&path).map_or(0, |file| file.len());
        tracing::info!(%side, step, bytes, seconds = start.elapsed().as_secs_f64(), "checkpoint");
        if self.sides.last() == Some(&side) {
            let whole = self.whole()?;
            if let Some(oldest) = whole.iter().rev().nth(KEPT - 1) {
                self.forget(|side, step| side.is_some() && step < *oldest)?;
            }
        }
        Ok(())
    }

    /// A side's part of a checkpoint.
    pub fn read<T: DeserializeOwned>(&self, side: Participant, step: u64) -> Result<T, RunError> {
        let path = self.path(side, step);
        let fault =
            |fault: CheckpointFault| RunError::Resume { path: path.clone(), reason: fault.to_string() };
        let (head, state) = checkpoint::read(&path).map_err(fault)?;
        self.check(&path, side, &head).map(|()| state)
    }

    /// The newest checkpoint that can be gone on from, by its step; `None` if there has not been any. Newer ones that are
    /// damaged or have not all parts are removed.
    ///
    /// - `warn`: told of each that is damaged.
    /// - errors: all are damaged, or the case was another one.
    pub fn newest(&self, mut warn: impl FnMut(String)) -> Result<Option<u64>, RunError> {
        let mut faults = Vec::new();
        let mut found = None;
        for step in self.whole()?.into_iter().rev() {
            match self.verify(step)? {
                None => {
                    found = Some(step);
                    break;
                }
                Some(fault) => faults.push((step, fault)),
            }
        }
        for (step, fault) in &faults {
            let then = found.map_or_else(String::new, |good| format!("; going on from that of step {good}"));
            warn(format!("the checkpoint of step {step} cannot be used: {fault}{then}"));
        }
        if let (None, Some((_, fault))) = (found, faults.last()) {
            let reason = format!(
                "none of its checkpoints can be used ({fault}); run the case anew in another directory"
            );
            return Err(RunError::Resume { path: self.directory.clone(), reason });
        }
        self.forget(|side, step| side.is_none() || found.is_none_or(|found| step > found))?;
        Ok(found)
    }

    /// Makes the newest checkpoint, if it is of the case that ended earlier, one of the case itself, and forgets all others.
    ///
    /// - errors: a part cannot be read, or written.
    pub fn take_over(&self, step: u64) -> Result<(), RunError> {
        for side in &self.sides {
            let path = self.path(*side, step);
            checkpoint::change_case(&path, self.case)
                .map_err(|fault| RunError::Resume { path: path.clone(), reason: fault.to_string() })?;
        }
        Ok(self.keep_newest()?)
    }

    /// Forgets all but the newest: the run is finished.
    pub fn keep_newest(&self) -> Result<(), OutputError> {
        let newest = self.whole()?.pop();
        self.forget(|side, step| side.is_none() || Some(step) != newest)?;
        // Without any there is nothing in it.
        let _ = fs::remove_dir(&self.directory);
        Ok(())
    }

    /// Whether there is one that has all parts.
    pub fn are_there(&self) -> bool {
        self.whole().is_ok_and(|whole| !whole.is_empty())
    }

    /// What is wrong with a checkpoint, if anything is.
    ///
    /// - errors: it is whole, but of another case.
    fn verify(&self, step: u64) -> Result<Option<String>, RunError> {
        for side in &self.sides {
            let path = self.path(*side, step);
            let head = match side {
                Participant::Fluid => checkpoint::verify::<FluidSideState<'static>>(&path),
                Participant::Solid => checkpoint::verify::<SolidSideState<'static>>(&path),
            };
            match head {
                Ok(head) => self.check(&path, *side, &head)?,
                Err(fault) => return Ok(Some(format!("{}: {fault}", path.display()))),
            }
        }
        Ok(None)
    }

    fn check(&self, path: &Path, side: Participant, head: &Head) -> Result<(), RunError> {
        if head.side != side.name() || !path.ends_with(self.path(side, head.step)) {
            let reason = format!("it is the {}'s of step {}, under another name", head.side, head.step);
            return Err(RunError::Resume { path: path.to_path_buf(), reason });
        }
        if head.case != self.case && Some(head.case) != self.shorter {
            let reason = format!(
                "it is of another case than case.toml beside it, or of another wall or load that this begins from, or written by \
                 another version ({}); put these back as they were, or run the changed case in another directory",
                head.program
            );
            return Err(RunError::Resume { path: path.to_path_buf(), reason });
        }
        Ok(())
    }

    /// The steps of the checkpoints that have all parts, ascending.
    fn whole(&self) -> Result<Vec<u64>, OutputError> {
        let mut parts = BTreeMap::<u64, usize>::new();
        for (side, step, _) in self.parts()? {
            *parts.entry(step).or_default() +=
                usize::from(side.is_some_and(|side| self.sides.contains(&side)));
        }
        Ok(parts.into_iter().filter(|(_, count)| *count == self.sides.len()).map(|(step, _)| step).collect())
    }

    /// Removes some files, by their side, if they are whole, and their step.
    fn forget(&self, is_old: impl Fn(Option<Participant>, u64) -> bool) -> Result<(), OutputError> {
        for (side, step, path) in self.parts()? {
            if is_old(side, step) {
                fs::remove_file(&path).map_err(OutputError::io(&path, "remove"))?;
            }
        }
        Ok(())
    }

    /// All files of checkpoints, whole ones with their sides.
    fn parts(&self) -> Result<Vec<(Option<Participant>, u64, PathBuf)>, OutputError> {
        let entries = match fs::read_dir(&self.directory) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
            other => other.map_err(OutputError::io(&self.directory, "list"))?,
        };
        let mut parts = Vec::new();
        for entry in entries {
            let path = entry.map_err(OutputError::io(&self.directory, "list"))?.path();
            let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
            let (whole, is_made) = match name.strip_suffix(TEMPORARY_SUFFIX) {
                Some(whole) => (whole.to_owned(), false),
                None => (name, true),
            };
            for side in [Participant::Fluid, Participant::Solid] {
                let number = whole.strip_prefix(side.name()).and_then(|rest| rest.strip_prefix('-'));
                if let Some(step) = number.and_then(|rest| rest.strip_suffix(SUFFIX)?.parse().ok()) {
                    parts.push((is_made.then_some(side), step, path.clone()));
                }
            }
        }
        Ok(parts)
    }
}

impl Keeper {
    /// The first is due in `every` from now.
    pub fn new(checkpoints: Checkpoints, every: Duration) -> Self {
        Self { checkpoints, every, last: Instant::now(), is_before_end: false }
    }

    /// Whether it is time for the next one; to be asked before each step, and followed where it is.
    ///
    /// - `ends`: whether the step is one of the run's last.
    pub fn is_due(&mut self, ends: bool) -> bool {
        let is_last = ends && !std::mem::replace(&mut self.is_before_end, true);
        is_last || self.last.elapsed() >= self.every
    }

    /// Writes a side's part.
    pub fn write<T: Serialize + DeserializeOwned>(
        &mut self,
        side: Participant,
        step: u64,
        state: &T,
    ) -> Result<(), OutputError> {
        self.checkpoints.write(side, step, state)?;
        self.last = Instant::now();
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::output::layout::description;

    /// Nothing of what checkpoints hold is left out of their layout because a type does not take what is made up for it.
    #[test]
    fn states_are_laid_out_to_their_ends() {
        let fluid = description::<FluidSideState<'static>>();
        let solid = description::<SolidSideState<'static>>();
        for (text, parts) in [
            (
                &fluid,
                ["FluidSideState( solver:SavedBlocks( leaves:seq( ", "answer:FrameHeader( ", "done:Done( "],
            ),
            (&solid, ["SolidSideState( solver:SavedBlocks( leaves:seq( ", "promised:f64 ", "done:Done( "]),
        ] {
            assert!(!text.contains("refused"), "{text}");
            parts.iter().for_each(|part| assert!(text.contains(part), "{part} in {text}"));
        }
    }
}
