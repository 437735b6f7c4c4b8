//! The arguments.

/// What is asked for.
pub struct Options {
    pub sample: usize,
    /// A sample by each.
    pub seeds: Vec<u64>,
    /// Says how long it will be at most, and tries nothing.
    pub estimate: bool,
    pub crates: Vec<String>,
}

/// Reads the arguments; `known`: the crates that there are, taken where none is named. An error is a message.
pub fn options(arguments: impl Iterator<Item = String>, known: &[String]) -> Result<Options, String> {
    let mut read = Options { sample: 60, seeds: Vec::new(), estimate: false, crates: Vec::new() };
    let mut arguments = arguments;
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "--sample" | "--seed" => {
                let value = arguments.next().unwrap_or_default();
                let wrong = || format!("{argument} needs a whole number, not '{value}'");
                if argument == "--sample" {
                    read.sample = value.parse().map_err(|_| wrong())?;
                } else {
                    read.seeds.push(value.parse().map_err(|_| wrong())?);
                }
            }
            "--all" => read.sample = usize::MAX,
            "--estimate" => read.estimate = true,
            option if option.starts_with('-') => {
                let permitted = "--sample N, --all, --seed N (more than once), --estimate, names of crates";
                return Err(format!("no option '{option}'; permitted: {permitted}"));
            }
            name if !known.iter().any(|known| known == name) => {
                return Err(format!("'{name}' is not in tests/mutants/crates"));
            }
            name => read.crates.push(name.to_owned()),
        }
    }
    if read.seeds.is_empty() {
        read.seeds.push(1);
    }
    if read.crates.is_empty() {
        read.crates = known.to_vec();
    }
    Ok(read)
}
