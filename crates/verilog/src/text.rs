//! An expression as text, with the parentheses and casts it needs inside another.

/// How a text may stand inside another.
#[derive(Clone, Copy, PartialEq)]
pub(crate) enum Shape {
    /// A name, a constant, braces, a call: anywhere.
    Atom,
    /// `~a`: inside a binary operator.
    Unary,
    /// `a + b`: alone, or under the same operator on its left.
    Binary(&'static str),
    /// `c ? a : b`: alone, or after the colon of another.
    Choice,
    /// `$signed(a) >>> 3`: alone; elsewhere its neighbours would turn it unsigned.
    Signed,
}

/// An expression and how it may stand inside another.
pub(crate) struct Text {
    pub text: String,
    pub shape: Shape,
}

impl Text {
    /// A text of that shape.
    pub fn new(text: String, shape: Shape) -> Self {
        Text { text, shape }
    }

    /// As an operand of the binary operator `of`.
    pub fn beside(self, of: &'static str, left: bool) -> String {
        let chain = matches!((self.shape, of), (Shape::Binary("+" | "-"), "+" | "-")) && left
            || self.shape == Shape::Binary(of) && ["&", "|", "^", "&&", "||"].contains(&of);
        match self.shape {
            Shape::Atom | Shape::Unary => self.text,
            Shape::Binary(_) if chain => self.text,
            Shape::Signed => format!("$unsigned({})", self.text),
            Shape::Binary(_) | Shape::Choice => format!("({})", self.text),
        }
    }

    /// As an operand of a unary operator.
    pub fn under(self) -> String {
        match self.shape {
            Shape::Atom => self.text,
            Shape::Signed => format!("$unsigned({})", self.text),
            _ => format!("({})", self.text),
        }
    }

    /// As one of the two values of a choice.
    pub fn chosen(self, last: bool) -> String {
        match self.shape {
            Shape::Signed => format!("$unsigned({})", self.text),
            Shape::Choice if !last => format!("({})", self.text),
            _ => self.text,
        }
    }
}
