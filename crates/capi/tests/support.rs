//! The library that was built with these tests, and programs that use it.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// The crate's folder, in which `edgewalk.h` is.
pub const CRATE: &str = env!("CARGO_MANIFEST_DIR");

/// The folder of `libedgewalk_c.so`: Cargo puts it beside the test program.
pub fn library() -> PathBuf {
    let program = std::env::current_exe().expect("a program has a path");
    let folder = program.parent().expect("a file is in a folder").to_owned();
    let name = format!("{}edgewalk_c{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    assert!(folder.join(&name).exists(), "{name} is not in {}", folder.display());
    folder
}

/// Exit code, and all that is printed.
pub fn ran(command: &mut Command) -> (Option<i32>, String) {
    let Output { status, stdout, stderr } = command.output().unwrap_or_else(|e| panic!("{command:?}: {e}"));
    (status.code(), [&stdout[..], &stderr].map(String::from_utf8_lossy).concat())
}

/// The folder of the repository.
pub fn root() -> PathBuf {
    Path::new(CRATE).join("../..")
}

/// The command of the page that begins with this word, for the shell, with the library of these tests.
pub fn command(word: &str) -> String {
    let page = include_str!("../../../docs/c.md").replace("\\\n", " ");
    let line =
        page.lines().find(|line| line.starts_with(&format!("{word} "))).expect("the page has the command");
    let library = library().display().to_string();
    line.replace("$PWD/", "").replace("target/release", &library)
}

/// Runs a command in the repository's folder, and asks for exit code 0.
pub fn must(shell: &str) {
    let (code, said) = ran(Command::new("sh").args(["-c", shell]).current_dir(root()));
    assert_eq!(code, Some(0), "{shell}\n{said}");
}

/// Compiles a C program as the page says, without a warning, and runs it.
pub fn c(folder: &Path, source: &str) -> (Option<i32>, String) {
    let program = folder.join("triangle").display().to_string();
    let compile =
        command("cc").replace("docs/c/triangle.c", source).replace("-o triangle", &format!("-o {program}"));
    must(&format!("{compile} -std=c11 -Wall -Wextra -Wpedantic -Werror"));
    ran(&mut Command::new(&program))
}
