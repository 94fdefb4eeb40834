//! A run in this process, step by step.

use std::path::PathBuf;
use std::sync::{Arc, Mutex, MutexGuard, TryLockError};
use std::time::{Duration, Instant};

use cav::case;
use cav::output::{Progress, RunDirectory};
use cav::run::checkpoints::DEFAULT_INTERVAL;
use cav::run::process::launch::{prepare, thread_pool};
use cav::run::process::launch_options::Options;
use cav::run::process::session::{Session, Solvers};
use cav::run::process::stop::Stop;
use cav::run::record::conclusion::{closing_words, conclude};
use cav::run::side::fluid_side::Turn;
use coupler::FrameHeader;
use numpy::{IntoPyArray, PyReadonlyArray1};
use pyo3::exceptions::{PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::ThreadPool;

use crate::case::Case;
use crate::error::{Failure, guarded};
use crate::fields;
use crate::initial::{fluid_from, solid_from};
use crate::log::Log;

/// How often Python gets a say while steps are made.
const SAY: Duration = Duration::from_millis(20);

/// A run in this process. All methods but those of two threads at once may be called at any time.
#[pyclass(frozen, module = "pycav._pycav")]
pub struct Simulation {
    run: Mutex<Run>,
}

struct Run {
    case: case::Case,
    session: Session,
    directory: Option<RunDirectory>,
    log: Log,
    pool: Arc<ThreadPool>,
    stop: Stop,
    /// What the run came to; `None` while it goes on.
    over: Option<Over>,
}

#[derive(Clone, Copy, PartialEq)]
enum Over {
    Completed,
    Closed,
    Failed,
}

impl Run {
    /// A step; `false` when there is none left to make. The last one closes the files.
    fn step(&mut self) -> Result<bool, Failure> {
        if self.over.is_some() {
            return Ok(false);
        }
        let mut turn = self.turn();
        let made = matches!(turn, Ok(Turn::Continues));
        if made && self.session.schedule_mut().is_over() {
            // Nothing is left, of which the media tell each other.
            turn = self.turn();
        }
        match turn {
            Ok(Turn::Continues) => Ok(true),
            Ok(over) => self.end(Ok(over), Over::Completed).map(|()| made),
            Err(Failure::Run(error)) => self.end(Err(error), Over::Failed).map(|()| made),
            Err(panic) => {
                // After a panic nothing of the state can be relied on.
                self.over = Some(Over::Failed);
                Err(panic)
            }
        }
    }

    fn turn(&mut self) -> Result<Turn, Failure> {
        let Self { session, pool, stop, log, .. } = self;
        guarded(|| pool.install(|| log.during(|| session.step(stop))).map_err(Failure::Run))
    }

    fn end(&mut self, result: Result<Turn, cav::run::RunError>, over: Over) -> Result<(), Failure> {
        self.over = Some(over);
        let Self { case, session, pool, directory, log, .. } = self;
        let ended = guarded(|| {
            let ended = pool.install(|| log.during(|| session.end(directory.as_ref(), result)));
            if let Some(directory) = directory.as_ref() {
                let whole = log.during(|| conclude(directory, case, ended.as_ref().err()))?;
                match &ended {
                    Ok(()) => log.done(&closing_words(&whole, case, directory.path())),
                    Err(error) => log.failed(error),
                }
            }
            ended.map_err(Failure::Run)
        });
        // However long Python keeps the object: the run is over.
        if let Some(directory) = directory {
            directory.release();
        }
        ended
    }

    fn close(&mut self) -> Result<(), Failure> {
        if self.over.is_some() {
            return Ok(());
        }
        self.stop.interrupt();
        let Self { session, pool, stop, log, .. } = self;
        let halted = match guarded(|| Ok(pool.install(|| log.during(|| session.halt(stop))))) {
            Ok(halted) => halted,
            Err(panic) => {
                self.over = Some(Over::Failed);
                return Err(panic);
            }
        };
        match self.end(halted, Over::Closed) {
            Err(Failure::Run(cav::run::RunError::Interrupted)) => Ok(()),
            other => other,
        }
    }

    fn time(&self) -> f64 {
        let (fluid, solid) = (self.session.fluid(), self.session.solid());
        fluid.map(|side| side.solver().time()).or(solid.map(|side| side.solver().time())).unwrap_or(0.0)
    }
}

impl Simulation {
    /// Another thread that computes is told of, not waited for: it may be waiting for the interpreter.
    fn run(&self) -> PyResult<MutexGuard<'_, Run>> {
        match self.run.try_lock() {
            Ok(run) => Ok(run),
            Err(TryLockError::Poisoned(poisoned)) => Ok(poisoned.into_inner()),
            Err(TryLockError::WouldBlock) => {
                Err(PyRuntimeError::new_err("the simulation is computing in another thread"))
            }
        }
    }

    /// Steps until `enough`, with a word from Python now and then.
    fn steps(
        &self,
        py: Python<'_>,
        mut enough: impl FnMut(&mut Run) -> bool + Send,
        mut after: impl FnMut(Python<'_>) -> PyResult<()>,
        always: bool,
    ) -> PyResult<()> {
        let mut last = Instant::now();
        loop {
            let goes_on = {
                let mut run = self.run()?;
                let run = &mut *run;
                let enough = &mut enough;
                let pool = Arc::clone(&run.pool);
                let mut turns = || -> Result<bool, Failure> {
                    loop {
                        if enough(run) || !run.step()? {
                            return Ok(false);
                        }
                        if always || last.elapsed() >= SAY {
                            return Ok(true);
                        }
                    }
                };
                // Between two words the interpreter is left alone, and the pool's threads do not change.
                py.detach(|| pool.install(&mut turns))?
            };
            last = Instant::now();
            py.check_signals()?;
            if !goes_on {
                return Ok(());
            }
            after(py)?;
        }
    }
}

#[pymethods]
impl Simulation {
    #[new]
    #[pyo3(signature = (case, out=None, force=false, threads=None, fluid_initial=None, solid_initial=None))]
    fn new(
        py: Python<'_>,
        case: &Case,
        out: Option<PathBuf>,
        force: bool,
        threads: Option<usize>,
        fluid_initial: Option<Py<PyAny>>,
        solid_initial: Option<Py<PyAny>>,
    ) -> PyResult<Self> {
        let case = case.case();
        let run = py.detach(|| {
            guarded(|| {
                case.fits_memory([true; 2]).map_err(cav::run::RunError::from)?;
                let pool = Arc::new(thread_pool(threads)?);
                let options = Options { out: out.clone(), force, ..Options::default() };
                let directory = out.is_some().then(|| prepare(case, &options)).transpose()?;
                let log = Log::of(directory.as_ref().map(RunDirectory::path));
                log.begun(case);
                let make = || -> Result<Session, Failure> {
                    let fluid = fluid_initial.as_ref().map(|f| fluid_from(case, f)).transpose()?;
                    let solid = solid_initial.as_ref().map(|f| solid_from(case, f)).transpose()?;
                    Ok(Session::new(case, directory.as_ref(), Solvers { fluid, solid })?)
                };
                let mut session = pool.install(|| log.during(make)).inspect_err(|failure| {
                    if let Failure::Run(error) = failure {
                        log.failed(error);
                    }
                })?;
                if let Some(directory) = &directory {
                    session.keep_checkpoints(case, directory, DEFAULT_INTERVAL);
                }
                let (stop, case) = (Stop::default(), case.clone());
                Ok(Run { case, session, directory, log, pool, stop, over: None })
            })
        })?;
        Ok(Self { run: Mutex::new(run) })
    }

    /// Time, s.
    #[getter]
    fn time(&self) -> PyResult<f64> {
        Ok(self.run()?.time())
    }

    /// Steps made.
    #[getter]
    fn steps_made(&self) -> PyResult<u64> {
        let run = self.run()?;
        let (fluid, solid) = (run.session.fluid(), run.session.solid());
        Ok(fluid.map(|side| side.solver().steps()).or(solid.map(|side| side.solver().steps())).unwrap_or(0))
    }

    /// Length of the last step, s; 0 before the first.
    #[getter]
    fn dt(&self) -> PyResult<f64> {
        let run = self.run()?;
        let (fluid, solid) = (run.session.fluid(), run.session.solid());
        Ok(fluid.map(|side| side.last_step()).or(solid.map(|side| side.last_step())).unwrap_or(0.0))
    }

    /// Whether the end is reached.
    #[getter]
    fn completed(&self) -> PyResult<bool> {
        Ok(self.run()?.over == Some(Over::Completed))
    }

    /// Whether no more steps can be made.
    #[getter]
    fn closed(&self) -> PyResult<bool> {
        Ok(self.run()?.over.is_some())
    }

    /// The run directory.
    #[getter]
    fn directory(&self) -> PyResult<Option<PathBuf>> {
        Ok(self.run()?.directory.as_ref().map(|directory| directory.path().to_owned()))
    }

    /// Makes a step; `False` if there was none left to make.
    fn step(&self, py: Python<'_>) -> PyResult<bool> {
        let made = {
            let mut run = self.run()?;
            let run = &mut *run;
            py.detach(|| run.step())?
        };
        py.check_signals()?;
        Ok(made)
    }

    /// Makes steps until `time`, at which the last one ends.
    fn advance_to(&self, py: Python<'_>, time: f64) -> PyResult<()> {
        {
            let mut run = self.run()?;
            let end = run.case.time.end;
            if !(time <= end * (1.0 + 1e-12)) {
                return Err(PyValueError::new_err(format!("{time} s is after the end of the run, {end} s")));
            }
            if time <= run.time() || run.over.is_some() {
                return Ok(());
            }
            run.session.schedule_mut().land_at(time.min(end));
        }
        let enough = |run: &mut Run| run.session.schedule_mut().landing().is_none();
        self.steps(py, enough, |_| Ok(()), false)
    }

    /// Makes all steps that are left. `callback` is called without arguments after every step.
    #[pyo3(signature = (callback=None, progress=false))]
    fn run_to_end(&self, py: Python<'_>, callback: Option<Py<PyAny>>, progress: bool) -> PyResult<()> {
        let mut bar = {
            let run = self.run()?;
            let bar = Progress::new(run.case.time.end, !progress, 0);
            match run.directory.as_ref() {
                Some(directory) => bar.told_in(directory),
                None => bar,
            }
        };
        let after = |py: Python<'_>| {
            let run = self.run()?;
            if run.over.is_none() {
                bar.update(&run.session.line());
            }
            drop(run);
            callback.as_ref().map_or(Ok(()), |callback| callback.call0(py).map(|_| ()))
        };
        let has_callback = callback.is_some();
        let made = self.steps(py, |_| false, after, has_callback);
        match (&made, self.directory()?) {
            (Ok(()), Some(directory)) if progress => {
                let run = self.run()?;
                let file =
                    RunDirectory::open(&directory).map(|d| d.file(cav::output::run_directory::SUMMARY));
                let whole = file.and_then(|file| cav::output::summary::read(&file)).unwrap_or_default();
                bar.finish(&closing_words(&serde_json::Map::from_iter(whole), &run.case, &directory));
            }
            _ => bar.clear(),
        }
        made
    }

    /// Closes the files of a run that is not to go on.
    fn close(&self, py: Python<'_>) -> PyResult<()> {
        let mut run = self.run()?;
        let run = &mut *run;
        py.detach(|| run.close())?;
        Ok(())
    }

    /// Writes what the histories have in memory.
    fn flush(&self, py: Python<'_>) -> PyResult<()> {
        let mut run = self.run()?;
        let run = &mut *run;
        py.detach(|| run.session.flush()).map_err(|error| Failure::Run(error).into())
    }

    /// The columns of the histories in memory: path to (values of shape (rows,) or (rows, width), unit, description).
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let found = PyDict::new(py);
        let run = self.run()?;
        for column in run.session.histories().flat_map(|history| history.columns()) {
            let array = column.values.into_pyarray(py).into_any();
            let array = match column.width {
                1 => array,
                width => array.call_method1("reshape", ((-1, width),))?,
            };
            found.set_item(column.path, (array, column.unit, column.description))?;
        }
        Ok(found)
    }

    /// The summary so far, as JSON.
    fn summary(&self) -> PyResult<String> {
        let run = self.run()?;
        let result = Ok(match run.over {
            Some(Over::Completed) => Turn::Over(0),
            _ => Turn::Over(FrameHeader::STOP_INTERRUPT),
        });
        Ok(serde_json::Value::Object(run.session.summary(&result)).to_string())
    }

    /// Cells of a medium: places, sizes, levels and fields, each of shape (cells,).
    fn cells<'py>(&self, py: Python<'py>, medium: &str) -> PyResult<Bound<'py, PyDict>> {
        let run = self.run()?;
        match (medium, run.session.fluid(), run.session.solid()) {
            ("fluid", Some(side), _) => fields::cells(py, side.solver()),
            ("solid", _, Some(side)) => fields::cells(py, side.solver()),
            _ => Err(no_medium(medium)),
        }
    }

    /// A medium at the points of a regular grid, each field of shape (len(z), len(r)), NaN outside.
    fn sample<'py>(
        &self,
        py: Python<'py>,
        medium: &str,
        z: PyReadonlyArray1<'py, f64>,
        r: PyReadonlyArray1<'py, f64>,
    ) -> PyResult<Bound<'py, PyDict>> {
        let run = self.run()?;
        match (medium, run.session.fluid(), run.session.solid()) {
            ("fluid", Some(side), _) => fields::sample(py, side.solver(), &z, &r),
            ("solid", _, Some(side)) => fields::sample(py, side.solver(), &z, &r),
            _ => Err(no_medium(medium)),
        }
    }

    /// Panics on purpose, for the test that a panic becomes an exception and does no harm.
    fn _panic(&self, py: Python<'_>) -> PyResult<()> {
        Ok(py.detach(|| guarded(|| panic!("on purpose")))?)
    }
}

fn no_medium(medium: &str) -> PyErr {
    PyValueError::new_err(format!("the case has no {medium}; media are \"fluid\" and \"solid\""))
}
