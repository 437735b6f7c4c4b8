//! The `edgewalk` program: a file a command.

fn main() {}
