//! What can go wrong before the first clock.

/// A netlist that cannot become native code here.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum JitError {
    /// There is no code generator for this machine.
    #[error("no native code for this machine: {0}")]
    Host(String),
    /// Registers and memories need more than 2 GiB.
    #[error("the netlist's registers and memories do not fit in 2 GiB")]
    TooLarge,
    /// Cranelift refused; a defect of this crate.
    #[error("code generation failed: {0}")]
    Cranelift(String),
}
