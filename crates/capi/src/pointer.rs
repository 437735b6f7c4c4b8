//! Pointers from C as references: each is NULL or keeps the promises of the header's head.

use crate::code::{EdgewalkCode, Failure};
use std::ffi::{CStr, c_char};

fn null(name: &str) -> Failure {
    Failure(EdgewalkCode::Argument, format!("{name}: NULL; permitted: a pointer"))
}

/// What a pointer points to.
///
/// # Safety
/// The pointer is NULL, or points to a valid object for as long as the call lasts, and nothing changes it meanwhile.
pub unsafe fn shared<'a, T>(name: &str, pointer: *const T) -> Result<&'a T, Failure> {
    // SAFETY: as asked for above.
    unsafe { pointer.as_ref() }.ok_or_else(|| null(name))
}

/// What a pointer points to, to be changed.
///
/// # Safety
/// The pointer is NULL, or points to a valid object for as long as the call lasts, and nothing else reads or changes it
/// meanwhile.
pub unsafe fn exclusive<'a, T>(name: &str, pointer: *mut T) -> Result<&'a mut T, Failure> {
    // SAFETY: as asked for above.
    unsafe { pointer.as_mut() }.ok_or_else(|| null(name))
}

/// A text.
///
/// # Safety
/// The pointer is NULL, or points to bytes that a zero ends and that nothing changes for as long as the call lasts.
pub unsafe fn text<'a>(name: &str, pointer: *const c_char) -> Result<&'a str, Failure> {
    if pointer.is_null() {
        return Err(null(name));
    }
    // SAFETY: it is not NULL; the rest as asked for above.
    let text = unsafe { CStr::from_ptr(pointer) }.to_str();
    text.map_err(|error| Failure(EdgewalkCode::Argument, format!("{name}: {error}; permitted: UTF-8")))
}

/// Gives a new object to the caller.
///
/// # Safety
/// `to` is NULL, or a pointer can be written there.
pub unsafe fn give<T>(name: &str, to: *mut *mut T, object: T) -> Result<(), Failure> {
    if to.is_null() {
        return Err(null(name));
    }
    // SAFETY: it is not NULL; the rest as asked for above. What stood there is not read: it may be anything.
    unsafe { to.write(Box::into_raw(Box::new(object))) };
    Ok(())
}

/// Takes back an object that [`give`] gave.
///
/// # Safety
/// The pointer is NULL, or came from [`give`] and was not taken back; nothing uses it from now on.
pub unsafe fn free<T>(object: *mut T) {
    if !object.is_null() {
        // SAFETY: `give` made it of a box, and it is the caller's only once, as asked for above.
        drop(unsafe { Box::from_raw(object) });
    }
}
