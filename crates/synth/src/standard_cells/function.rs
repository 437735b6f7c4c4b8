//! Boolean functions of pins, as the Liberty format writes them: `!(A B)`, `(A * B)'`, `A ^ B + C`.

/// The truth table over these pins, bit 0 where all are 0, the first pin the lowest; `None` if it is no function of them.
///
/// At most six pins.
pub(super) fn table(function: &str, pins: &[&str]) -> Option<u64> {
    let states = 1_u32.checked_shl(u32::try_from(pins.len()).ok()?).filter(|states| *states <= 64)?;
    (0..states).try_fold(0, |table, state| {
        let mut reader = Reader { rest: function, pins, state, depth: 0 };
        let value = reader.either()?;
        let whole = reader.rest.trim_start().is_empty();
        whole.then_some(table | u64::from(value) << state)
    })
}

/// Parentheses lie within each other so deep at most.
const DEPTH: usize = 64;

struct Reader<'f> {
    rest: &'f str,
    pins: &'f [&'f str],
    /// Values of the pins, the first in bit 0.
    state: u32,
    depth: usize,
}

impl Reader<'_> {
    /// Takes the next character if it is one of these.
    fn taken(&mut self, marks: &[char]) -> bool {
        self.rest = self.rest.trim_start();
        let rest = self.rest.strip_prefix(marks);
        self.rest = rest.unwrap_or(self.rest);
        rest.is_some()
    }

    /// `a + b`, `a | b`: the weakest operator.
    fn either(&mut self) -> Option<bool> {
        let mut value = self.both()?;
        while self.taken(&['+', '|']) {
            value |= self.both()?;
        }
        Some(value)
    }

    /// `a * b`, `a & b`, `a b`.
    fn both(&mut self) -> Option<bool> {
        let mut value = self.differ()?;
        loop {
            let marked = self.taken(&['*', '&']);
            let goes_on = !self.rest.is_empty() && !self.rest.starts_with(['+', '|', ')']);
            if !marked && !goes_on {
                return Some(value);
            }
            value &= self.differ()?;
        }
    }

    /// `a ^ b`.
    fn differ(&mut self) -> Option<bool> {
        let mut value = self.single()?;
        while self.taken(&['^']) {
            value ^= self.single()?;
        }
        Some(value)
    }

    /// A pin, a constant, `!a`, `a'`, `(a)`.
    fn single(&mut self) -> Option<bool> {
        let mut inverted = false;
        while self.taken(&['!']) {
            inverted = !inverted;
        }
        let mut value = if self.taken(&['(']) {
            self.depth += 1;
            let value = (self.depth <= DEPTH).then(|| self.either())??;
            self.depth -= 1;
            self.taken(&[')']).then_some(value)?
        } else {
            let ends = |c: char| c.is_whitespace() || "!'()^*&+|".contains(c);
            let (name, rest) = self.rest.split_at(self.rest.find(ends).unwrap_or(self.rest.len()));
            self.rest = rest;
            match name {
                "0" => false,
                "1" => true,
                name => self.state >> self.pins.iter().position(|pin| *pin == name)? & 1 == 1,
            }
        };
        while self.taken(&['\'']) {
            value = !value;
        }
        Some(value ^ inverted)
    }
}

#[cfg(test)]
mod tests {
    use super::table;

    #[test]
    fn functions_have_their_truth_tables() {
        let two = ["A", "B"];
        for (function, expected) in [
            ("(!(A B))", 0b0111),
            ("!(A*B)", 0b0111),
            ("(A & B)'", 0b0111),
            ("!A + B'", 0b0111),
            ("A ^ B", 0b0110),
            ("A+B", 0b1110),
            ("!!A 1", 0b1010),
            ("A|B&0", 0b1010),
        ] {
            assert_eq!(table(function, &two), Some(expected), "{function}");
        }
        for wrong in ["", "C", "(A", "A)", "A +", "!", "A B C"] {
            assert_eq!(table(wrong, &two), None, "{wrong}");
        }
        assert_eq!(table(&"(".repeat(100_000), &two), None);
    }
}
