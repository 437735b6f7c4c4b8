//! Readable Verilog-2001 from a netlist
