//! Numbers of the command line: what an option permits, and the error that says so.

use std::ops::{Bound, RangeBounds, RangeInclusive};

/// A reader of whole numbers in `range`; where the range is open it goes to the end of `T`.
pub fn whole<T>(range: impl RangeBounds<u64>) -> impl Fn(&str) -> Result<T, String> + Clone
where
    T: TryFrom<u64>,
{
    let range = closed(range, largest::<T>());
    move |text| {
        let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
        if digits.is_empty() || !digits.bytes().all(|byte| byte.is_ascii_digit()) {
            return Err(format!("permitted: whole numbers in {}", shown(&range)));
        }
        let number = text.parse().ok().filter(|number| range.contains(number));
        let number = number.and_then(|number| T::try_from(number).ok());
        number.ok_or_else(|| format!("{text} is not in {}", shown(&range)))
    }
}

/// A reader of finite numbers in `range`, of this unit.
pub fn real(range: RangeInclusive<f64>, unit: &'static str) -> impl Fn(&str) -> Result<f64, String> + Clone {
    move |text| {
        let number = text.parse().ok().filter(|number: &f64| number.is_finite() && range.contains(number));
        number.ok_or_else(|| {
            let permitted = match [range.start(), range.end()].map(|end| end.is_finite()) {
                [true, true] => format!("{} to {} {unit}", range.start(), range.end()),
                [true, false] => format!("{} or more, {unit}", range.start()),
                _ => format!("numbers, {unit}"),
            };
            format!("permitted: {permitted}")
        })
    }
}

/// The largest value of a type that holds whole numbers from 0 on.
fn largest<T: TryFrom<u64>>() -> u64 {
    let widths = [u8::MAX.into(), u16::MAX.into(), u32::MAX.into(), u64::MAX];
    widths.into_iter().rev().find(|most| T::try_from(*most).is_ok()).unwrap_or(0)
}

/// Both ends of a range.
fn closed(range: impl RangeBounds<u64>, most: u64) -> RangeInclusive<u64> {
    let start = match range.start_bound() {
        Bound::Included(start) => *start,
        Bound::Excluded(start) => start.saturating_add(1),
        Bound::Unbounded => 0,
    };
    let end = match range.end_bound() {
        Bound::Included(end) => *end,
        Bound::Excluded(end) => end.saturating_sub(1),
        Bound::Unbounded => most,
    };
    start..=end
}

/// The range, as clap writes ranges.
fn shown(range: &RangeInclusive<u64>) -> String {
    match *range.end() {
        u64::MAX => format!("{}..", range.start()),
        end => format!("{}..={end}", range.start()),
    }
}

#[cfg(test)]
mod tests {
    use crate::Cli;
    use clap::builder::ValueParser;
    use clap::error::ErrorKind;
    use clap::{Arg, Command, CommandFactory as _};
    use std::str::FromStr;

    /// Words of Rust's own errors. They do not say which numbers are permitted.
    const RAW: [&str; 5] =
        ["invalid digit", "invalid float", "too large to fit", "too small to fit", "empty string"];

    /// A parser of `T`, for its type alone.
    fn parser<T: FromStr + Clone + Send + Sync + 'static>() -> ValueParser {
        ValueParser::new(|text: &str| text.parse::<T>().map_err(|_| "no number"))
    }

    fn is_number(arg: &Arg) -> bool {
        let kind = arg.get_value_parser().type_id();
        let whole = [parser::<u8>(), parser::<u16>(), parser::<u32>(), parser::<u64>(), parser::<usize>()];
        let others = [parser::<i32>(), parser::<i64>(), parser::<f64>()];
        whole.iter().chain(&others).any(|parser| parser.type_id() == kind)
    }

    /// The error for this value of the option, or of the argument at its place, if the value is refused.
    fn refused(path: &[String], command: &Command, arg: &Arg, value: &str) -> Option<clap::Error> {
        let mut words = path.to_vec();
        match arg.get_long() {
            Some(long) => words.push(format!("--{long}")),
            None => {
                let before = command.get_positionals().take_while(|other| other.get_id() != arg.get_id());
                words.extend(before.map(|_| "0".to_owned()));
            }
        }
        let values = arg.get_num_args().map_or(1, |range| range.min_values());
        words.extend(std::iter::repeat_n(value.to_owned(), values));
        let parsed = crate::with_numbers(Cli::command()).try_get_matches_from(words);
        parsed.err().filter(|error| error.kind() == ErrorKind::ValueValidation)
    }

    #[test]
    #[allow(clippy::print_stdout)] // a test says how much it checked
    fn refused_numbers_are_told_what_is_permitted() {
        let mut root = Cli::command();
        root.build();
        let mut waiting = vec![(vec!["edgewalk".to_owned()], root)];
        let (mut options, mut errors) = (0, 0);
        while let Some((path, command)) = waiting.pop() {
            for sub in command.get_subcommands().filter(|sub| sub.get_name() != "help") {
                waiting.push(([&path[..], &[sub.get_name().to_owned()]].concat(), sub.clone()));
            }
            for arg in command.get_arguments().filter(|arg| is_number(arg)) {
                options += 1;
                for value in ["x", "", "-1", "1.5", "nan", "1e400", "99999999999999999999", "4294967296"] {
                    let place = format!("{} {} {value:?}", path.join(" "), arg.get_id());
                    let error = refused(&path, &command, arg, value);
                    assert!(error.is_some() || value != "x", "{place}: taken");
                    let Some(text) = error.map(|error| error.to_string()) else { continue };
                    errors += 1;
                    assert!(!RAW.iter().any(|raw| text.contains(raw)), "{place}: {text}");
                    assert!(text.contains("permitted: ") || text.contains(" is not in "), "{place}: {text}");
                }
            }
        }
        println!("checked {errors} errors of {options} numeric options");
        assert!(options > 30 && errors > 4 * options, "{options} {errors}");
    }
}
