use std::path::PathBuf;
use std::process::Command;

use super::instrumented;
use crate::fault::Fault;
use crate::place::Places;

/// A fault in the text: `at` marks where its span begins, and `length` how long it is.
fn fault(
    text: &str,
    number: u32,
    genre: &str,
    at: &str,
    skipped: usize,
    length: usize,
    replacement: &str,
) -> Fault {
    let start = text.find(at).expect("the text has it") + skipped;
    Fault {
        number,
        seed: 1,
        owner: String::new(),
        file: String::new(),
        name: String::new(),
        genre: genre.to_owned(),
        span: start..start + length,
        replacement: replacement.to_owned(),
    }
}

/// Compiles the text with the switches of these faults; gives what it prints without a fault, then with each.
fn printed(test: &str, text: &str, faults: &[Fault]) -> Vec<String> {
    let places = Places::of(text).expect("it parses");
    let placed: Vec<_> =
        faults.iter().map(|fault| (fault, places.find(fault).expect("it has a place"))).collect();
    let (new, _) = instrumented(text, &placed);
    let folder: PathBuf =
        std::env::temp_dir().join(format!("edgewalk-mutants-{test}-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder");
    let (source, program) = (folder.join("main.rs"), folder.join("main"));
    let switches = concat!(env!("CARGO_MANIFEST_DIR"), "/switches.rs");
    std::fs::write(&source, format!("{new}\n#[path = {switches:?}]\nmod edgewalk_faults;\n"))
        .expect("written");
    let compiler = Command::new("rustc")
        .args(["--edition=2024", "--cap-lints=allow", "-o"])
        .arg(&program)
        .arg(&source)
        .status();
    assert!(compiler.expect("rustc").success());
    let numbers = std::iter::once(0).chain(faults.iter().map(|fault| fault.number));
    let outputs = numbers.map(|number| {
        let output =
            Command::new(&program).env("EDGEWALK_FAULT", number.to_string()).output().expect("it runs");
        String::from_utf8_lossy(&output.stdout).trim().to_owned()
    });
    let outputs = outputs.collect();
    let reached = folder.join("reached");
    let status = Command::new(&program)
        .env("EDGEWALK_FAULTS_REACHED", &reached)
        .stdout(std::process::Stdio::null())
        .status();
    assert!(status.expect("it runs").success());
    let mut numbers: Vec<u32> = std::fs::read_to_string(&reached)
        .expect("reached")
        .lines()
        .map(|line| line.parse().expect("a number"))
        .collect();
    numbers.sort_unstable();
    assert_eq!(numbers, faults.iter().map(|fault| fault.number).collect::<Vec<_>>(), "each once");
    std::fs::remove_dir_all(&folder).expect("removed");
    outputs
}

#[test]
fn results() {
    let text = "fn f() -> Option<u32> { Some(7) } fn main() { println!(\"{:?}\", f()) }";
    let faults = [
        fault(text, 1, "FnValue", "Some(7)", 0, 7, "None"),
        fault(text, 2, "FnValue", "Some(7)", 0, 7, "Some(0)"),
    ];
    assert_eq!(printed("results", text, &faults), ["Some(7)", "None", "Some(0)"]);
}

#[test]
fn operators_within_operators() {
    let text = "fn main() { let (ä, b, c) = (20, 6, 3); println!(\"{}\", 0 + f(ä, b, c)) } \
                fn f(ä: i32, b: i32, c: i32) -> i32 { let mut d = 1; d += ä - b / c; d }";
    let faults = [
        fault(text, 1, "BinaryOperator", "+= ä", 0, 2, "-="),
        fault(text, 2, "BinaryOperator", "- b", 0, 1, "+"),
        fault(text, 3, "BinaryOperator", "/ c", 0, 1, "*"),
        fault(text, 4, "BinaryOperator", "/ c", 0, 1, "%"),
    ];
    assert_eq!(printed("operators", text, &faults), ["19", "-17", "23", "3", "21"]);
}

#[test]
fn an_operator_that_binds_less_regroups_as_in_the_text() {
    let text = "fn main() { let (a, b, c) = (20, 6, 3); println!(\"{} {}\", a - b * c, b == 7 && a == 2 || c == 3) }";
    let text = &text.replace("println!", "print").replace("\"{} {}\", ", "");
    let text = &format!("fn print(one: i32, two: bool) {{ println!(\"{{one}} {{two}}\") }} {text}");
    let faults = [
        fault(text, 1, "BinaryOperator", "* c", 0, 1, "+"),
        fault(text, 2, "BinaryOperator", "&& a", 0, 2, "||"),
        fault(text, 3, "BinaryOperator", "|| c", 0, 2, "&&"),
    ];
    assert_eq!(printed("regrouped", text, &faults), ["2 true", "17 true", "2 true", "2 false"]);
}

#[test]
fn signs() {
    let text =
        "fn f(a: i32, b: bool) -> (i32, bool) { (-a * 2, !b) } fn main() { println!(\"{:?}\", f(3, true)) }";
    let faults =
        [fault(text, 1, "UnaryOperator", "-a", 0, 1, ""), fault(text, 2, "UnaryOperator", "!b", 0, 1, "")];
    assert_eq!(printed("signs", text, &faults), ["(-6, false)", "(6, false)", "(-6, true)"]);
}

#[test]
fn branches() {
    let text = "fn f(a: Option<u32>) -> u32 { match a { Some(a) if a > 3 => 1, Some(_) => 2, _ => 3 } } \
                fn main() { println!(\"{} {} {}\", f(Some(9)), f(Some(1)), f(None)) }";
    let faults = [
        fault(text, 1, "MatchArmGuard", "a > 3", 0, 5, "true"),
        fault(text, 2, "MatchArmGuard", "a > 3", 0, 5, "false"),
        fault(text, 3, "BinaryOperator", "> 3", 0, 1, "<"),
        fault(text, 4, "MatchArm", "Some(_) => 2,", 0, 13, ""),
    ];
    assert_eq!(printed("branches", text, &faults), ["1 2 3", "1 1 3", "2 2 3", "2 1 3", "1 3 3"]);
}

#[test]
fn members() {
    let text = "#[derive(Default, Debug)] struct S { a: u32, b: u32 } \
                fn f() -> S { S { a: 1, ..Default::default() } } fn main() { println!(\"{:?}\", f()) }";
    let faults = [fault(text, 1, "StructField", "a: 1,", 0, 5, "")];
    assert_eq!(printed("members", text, &faults), ["S { a: 1, b: 0 }", "S { a: 0, b: 0 }"]);
}

#[test]
fn a_condition_with_let_is_set_aside() {
    let text = "fn f(a: Option<u32>, b: u32) -> bool { if let Some(a) = a && a < b { true } else { false } }";
    let places = Places::of(text).expect("it parses");
    assert!(places.find(&fault(text, 1, "BinaryOperator", "&& a", 0, 2, "||")).is_err());
    assert!(places.find(&fault(text, 2, "BinaryOperator", "< b", 0, 1, ">")).is_ok());
}

#[test]
fn what_was_written_is_known_by_its_fault() {
    let text = "fn f(a: u32, b: u32) -> u32 { a + b * 2 }";
    let faults = [
        fault(text, 1, "FnValue", "a + b", 0, 9, "0"),
        fault(text, 2, "BinaryOperator", "+ b", 0, 1, "-"),
        fault(text, 3, "BinaryOperator", "* 2", 0, 1, "/"),
    ];
    let places = Places::of(text).expect("it parses");
    let placed: Vec<_> =
        faults.iter().map(|fault| (fault, places.find(fault).expect("it has a place"))).collect();
    let (new, written) = instrumented(text, &placed);
    let holds = |number: u32, part: &str| {
        let start = new.find(part).expect("written");
        let parts = written.iter().filter(|part| part.range.contains(&start));
        assert_eq!(parts.min_by_key(|part| part.range.len()).expect("known").faults, [number], "{part}");
    };
    holds(1, "return 0");
    holds(2, "a -  b * 2");
    holds(3, "b /  2");
}
