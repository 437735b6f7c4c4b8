//! What can be wrong with a module. The builder never panics: it collects these until `finish`.

use std::fmt;
use std::panic::Location;

/// One fault of a module.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{place}: module `{module}`: {fault}")]
pub struct BuildError {
    /// The module's name.
    pub module: String,
    /// The line of the program that built the faulty thing.
    pub place: Place,
    /// What is wrong.
    pub fault: Fault,
}

/// A line of the program that built a module.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place(pub &'static Location<'static>);

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:{}", self.0.file(), self.0.line())
    }
}

/// What is wrong. Signals are given by name, or as the expression they are.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum Fault {
    /// An operator whose operands do not fit together.
    #[error("`{expression}`: {reason}")]
    Operands {
        /// The operator applied to its operands.
        expression: String,
        /// Such as "8 bits against 9".
        reason: String,
    },
    /// A signal that does not have the width of what it drives.
    #[error("`{target}` has {wanted} bits, but `{signal}` has {found}")]
    Width {
        /// The register, port or wire driven.
        target: String,
        /// Width that is wanted.
        wanted: u32,
        /// What should drive it.
        signal: String,
        /// Width that was found.
        found: u32,
    },
    /// A declared width outside 1..=128.
    #[error("`{name}` has {width} bits, outside 1..=128")]
    BadWidth {
        /// What was declared.
        name: String,
        /// The width given.
        width: u32,
    },
    /// A number that does not fit its width.
    #[error("{value} does not fit in {width} bits")]
    Literal {
        /// The number, in decimal.
        value: String,
        /// The width it was wanted in.
        width: u32,
    },
    /// A number where the width can not be known.
    #[error("a number without a width: one side must be a signal")]
    UnknownWidth,
    /// A signal of another module.
    #[error("`{signal}` belongs to another module")]
    Foreign {
        /// Name of the signal in the other module.
        signal: String,
    },
    /// Not a Verilog identifier, or a word of the language.
    #[error("`{name}` is no legal Verilog name")]
    IllegalName {
        /// The name given.
        name: String,
    },
    /// A name given twice.
    #[error("`{name}` is there twice")]
    DuplicateName {
        /// The name given.
        name: String,
    },
    /// Two different modules of one name in one hierarchy.
    #[error("there are two different modules `{name}` in it")]
    DuplicateModule {
        /// Name of both modules.
        name: String,
    },
    /// A register that is never updated, a wire or an instance's input that nothing drives.
    #[error("nothing drives `{name}`")]
    Undriven {
        /// Name of the signal, `instance.port` for an instance's input.
        name: String,
    },
    /// A wire or an instance's input with two drivers.
    #[error("`{name}` is driven twice")]
    DrivenTwice {
        /// Name of the signal, `instance.port` for an instance's input.
        name: String,
    },
    /// An instance has no such port.
    #[error("module `{of}` has no {direction} `{port}`; it has {known}")]
    NoPort {
        /// The instance's module.
        of: String,
        /// "input" or "output".
        direction: &'static str,
        /// The name given.
        port: String,
        /// The names there are.
        known: String,
    },
    /// A memory whose address is not just wide enough for its words, or that has fewer than two.
    #[error("memory `{name}`: {words} words with an address of {addr_bits} bits")]
    MemorySize {
        /// Name of the memory.
        name: String,
        /// Words.
        words: usize,
        /// Address bits.
        addr_bits: u32,
    },
    /// Contents beyond a memory's last word.
    #[error("memory `{name}` has {words} words: there is no word {address} to hold anything")]
    NoWord {
        /// Name of the memory.
        name: String,
        /// Words.
        words: usize,
        /// The address given.
        address: usize,
    },
    /// A word that was given contents twice.
    #[error("word {address} of memory `{name}` is given contents twice")]
    WordTwice {
        /// The memory's name.
        name: String,
        /// The word's address.
        address: usize,
    },
    /// A memory without a write port that has words without contents.
    #[error(
        "nothing writes memory `{name}`, but word {word} has no contents: every word of a ROM needs them"
    )]
    UnknownWord {
        /// Name of the memory.
        name: String,
        /// The first word without contents.
        word: usize,
    },
    /// A signal that depends on itself without a register between.
    #[error("combinational loop: {}", path.join(" -> "))]
    Loop {
        /// The names around it, the first again at the end; `instance.port` where it passes through an instance.
        path: Vec<String>,
    },
}

/// All faults of a module, in the order they were found; never empty.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{}", list(.0))]
pub struct BuildErrors(pub Vec<BuildError>);

fn list(errors: &[BuildError]) -> String {
    errors.iter().map(BuildError::to_string).collect::<Vec<_>>().join("\n")
}
