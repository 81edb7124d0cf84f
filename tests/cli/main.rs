//! The command line keeps its contract: exit statuses, one line a failure, one JSON object, nothing half-written.

mod bad_input;
mod bad_look;
mod json;
mod profile;
mod program;
mod sequence;
mod usage;
