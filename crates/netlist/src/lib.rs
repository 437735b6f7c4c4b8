//! Registers, operators and memories: builder, checks, interpreter, traces
