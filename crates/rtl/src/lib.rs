//! The machine as netlists, a unit a file
