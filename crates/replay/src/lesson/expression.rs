//! Formulae of the lesson as text, evaluated exactly: rationals of 128-bit integers.
//!
//! ```text
//!  choice = test ? choice : choice      test = sum [< <= > >= = sum]      sum = term {+ - term}
//!  term = power {* / power}             power = [-] atom [^ power]        atom = number | name | name(choice, ..) | (choice)
//! ```
//! Functions: floor, ceil, RN (floor of x + 1/2), mod, min, max, clamp, abs. A test is 1 or 0.

use std::collections::BTreeMap;

/// Names with their values.
pub type Values = BTreeMap<String, i128>;

/// A rational, its denominator positive.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
struct Number {
    n: i128,
    d: i128,
}

impl Number {
    const fn whole(n: i128) -> Number {
        Number { n, d: 1 }
    }

    fn new(n: i128, d: i128) -> Result<Number, String> {
        if d == 0 {
            return Err("division by 0".to_owned());
        }
        let common = common_divisor(n.unsigned_abs(), d.unsigned_abs()) as i128 * d.signum();
        Ok(Number { n: n / common, d: d / common })
    }

    fn floor(self) -> Number {
        Number::whole(self.n.div_euclid(self.d))
    }
}

fn common_divisor(a: u128, b: u128) -> u128 {
    if b == 0 { a.max(1) } else { common_divisor(b, a % b) }
}

/// The value of a formula, which is a whole number.
///
/// # Errors
/// What is wrong with the formula, in words.
pub fn evaluate(text: &str, values: &Values) -> Result<i128, String> {
    let mut reader = Reader { words: words(text), place: 0, values };
    let value = reader.choice()?;
    match reader.next() {
        Some(word) => Err(format!("`{text}`: {word} is too much")),
        None if value.d != 1 => Err(format!("`{text}`: {}/{} is not whole", value.n, value.d)),
        None => Ok(value.n),
    }
}

/// The formula with the values of its names in their places.
#[must_use]
pub fn with_numbers(text: &str, values: &Values) -> String {
    let words = words(text);
    let number = |place: usize| {
        let called = words.get(place + 1).is_some_and(|next| next == "(");
        let value = values.get(&words[place]).filter(|_| !called)?;
        Some(if *value < 0 { format!("({value})") } else { value.to_string() })
    };
    let shown: Vec<String> =
        (0..words.len()).map(|place| number(place).unwrap_or(words[place].clone())).collect();
    typeset(&shown)
}

/// The formula as it is printed.
#[must_use]
pub fn printed(text: &str) -> String {
    typeset(&words(text))
}

fn typeset(words: &[String]) -> String {
    let mut text = String::new();
    let mut before = "(";
    for word in words {
        let sign = word == "-" && ["(", ",", "?", ":", "=", "<", ">", "*", "/", "+", "-"].contains(&before);
        let tight =
            matches!(word.as_str(), ")" | "," | "^") || matches!(before, "(" | "^") || before == "sign";
        let called = word == "(" && before.starts_with(char::is_alphabetic);
        if !tight && !called && !text.is_empty() {
            text.push(' ');
        }
        text += match word.as_str() {
            "-" => "−",
            "*" => "·",
            "<=" => "≤",
            ">=" => "≥",
            other => other,
        };
        before = if sign { "sign" } else { word };
    }
    text.replace('-', "−")
}

/// Numbers, names and signs.
fn words(text: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut joined = false;
    for c in text.chars() {
        let part = c.is_alphanumeric() || c == '_';
        let pair = c == '=' && words.last().is_some_and(|last| ["<", ">"].contains(&last.as_str()));
        if c.is_whitespace() {
            joined = false;
        } else if part && joined {
            words.last_mut().expect("joined to it").push(c);
        } else if pair {
            words.last_mut().expect("it was looked at").push(c);
        } else {
            words.push(c.to_string());
            joined = part;
        }
    }
    words
}

struct Reader<'a> {
    words: Vec<String>,
    place: usize,
    values: &'a Values,
}

impl Reader<'_> {
    fn next(&mut self) -> Option<String> {
        let word = self.words.get(self.place).cloned();
        self.place += 1;
        word
    }

    fn take(&mut self, wanted: &[&str]) -> Option<String> {
        let found = self.words.get(self.place).filter(|word| wanted.contains(&word.as_str())).cloned();
        self.place += usize::from(found.is_some());
        found
    }

    fn expect(&mut self, wanted: &str) -> Result<(), String> {
        self.take(&[wanted])
            .map(|_| ())
            .ok_or_else(|| format!("`{}`: {wanted} is missing", self.words.join(" ")))
    }

    fn choice(&mut self) -> Result<Number, String> {
        let test = self.test()?;
        if self.take(&["?"]).is_none() {
            return Ok(test);
        }
        // What is not chosen may divide by 0.
        let yes = self.choice();
        self.expect(":")?;
        let no = self.choice();
        if test.n != 0 { yes } else { no }
    }

    fn test(&mut self) -> Result<Number, String> {
        let a = self.sum()?;
        let Some(sign) = self.take(&["<", "<=", ">", ">=", "="]) else { return Ok(a) };
        let b = self.sum()?;
        let order = (a.n * b.d).cmp(&(b.n * a.d));
        let holds = match sign.as_str() {
            "<" => order.is_lt(),
            "<=" => order.is_le(),
            ">" => order.is_gt(),
            ">=" => order.is_ge(),
            _ => order.is_eq(),
        };
        Ok(Number::whole(holds.into()))
    }

    fn sum(&mut self) -> Result<Number, String> {
        let mut all = self.term()?;
        while let Some(sign) = self.take(&["+", "-"]) {
            let next = self.term()?;
            let n = if sign == "+" { next.n } else { -next.n };
            all = Number::new(all.n * next.d + n * all.d, all.d * next.d)?;
        }
        Ok(all)
    }

    fn term(&mut self) -> Result<Number, String> {
        let mut all = self.power()?;
        while let Some(sign) = self.take(&["*", "/"]) {
            let next = self.power();
            // An error in what is not chosen stays there.
            let next = next?;
            all = if sign == "*" {
                Number::new(all.n * next.n, all.d * next.d)?
            } else {
                Number::new(all.n * next.d, all.d * next.n)?
            };
        }
        Ok(all)
    }

    fn power(&mut self) -> Result<Number, String> {
        if self.take(&["-"]).is_some() {
            let value = self.power()?;
            return Ok(Number { n: -value.n, ..value });
        }
        let base = self.atom()?;
        if self.take(&["^"]).is_none() {
            return Ok(base);
        }
        let exponent = self.power()?;
        let exponent = u32::try_from(exponent.n).map_err(|_| "an exponent below 0".to_owned())?;
        Ok(Number { n: base.n.pow(exponent), d: base.d.pow(exponent) })
    }

    fn atom(&mut self) -> Result<Number, String> {
        let word = self.next().ok_or("the formula ends early")?;
        if word == "(" {
            let value = self.choice()?;
            self.expect(")")?;
            return Ok(value);
        }
        if let Ok(number) = word.parse() {
            return Ok(Number::whole(number));
        }
        if self.take(&["("]).is_some() {
            let mut arguments = vec![self.choice()?];
            while self.take(&[","]).is_some() {
                arguments.push(self.choice()?);
            }
            self.expect(")")?;
            return call(&word, &arguments);
        }
        self.values
            .get(&word)
            .map(|value| Number::whole(*value))
            .ok_or_else(|| format!("{word} has no value"))
    }
}

fn call(name: &str, arguments: &[Number]) -> Result<Number, String> {
    let less = |a: &Number, b: &Number| a.n * b.d < b.n * a.d;
    Ok(match (name, arguments) {
        ("floor", [x]) => x.floor(),
        ("ceil", [x]) => {
            let below = Number { n: -x.n, ..*x }.floor();
            Number::whole(-below.n)
        }
        ("RN", [x]) => Number::new(2 * x.n + x.d, 2 * x.d)?.floor(),
        ("abs", [x]) => Number { n: x.n.abs(), ..*x },
        ("mod", [a, m]) if a.d == 1 && m.d == 1 && m.n > 0 => Number::whole(a.n.rem_euclid(m.n)),
        ("min", [a, b]) => *if less(b, a) { b } else { a },
        ("max", [a, b]) => *if less(a, b) { b } else { a },
        ("clamp", [x, a, b]) => {
            *if less(x, a) {
                a
            } else if less(b, x) {
                b
            } else {
                x
            }
        }
        _ => return Err(format!("there is no function {name} of {} numbers", arguments.len())),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(text: &str) -> Result<i128, String> {
        evaluate(text, &Values::from([("a".to_owned(), 7), ("b".to_owned(), -3)]))
    }

    #[test]
    fn values_by_hand() {
        for (text, value) in [
            ("1 + 2 * 3 - 4", 3),
            ("a - b - 2^(2 + 1)", 2),
            ("-b * -a", -21),
            ("floor(b / 2)", -2),
            ("ceil(b / 2)", -1),
            ("RN(5 / 2) * 10 + RN(-5 / 2)", 28),
            ("mod(b, a)", 4),
            ("a / 2 * 2", 7),
            ("a < b ? 1 : a >= 7 ? 2 : 3", 2),
            ("0 = 1 ? a / 0 : 5", 5),
            ("clamp(a, 0, 5) + clamp(b, 0, 5) + max(a, b) * min(a, b)", -16),
            ("a / 2 < 4 ? 1 : 2", 1),
            ("4 < a / 2 ? 1 : 2", 2),
            ("min(a / 2, 4) * 2", 7),
            ("max(a / 2, 4)", 4),
            ("a / 2 / (1 / 4) * (b / 3)", -14),
            ("1 / 2 / 3 * 6 + 1 / 4 - 5 / 4", 0),
            ("(a / 2)^2 * 4", 49),
        ] {
            assert_eq!(of(text), Ok(value), "{text}");
        }
    }

    #[test]
    fn what_cannot_be_evaluated_says_why() {
        for (text, why) in [
            ("a / 2", "7/2 is not whole"),
            ("a + c", "c has no value"),
            ("a / 0", "division by 0"),
            ("a b", "b is too much"),
            ("(a", ") is missing"),
            ("root(a)", "no function root"),
            ("a +", "ends early"),
            ("2^b", "exponent below 0"),
            ("mod(a / 2, 2)", "no function mod"),
            ("mod(a, 3 / 2)", "no function mod"),
            ("mod(a, b)", "no function mod"),
        ] {
            assert!(of(text).as_ref().is_err_and(|error| error.contains(why)), "{text}: {:?}", of(text));
        }
    }

    #[test]
    fn numbers_stand_for_names() {
        let values = Values::from([("u0".to_owned(), 704), ("v".to_owned(), -2)]);
        assert_eq!(
            with_numbers("-u0 * v + floor(u0/(3 - v))", &values),
            "−704 · (−2) + floor(704 / (3 − (−2)))"
        );
        assert_eq!(printed("a<=b?2^(t-1):c"), "a ≤ b ? 2^(t − 1) : c");
    }
}
