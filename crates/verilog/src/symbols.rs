//! What an operator is written as, and what its result is called.

use edgewalk_netlist::ops::Op;

/// The operator's sign; on single bits the logical one.
pub(crate) fn symbol(op: Op, width: u32) -> &'static str {
    match op {
        Op::Add => "+",
        Op::Sub | Op::Neg => "-",
        Op::Mul | Op::MulSigned => "*",
        Op::And if width == 1 => "&&",
        Op::And | Op::All => "&",
        Op::Or if width == 1 => "||",
        Op::Or | Op::Any => "|",
        Op::Xor | Op::Parity => "^",
        Op::Not if width == 1 => "!",
        Op::Not => "~",
        Op::Eq => "==",
        Op::Ne => "!=",
        Op::Lt | Op::LtSigned => "<",
        Op::Le | Op::LeSigned => "<=",
        Op::Gt | Op::GtSigned => ">",
        Op::Ge | Op::GeSigned => ">=",
        Op::Shl(_) | Op::ShlBy => "<<",
        Op::Shr(_) | Op::ShrBy => ">>",
        Op::Sar(_) | Op::SarBy => ">>>",
        Op::Mux => "?",
        Op::Slice { .. } | Op::ZeroExtend(_) | Op::SignExtend(_) | Op::Concat => "",
    }
}

/// What an operator's result is called if it has to be called something.
pub(crate) fn stem(op: Op) -> &'static str {
    match op {
        Op::Add => "sum",
        Op::Sub => "difference",
        Op::Neg => "negative",
        Op::Mul | Op::MulSigned => "product",
        Op::And => "both",
        Op::Or => "either",
        Op::Xor => "differing",
        Op::Not => "inverse",
        Op::Eq => "equal",
        Op::Ne => "unequal",
        Op::Lt | Op::LtSigned => "less",
        Op::Le | Op::LeSigned => "at_most",
        Op::Gt | Op::GtSigned => "greater",
        Op::Ge | Op::GeSigned => "at_least",
        Op::Mux => "choice",
        Op::Shl(_) | Op::Shr(_) | Op::Sar(_) | Op::ShlBy | Op::ShrBy | Op::SarBy => "shifted",
        Op::Slice { .. } => "part",
        Op::ZeroExtend(_) | Op::SignExtend(_) => "extended",
        Op::Concat => "joined",
        Op::Any => "any",
        Op::All => "every",
        Op::Parity => "parity",
    }
}
