//! The C library as C and SystemVerilog see it.

mod support;
mod header;
mod c;
mod dpi;
