//! The work of a solver as code of the crate that has it.

#[cfg(doc)]
use super::BlockSolver;
use super::{Model, SavedBlocks};
use crate::{BLOCK, GroupStep, Misfit, Part};

/// The work of a solver of blocks of [`BLOCK`], compiled once, where [`compiled_solver`](crate::compiled_solver) makes it.
///
/// What is generic over the width of blocks is compiled anew by every crate that uses it. These are methods of [`BlockSolver`] by the same
/// names. Where this trait is in scope they come before those.
pub trait CompiledSolver<M: Model<BLOCK>> {
    /// [`BlockSolver::start`].
    fn start(&mut self, limit: f64) -> GroupStep;

    /// [`BlockSolver::run`].
    ///
    /// # Errors
    /// As there.
    fn run(&mut self, step: GroupStep, part: Part) -> Result<(), M::Error>;

    /// [`BlockSolver::finish`].
    ///
    /// # Errors
    /// As there.
    fn finish(&mut self) -> Result<(), M::Error>;

    /// [`BlockSolver::step`].
    ///
    /// # Errors
    /// As there.
    fn step(&mut self, dt: f64) -> Result<(), M::Error>;

    /// [`BlockSolver::adapt`].
    fn adapt(&mut self, dt: f64, steps: u32) -> bool;

    /// [`BlockSolver::adapt_if_due`].
    fn adapt_if_due(&mut self, dt: f64, steps: u32) -> bool;

    /// [`BlockSolver::restore`].
    ///
    /// # Errors
    /// As there.
    fn restore(&mut self, saved: SavedBlocks<'_, M::Report, M::Memory>) -> Result<(), Misfit>;
}

/// Compiles the work of a solver, of blocks of [`BLOCK`](crate::BLOCK), that dereferences to a [`BlockSolver`] of a model.
#[macro_export]
macro_rules! compiled_solver {
    ($Solver:ty, $Model:ty) => {
        impl $crate::CompiledSolver<$Model> for $Solver {
            fn start(&mut self, limit: f64) -> $crate::GroupStep {
                (**self).start(limit)
            }

            fn run(
                &mut self,
                step: $crate::GroupStep,
                part: $crate::Part,
            ) -> Result<(), <$Model as $crate::Model<{ $crate::BLOCK }>>::Error> {
                (**self).run(step, part)
            }

            fn finish(&mut self) -> Result<(), <$Model as $crate::Model<{ $crate::BLOCK }>>::Error> {
                (**self).finish()
            }

            fn step(&mut self, dt: f64) -> Result<(), <$Model as $crate::Model<{ $crate::BLOCK }>>::Error> {
                (**self).step(dt)
            }

            fn adapt(&mut self, dt: f64, steps: u32) -> bool {
                (**self).adapt(dt, steps)
            }

            fn adapt_if_due(&mut self, dt: f64, steps: u32) -> bool {
                (**self).adapt_if_due(dt, steps)
            }

            fn restore(
                &mut self,
                saved: $crate::SavedBlocks<
                    '_,
                    <$Model as $crate::Model<{ $crate::BLOCK }>>::Report,
                    <$Model as $crate::Model<{ $crate::BLOCK }>>::Memory,
                >,
            ) -> Result<(), $crate::Misfit> {
                (**self).restore(saved)
            }
        }
    };
}
