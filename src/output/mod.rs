//! What a run leaves behind: snapshots for ParaView and PyVista, histories, a summary, and the progress shown meanwhile.
//!
//! The module knows nothing of solvers or of case files; it takes names, units and slices. Every file is brought up to
//! date in a copy that is then renamed over it ([`safe_file`]), so that a process killed at any moment leaves readable
//! files, and a reader that has one open is not disturbed.
//!
//! | module | writes |
//! |---|---|
//! | [`vtkhdf`] | `fluid.vtkhdf`, `solid.vtkhdf`: cell fields over time |
//! | [`CellMesh`] | the meshes of these |
//! | [`CellValues`] | their values |
//! | [`background`] | the same on a thread of its own |
//! | [`history`] | `fluid.h5`, `solid.h5`: named series over time |
//! | [`per_depth`] | the units of planar runs |
//! | [`join`] | `history.h5`: both sides' histories under one roof |
//! | [`checkpoint`] | a side's state, to go on from; [`layout`] tells it from one of other types |
//! | [`summary`] | `fluid.json`, `solid.json`, `summary.json` |
//! | [`run_directory`] | the directory itself: made, kept aside, refused or replaced |
//! | [`progress`] | a bar or plain lines on standard error |
//! | [`progress_line`] | the state after a step that both show |
//! | [`progress_file`] | `progress.json`: the same for whoever looks at the directory |
//! | [`run_state`] | what has become of a run, told from its directory |

pub mod background;
mod cell_mesh;
mod cell_values;
pub mod checkpoint;
pub mod error;
mod hdf5_attributes;
mod hdf5_memory;
pub mod history;
pub mod join;
pub mod layout;
pub mod progress;
pub mod progress_file;
pub mod progress_line;
pub mod run_directory;
pub mod run_state;
pub mod safe_file;
pub mod summary;
pub mod throttle;
mod units;
pub mod vtkhdf;

pub use background::{BackgroundWriter, Snapshot};
pub use cell_mesh::{BlockMesh, CellMesh, OwnedQuadMesh};
pub use cell_values::CellValues;
pub use error::OutputError;
pub use hdf5_attributes::{root_attribute, set_of_file};
pub use history::{BufferedColumn, Column, HistoryFile, SeriesId};
pub use join::{Join, dataset_if_there, join_histories};
pub use progress::Progress;
pub use progress_line::ProgressLine;
pub use run_directory::RunDirectory;
pub use run_state::RunState;
pub use units::per_depth;
pub use vtkhdf::{FieldSpec, SeriesWriter, Storage};
