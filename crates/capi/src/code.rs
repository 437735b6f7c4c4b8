//! How a call ends, and what it says of a failure.

use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char};
use std::fmt::Display;
use std::panic::{AssertUnwindSafe, catch_unwind};

/// How a call ended.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum EdgewalkCode {
    /// As asked.
    Ok = 0,
    /// NULL, a text that is not UTF-8, or an array of the wrong length.
    Argument = 1,
    /// A machine that cannot be built.
    Machine = 2,
    /// A frame that cannot be read, or that the machine cannot draw.
    Frame = 3,
    /// A port that the machine has not, or a word that the port has not.
    Port = 4,
    /// A defect of edgewalk.
    Defect = 5,
}

/// Why a call failed.
pub struct Failure(pub EdgewalkCode, pub String);

impl Failure {
    /// The failure that this error is.
    pub fn of(code: EdgewalkCode, error: impl Display) -> Failure {
        Failure(code, format!("{error:#}"))
    }
}

thread_local! {
    static MESSAGE: RefCell<CString> = RefCell::default();
}

/// Does the work of a call. An error becomes a code with a message, and so does a panic, which would be a defect.
pub fn guarded(work: impl FnOnce() -> Result<(), Failure>) -> EdgewalkCode {
    // What a panic leaves half done is an object of the caller's, which the message tells him to free.
    let Failure(code, message) = match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(())) => return EdgewalkCode::Ok,
        Ok(Err(failure)) => failure,
        Err(_) => Failure(
            EdgewalkCode::Defect,
            "a defect of edgewalk; permitted: none; free the object and report its input".to_owned(),
        ),
    };
    // A zero byte would end the text.
    let message = CString::new(message.replace('\0', " ")).unwrap_or_default();
    MESSAGE.with(|kept| *kept.borrow_mut() = message);
    code
}

/// Returns the error message of the last failed call in this thread. The message names the fault, the permitted
/// values and the remedy. The message is empty before the first failure. The pointer is valid until the next call in
/// this thread that fails.
#[unsafe(no_mangle)]
pub extern "C" fn edgewalk_message() -> *const c_char {
    MESSAGE.with(|kept| kept.borrow().as_ptr())
}

/// The version of the library, as in `0.1.0`.
#[unsafe(no_mangle)]
pub extern "C" fn edgewalk_version() -> *const c_char {
    const VERSION: &CStr =
        match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
            Ok(version) => version,
            Err(_) => c"",
        };
    VERSION.as_ptr()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn panics_become_codes() {
        assert_eq!(guarded(|| panic!("on purpose")), EdgewalkCode::Defect);
        // SAFETY: the text lasts until the next failure of this thread.
        let message = unsafe { CStr::from_ptr(edgewalk_message()) }.to_string_lossy().into_owned();
        assert!(message.starts_with("a defect of edgewalk; permitted: none; "), "{message}");
        assert_eq!(guarded(|| Ok(())), EdgewalkCode::Ok);
    }
}
