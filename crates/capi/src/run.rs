//! A frame clock by clock, with every port of the machine.

use crate::code::{EdgewalkCode, Failure, guarded};
use crate::frame::EdgewalkFrame;
use crate::pointer::{exclusive, free, give, shared, text};
use anyhow::{Result, anyhow};
use edgewalk_lockstep::{Interface, ModelDevice, PortId, PortValues, Rig, Setting, Triangles, Unit, model};
use edgewalk_machine::{Plan, Unknown};
use std::ffi::c_char;

/// A machine that draws a frame clock by clock, with its memories. They never make it wait.
pub struct EdgewalkRun {
    interface: Interface,
    device: Box<dyn ModelDevice>,
    rig: Rig,
    ports: PortValues,
    idle: PortId,
    done: bool,
}

impl EdgewalkRun {
    fn new(frame: &EdgewalkFrame) -> Result<EdgewalkRun, Failure> {
        let (plan, port) = (&frame.plan, frame.at_port()?);
        let run = || -> Result<EdgewalkRun> {
            if port.shade.is_some() {
                return Err(anyhow!(
                    "the frame is shaded at each pixel; permitted: other frames; edgewalk_draw draws it"
                ));
            }
            let interface = Interface::new(plan, Unit::MACHINE);
            let triangles = Triangles::new(plan);
            let tokens = port.triangles.iter().zip(0..).map(|(triangle, tag)| triangles.pack(triangle, tag));
            let state = port.state()?;
            let mut setting =
                Setting { tokens: tokens.collect(), ..Setting::willing(&interface, &state.constants())? };
            let color = interface.memories.iter().position(|memory| memory.name == "color");
            if let Some(place) = color {
                setting.memories[place].clear = color_word(plan, state.clear);
            }
            Ok(EdgewalkRun {
                device: model(plan, &interface)?,
                rig: Rig::new(&interface, setting),
                ports: interface.values(),
                idle: interface.port("idle").ok_or_else(|| anyhow!("the machine has no port idle"))?.id,
                interface,
                done: false,
            })
        };
        run().map_err(|error| Failure::of(EdgewalkCode::Frame, error))
    }

    fn tick(&mut self) {
        // In the clock in which it takes the last triangle the machine is still idle.
        let exhausted = self.rig.exhausted();
        self.rig.drive(&mut self.ports);
        self.device.cycle(&mut self.ports);
        self.rig.clock(&self.ports);
        self.done = exhausted && self.ports.is_high(self.idle);
    }

    fn port(&self, name: &str, word: u32) -> Result<u64, Failure> {
        let port = self.interface.port(name).ok_or_else(|| {
            let ports = self.interface.inputs().iter().chain(self.interface.outputs());
            Failure::of(EdgewalkCode::Port, Unknown::new("port", name, ports.map(|port| port.name.as_str())))
        })?;
        let words = port.width().div_ceil(u64::BITS);
        if word >= words {
            let found =
                format!("word: {word}; permitted: 0 to {}, as {name} has {} bits", words - 1, port.width());
            return Err(Failure(EdgewalkCode::Port, found));
        }
        Ok((self.ports[port.id] >> (u64::BITS * word)) as u64) // the low half of what is left
    }
}

/// The word of the colour memory: red is the most significant.
fn color_word(plan: &Plan, [r, g, b]: [u64; 3]) -> u128 {
    [r, g, b].into_iter().fold(0, |word, color| word << plan.color.bits | u128::from(color))
}

/// A run of the frame as it is now, before its first clock. The frame has one state (docs/triangle_file.md), no light's
/// map and no shading at each pixel.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn edgewalk_run_new(
    frame: *const EdgewalkFrame,
    run: *mut *mut EdgewalkRun,
) -> EdgewalkCode {
    guarded(|| {
        // SAFETY: the caller's *object*.
        let made = EdgewalkRun::new(unsafe { shared("frame", frame) }?)?;
        // SAFETY: the caller's *object*, to be written.
        unsafe { give("run", run, made) }
    })
}

/// One clock. Afterwards `edgewalk_run_port` gives the values of the clock, as they stood before its rising edge. The
/// first clock is the first without reset.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn edgewalk_run_tick(run: *mut EdgewalkRun) -> EdgewalkCode {
    guarded(|| {
        // SAFETY: the caller's *object*.
        unsafe { exclusive("run", run) }?.tick();
        Ok(())
    })
}

/// Whether all triangles are drawn and the machine was idle in the last clock. NULL is done.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn edgewalk_run_is_done(run: *const EdgewalkRun) -> bool {
    // SAFETY: the caller's *object*.
    unsafe { shared("run", run) }.map_or(true, |run| run.done)
}

/// Clocks so far; 0 of NULL.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn edgewalk_run_clocks(run: *const EdgewalkRun) -> u64 {
    // SAFETY: the caller's *object*.
    unsafe { shared("run", run) }.map_or(0, |run| run.rig.cycle())
}

/// The value of a port in the last clock, by its name in docs/machine.md, section 20, such as "wr_addr". `word` 0 has
/// bits 63 to 0, `word` 1 bits 127 to 64 of a wider port. A signed value is not extended. Fields count while their
/// valid is 1.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn edgewalk_run_port(
    run: *const EdgewalkRun,
    port: *const c_char,
    word: u32,
    value: *mut u64,
) -> EdgewalkCode {
    guarded(|| {
        // SAFETY: the caller's *object* and *text*.
        let found = unsafe { shared("run", run)?.port(text("port", port)?, word) }?;
        // SAFETY: the caller's *object*, to be written.
        *unsafe { exclusive("value", value) }? = found;
        Ok(())
    })
}

/// Frees a run; NULL is permitted.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn edgewalk_run_free(run: *mut EdgewalkRun) {
    // SAFETY: the caller's *object*, which he uses no more.
    unsafe { free(run) }
}
