//! A checked machine.

use crate::code::{EdgewalkCode, Failure, guarded};
use crate::pointer::{free, give, shared, text};
use edgewalk_machine::presets::PRESETS;
use edgewalk_machine::{Machine, Plan, Unknown};
use std::ffi::c_char;

/// A checked machine. It never changes.
pub struct EdgewalkMachine(pub Plan);

/// The machine of this preset, as `default` or `small`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn edgewalk_machine_preset(
    name: *const c_char,
    machine: *mut *mut EdgewalkMachine,
) -> EdgewalkCode {
    guarded(|| {
        // SAFETY: the caller's *text*.
        let name = unsafe { text("name", name) }?;
        let plan = Plan::preset(name).ok_or_else(|| {
            let names = PRESETS.iter().map(|(name, _)| *name);
            Failure::of(EdgewalkCode::Machine, Unknown::new("preset", name, names))
        })?;
        // SAFETY: the caller's *object*, to be written.
        unsafe { give("machine", machine, EdgewalkMachine(plan)) }
    })
}

/// The machine of a machine file's text. Keys that are left out have the values of the preset `default`, or of the one
/// that the text names: `preset = "small"`.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn edgewalk_machine_toml(
    toml: *const c_char,
    machine: *mut *mut EdgewalkMachine,
) -> EdgewalkCode {
    guarded(|| {
        // SAFETY: the caller's *text*.
        let toml = unsafe { text("toml", toml) }?;
        let plan = Machine::from_toml(toml).and_then(|machine| machine.plan());
        let plan = plan.map_err(|error| Failure::of(EdgewalkCode::Machine, error))?;
        // SAFETY: the caller's *object*, to be written.
        unsafe { give("machine", machine, EdgewalkMachine(plan)) }
    })
}

/// Columns of the screen; 0 of NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn edgewalk_machine_width(machine: *const EdgewalkMachine) -> u32 {
    // SAFETY: the caller's *object*.
    unsafe { shared("machine", machine) }.map_or(0, |machine| machine.0.width)
}

/// Lines of the screen; 0 of NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn edgewalk_machine_height(machine: *const EdgewalkMachine) -> u32 {
    // SAFETY: the caller's *object*.
    unsafe { shared("machine", machine) }.map_or(0, |machine| machine.0.height)
}

/// Frees a machine; NULL is permitted. Frames of the machine are not touched.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn edgewalk_machine_free(machine: *mut EdgewalkMachine) {
    // SAFETY: the caller's *object*, which he uses no more.
    unsafe { free(machine) }
}
