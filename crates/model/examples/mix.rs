//! A triangle file of the sizes that programs send: `cargo run --release -p edgewalk-model --example mix -- [HUNDREDS [SEED]] > mix.tri`.
//! 10,000 triangles by seed 1 unless told otherwise.

#[path = "common/mix.rs"]
mod mix;

use std::io::Write;
use std::process::ExitCode;

fn main() -> ExitCode {
    let numbers: Option<Vec<u32>> = std::env::args().skip(1).map(|text| text.parse().ok()).collect();
    let (hundreds, seed) = match numbers.as_deref() {
        Some([]) => (100, 1),
        Some(&[hundreds]) => (hundreds, 1),
        Some(&[hundreds, seed]) => (hundreds, seed),
        _ => {
            eprintln!("mix [HUNDREDS [SEED]]");
            return ExitCode::from(2);
        }
    };
    let text = mix::file(&mix::triangles(hundreds as usize, seed.into()));
    match std::io::stdout().lock().write_all(text.as_bytes()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("{error}");
            ExitCode::from(2)
        }
    }
}
