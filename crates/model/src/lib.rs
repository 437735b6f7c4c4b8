//! The machine, cycle by cycle and bit by bit, in plain Rust integers
