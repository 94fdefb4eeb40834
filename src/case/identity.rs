//! What makes two cases the same: hashes of what they say, and of what they begin from.

use std::fs;

use sha2::{Digest, Sha256};

use super::{Case, LoadCase};
use crate::output::run_directory::WALL;

impl Case {
    /// SHA-256 of what the case computes: of [`Case::effective_toml`] without `[output]` and the waiting times, and of what other runs
    /// have left that it begins from.
    pub fn hash(&self) -> [u8; 32] {
        self.digest(&self.write(false))
    }

    /// SHA-256 of [`Case::effective_toml`], of all that a run computes and writes, and of what other runs have left that it begins from.
    pub fn fingerprint(&self) -> [u8; 32] {
        self.digest(&self.effective_toml())
    }

    /// Of a text, the wall of `solid.initial` and the load of `coupling.load.run`: the directories that these name may have been run anew.
    fn digest(&self, text: &str) -> [u8; 32] {
        let mut sha = Sha256::new_with_prefix(text);
        if let Some(LoadCase::Recorded(load)) = &self.coupling.load {
            load.numbers().for_each(|number| sha.update(number.to_le_bytes()));
        }
        // That there is no such wall is said where it is taken up.
        if let Some(wall) =
            self.solid.as_ref().and_then(|solid| fs::read(solid.initial.as_ref()?.join(WALL)).ok())
        {
            sha.update(wall);
        }
        sha.finalize().into()
    }
}
