//! Native code: a function that Cranelift made, in memory that lives as long as it can be called.

use std::sync::Mutex;

use cranelift_codegen::ir::{AbiParam, Endianness, Function};
use cranelift_codegen::isa::OwnedTargetIsa;
use cranelift_codegen::settings::{self, Configurable};
use cranelift_jit::{JITBuilder, JITModule};
use cranelift_module::{Module, ModuleError, default_libcall_names};

use crate::error::JitError;
use crate::lower::{ODD, Plan, Program, lower};

/// A program; it takes the state's address and [`ODD`].
type Entry = unsafe extern "C" fn(*mut u64);

/// What a program is lowered to, before the code generator sees the host: the same on each.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Cost {
    /// Instructions of the intermediate form, loads and stores among them.
    pub instructions: usize,
    /// Reads of the state and of tables.
    pub loads: usize,
    /// Writes of the state.
    pub stores: usize,
    /// Stretches of code between branches.
    pub blocks: usize,
}

impl Cost {
    fn of(function: &Function) -> Cost {
        let mut cost = Cost { instructions: 0, loads: 0, stores: 0, blocks: 0 };
        for block in function.layout.blocks() {
            cost.blocks += 1;
            for instruction in function.layout.block_insts(block) {
                let opcode = function.dfg.insts[instruction].opcode();
                cost.instructions += 1;
                cost.loads += usize::from(opcode.can_load());
                cost.stores += usize::from(opcode.can_store());
            }
        }
        cost
    }
}

/// A program for one layout.
pub(crate) struct Code {
    entry: Entry,
    /// 64-bit words that the program may access from the address on.
    size: usize,
    /// What it was lowered to.
    pub cost: Cost,
    /// Owns the memory that the entry points into. `None` only while it is dropped.
    module: Option<Mutex<JITModule>>,
}

impl Code {
    /// Compiles a program.
    ///
    /// # Errors
    /// If there is no code generator for this machine.
    pub fn new(program: Program, plan: &Plan) -> Result<Code, JitError> {
        let mut module = JITModule::new(JITBuilder::with_isa(isa()?, default_libcall_names()));
        let (entry, cost) = entry(&mut module, program, plan)?;
        Ok(Code { entry, size: plan.layout.size, cost, module: Some(Mutex::new(module)) })
    }

    /// Runs the program.
    ///
    /// # Panics
    /// If the state is smaller than the layout: a defect of this crate.
    #[inline]
    pub fn run(&self, state: &mut [u64]) {
        assert!(state.len() >= self.size, "the state is made from the same layout");
        // SAFETY: the program reads and writes only places and areas of its layout, and these end within
        // `size` words (`Layout::take` hands them out one after the other and `size` is where the last ends);
        // a word of an area is accessed only at an index that was found to be less than the number of words,
        // or 0, or that has too few bits to be more (`index`, `read` and `write` in `lower/memory.rs`); an
        // entry of a table at an index of as many bits as it has entries for, zeros above them (`looked_up`
        // in `lower/demand.rs`); a register at the place that such an entry or a bit, 0 or 1, says
        // (`read_from_array`), each of which is one of the layout; two words that stand side by side in it
        // (`lower/copies.rs`); seeds word by word and their copies two words at a time, to the end of the
        // places that the layout has for them (`asked` in `lower/wake_counters.rs`). The slice is ours alone
        // while the call lasts, aligned to 8 bytes as the accesses say, and any bits are a valid u64. The
        // code calls nothing and cannot unwind. It takes [`ODD`] off the address that it is given.
        unsafe { (self.entry)(state.as_mut_ptr().wrapping_byte_add(ODD as usize)) }
    }
}

impl Drop for Code {
    fn drop(&mut self) {
        if let Some(module) = self.module.take() {
            let module = module.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
            // SAFETY: the only pointer into this memory is the entry; it is never handed out, nobody can be
            // in it while `self` is borrowed exclusively, and nobody can call it afterwards.
            unsafe { module.free_memory() }
        }
    }
}

/// The code generator for this machine.
fn isa() -> Result<OwnedTargetIsa, JitError> {
    let refused = |error: &dyn std::fmt::Display| JitError::Host(error.to_string());
    let mut flags = settings::builder();
    for (name, value) in [
        // What it would simplify is simplified here, before; and it would part a bit's load from the branch
        // that tests it.
        ("opt_level", "none"),
        ("enable_verifier", if cfg!(debug_assertions) { "true" } else { "false" }),
        ("enable_probestack", "false"),
        ("unwind_info", "false"),
    ] {
        flags.set(name, value).map_err(|error| refused(&error))?;
    }
    let isa = cranelift_native::builder().map_err(|error| refused(&error))?;
    let isa = isa.finish(settings::Flags::new(flags)).map_err(|error| refused(&error))?;
    if isa.endianness() != Endianness::Little || isa.pointer_bits() != 64 {
        return Err(JitError::Host("it is not a little-endian machine of 64 bits".to_owned()));
    }
    Ok(isa)
}

fn entry(module: &mut JITModule, program: Program, plan: &Plan) -> Result<(Entry, Cost), JitError> {
    let refused = |error: ModuleError| JitError::Cranelift(error.to_string());
    let pointer = module.target_config().pointer_type();
    let mut context = module.make_context();
    context.func.signature = module.make_signature();
    context.func.signature.params.push(AbiParam::new(pointer));
    let has_vectors = matches!(module.isa().name(), "x64" | "aarch64");
    lower(program, plan, pointer, has_vectors, &mut context.func);
    let cost = Cost::of(&context.func);
    let function = module.declare_anonymous_function(&context.func.signature).map_err(refused)?;
    module.define_function(function, &mut context).map_err(refused)?;
    module.finalize_definitions().map_err(refused)?;
    let address = module.get_finalized_function(function);
    // SAFETY: the address is that of a finalized function with the signature given above, (pointer) -> () in
    // the platform's C convention, which is what `Entry` says. It is executable as long as `module` lives:
    // `Code` keeps both together, and calls the entry only through `&self`.
    let entry = unsafe { std::mem::transmute::<*const u8, Entry>(address) };
    Ok((entry, cost))
}
