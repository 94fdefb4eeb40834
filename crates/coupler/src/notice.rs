//! What a participant says while it waits.

/// Told what the user should know while a participant waits.
pub type Notice = Box<dyn FnMut(&str) + Send>;
