//! The module under construction: its draft, and whatever enters it by name.

use std::cell::RefCell;
use std::collections::BTreeMap;
use std::panic::Location;
use std::sync::Arc;

use super::operand::Operand;
use super::signal::Signal;
use super::storage::{Memory, Reg};
use super::structure::{Instance, Wire};
use super::{check, paths};
use crate::describe::describe;
use crate::error::{BuildError, BuildErrors, Fault, Place};
use crate::names;
use crate::netlist::{self, Contents, Item, Netlist, Node, NodeId, Source};
use crate::ops::{MAX_WIDTH, Op, mask};

/// A module under construction. Faults are collected and come out of [`Module::finish`]; until then whatever is
/// faulty stands in with the width that was wanted.
#[derive(Debug)]
pub struct Module {
    draft: RefCell<Draft>,
}

#[derive(Debug)]
pub(super) struct Draft {
    pub netlist: Netlist,
    pub errors: Vec<BuildError>,
    /// Every name in use, with the node it stands for if it is that of a register or wire.
    names: BTreeMap<String, Option<NodeId>>,
    /// Where each register, wire and instance was declared, by name.
    pub places: BTreeMap<String, Place>,
}

impl Module {
    /// An empty module. `doc` (purpose, formats, timing; any number of lines) becomes the header of its Verilog.
    #[track_caller]
    pub fn new(name: &str, doc: &str) -> Module {
        let netlist = Netlist {
            name: name.to_string(),
            doc: doc.trim_end().to_string(),
            nodes: Vec::new(),
            inputs: Vec::new(),
            outputs: Vec::new(),
            wires: Vec::new(),
            registers: Vec::new(),
            memories: Vec::new(),
            instances: Vec::new(),
            items: Vec::new(),
            paths: Vec::new(),
            has_clock: false,
            has_reset: false,
        };
        let draft = Draft { netlist, errors: Vec::new(), names: BTreeMap::new(), places: BTreeMap::new() };
        let module = Module { draft: RefCell::new(draft) };
        if !names::is_legal(name) {
            module.fail(Fault::IllegalName { name: name.to_string() });
        }
        module
    }

    /// Appends lines to the header text.
    pub fn doc(&self, lines: &str) {
        let mut draft = self.draft.borrow_mut();
        let doc = &mut draft.netlist.doc;
        if !doc.is_empty() {
            doc.push('\n');
        }
        doc.push_str(lines.trim_end());
    }

    /// Begins a section; the text stands above what follows.
    pub fn comment(&self, text: &str) {
        self.draft.borrow_mut().netlist.items.push(Item::Comment(text.to_string()));
    }

    /// An input port.
    #[track_caller]
    pub fn input(&self, name: &str, width: u32) -> Signal<'_> {
        self.input_doc(name, width, "")
    }

    /// An input port with its format and unit.
    #[track_caller]
    pub fn input_doc(&self, name: &str, width: u32, doc: &str) -> Signal<'_> {
        let width = self.checked_width(name, width);
        let port = self.draft.borrow().netlist.inputs.len();
        let signal = self.node(width, Source::Input(port));
        self.declare(name, None);
        let input = netlist::Input { name: name.to_string(), doc: doc.to_string(), node: signal.id };
        self.draft.borrow_mut().netlist.inputs.push(input);
        signal
    }

    /// An output port. It may bear the name of the register or wire that drives it.
    #[track_caller]
    pub fn output<'m>(&'m self, name: &str, signal: impl Operand<'m>) {
        self.output_doc(name, signal, "");
    }

    /// An output port with its format and unit.
    #[track_caller]
    pub fn output_doc<'m>(&'m self, name: &str, signal: impl Operand<'m>, doc: &str) {
        let Some(width) = signal.width_in(self) else {
            return self.fail(Fault::UnknownWidth);
        };
        let driver = signal.signal(self, width).id;
        let same = self.draft.borrow().names.get(name) == Some(&Some(driver));
        if !same {
            self.declare(name, None);
        }
        let output = netlist::Output { name: name.to_string(), doc: doc.to_string(), driver };
        self.draft.borrow_mut().netlist.outputs.push(output);
    }

    /// A register; see [`Reg`].
    #[track_caller]
    pub fn reg(&self, name: &str, width: u32) -> Reg<'_> {
        Reg::new(self, name, width)
    }

    /// A wire whose driver comes later, for feedback; see [`Wire`].
    #[track_caller]
    pub fn wire(&self, name: &str, width: u32) -> Wire<'_> {
        Wire::new(self, name, width)
    }

    /// The signal as a wire with a name for the reader.
    #[track_caller]
    pub fn name<'m>(&'m self, name: &str, signal: Signal<'m>) -> Signal<'m> {
        signal.named(name)
    }

    /// A constant.
    #[track_caller]
    pub fn lit(&self, width: u32, value: u128) -> Signal<'_> {
        let width = self.checked_width("constant", width);
        let value = self.checked_value(width, value);
        self.node(width, Source::Constant { value, name: None })
    }

    /// A constant with a name, such as a state.
    #[track_caller]
    pub fn constant(&self, name: &str, width: u32, value: u128) -> Signal<'_> {
        let width = self.checked_width(name, width);
        let value = self.checked_value(width, value);
        let signal = self.node(width, Source::Constant { value, name: Some(name.to_string()) });
        self.declare(name, None);
        self.item(Item::Constant(signal.id));
        signal
    }

    /// The signals side by side, the most significant first.
    #[track_caller]
    pub fn cat<'m>(&'m self, parts: &[Signal<'m>]) -> Signal<'m> {
        self.op(Op::Concat, parts, 1)
    }

    /// A memory of `words` words (at least 2), unknown until they are written; see [`Memory`]. `addr_bits` is ceil(log2 words).
    #[track_caller]
    pub fn memory(&self, name: &str, addr_bits: u32, words: usize, width: u32) -> Memory<'_> {
        Memory::new(
            self,
            name,
            netlist::Memory {
                name: name.to_string(),
                doc: String::new(),
                addr_bits,
                words,
                width,
                contents: Contents::default(),
                writes: Vec::new(),
                reads: Vec::new(),
            },
        )
    }

    /// Another module inside this one; see [`Instance`].
    #[track_caller]
    pub fn instance(&self, name: &str, module: &Arc<Netlist>) -> Instance<'_> {
        Instance::new(self, name, module)
    }

    /// Checks the module and freezes it.
    ///
    /// # Errors
    /// Everything found while building, then whatever is undriven, then combinational loops.
    #[track_caller]
    pub fn finish(self) -> Result<Arc<Netlist>, BuildErrors> {
        let Draft { mut netlist, mut errors, places, .. } = self.draft.into_inner();
        let here = Place(Location::caller());
        let mut faults = check::undriven(&netlist);
        faults.extend(check::unknown_words(&netlist));
        faults.extend(check::duplicate_modules(&netlist));
        errors.extend(faults.into_iter().map(|(name, fault)| {
            let place = places.get(&name).copied().unwrap_or(here);
            BuildError { module: netlist.name.clone(), place, fault }
        }));
        if !errors.is_empty() {
            return Err(BuildErrors(errors));
        }
        netlist.has_clock = netlist.needs_clock();
        netlist.has_reset = netlist.needs_reset();
        match paths::of_outputs(&netlist) {
            Ok(paths) => netlist.paths = paths,
            Err(path) => {
                let fault = Fault::Loop { path };
                return Err(BuildErrors(vec![BuildError { module: netlist.name, place: here, fault }]));
            }
        }
        Ok(Arc::new(netlist))
    }

    // What the handles of the other files share.

    pub(super) fn draft(&self) -> std::cell::RefMut<'_, Draft> {
        self.draft.borrow_mut()
    }

    #[track_caller]
    pub(super) fn fail(&self, fault: Fault) {
        let mut draft = self.draft.borrow_mut();
        let module = draft.netlist.name.clone();
        draft.errors.push(BuildError { module, place: Place(Location::caller()), fault });
    }

    pub(super) fn item(&self, item: Item) {
        self.draft.borrow_mut().netlist.items.push(item);
    }

    pub(super) fn node(&self, width: u32, source: Source) -> Signal<'_> {
        let nodes = &mut self.draft.borrow_mut().netlist.nodes;
        let id = NodeId(nodes.len() as u32);
        nodes.push(Node { width, source });
        Signal { module: self, id, width }
    }

    /// Takes a name; `node` is the register or wire an output of this name may show.
    #[track_caller]
    pub(super) fn declare(&self, name: &str, node: Option<NodeId>) {
        if !names::is_legal(name) {
            self.fail(Fault::IllegalName { name: name.to_string() });
        }
        let place = Place(Location::caller());
        let taken = {
            let mut draft = self.draft.borrow_mut();
            draft.places.entry(name.to_string()).or_insert(place);
            draft.names.insert(name.to_string(), node).is_some()
        };
        if taken {
            self.fail(Fault::DuplicateName { name: name.to_string() });
        }
    }

    /// The operator's result; of `fallback` bits if its operands do not fit.
    #[track_caller]
    pub(super) fn op<'m>(&'m self, op: Op, operands: &[Signal<'m>], fallback: u32) -> Signal<'m> {
        let mut ids = Vec::with_capacity(operands.len());
        for operand in operands {
            ids.push(self.own(*operand).id); // no closure: the place of a fault is the caller's line
        }
        let widths: Vec<u32> = operands.iter().map(|operand| operand.width).collect();
        let width = match op.width(&widths) {
            Ok(width) => width,
            Err(reason) => {
                let expression = describe(&self.draft.borrow().netlist, &Source::Op(op, ids.clone()));
                self.fail(Fault::Operands { expression, reason });
                fallback.clamp(1, MAX_WIDTH)
            }
        };
        self.node(width, Source::Op(op, ids))
    }

    /// The signal, if it is one of this module; else a constant in its place.
    #[track_caller]
    pub(super) fn own<'m>(&'m self, signal: Signal<'m>) -> Signal<'m> {
        if std::ptr::eq(self, signal.module) {
            return signal;
        }
        self.fail(Fault::Foreign { signal: signal.describe() });
        self.node(signal.width, Source::Constant { value: 0, name: None })
    }

    /// The operand as a signal of exactly the width of `target`.
    #[track_caller]
    pub(super) fn fitted<'m>(&'m self, target: &str, width: u32, operand: impl Operand<'m>) -> Signal<'m> {
        let signal = operand.signal(self, width);
        if signal.width == width {
            return signal;
        }
        self.fail(Fault::Width {
            target: target.to_string(),
            wanted: width,
            signal: signal.describe(),
            found: signal.width,
        });
        self.node(width, Source::Constant { value: 0, name: None })
    }

    #[track_caller]
    pub(super) fn checked_width(&self, name: &str, width: u32) -> u32 {
        if !(1..=MAX_WIDTH).contains(&width) {
            self.fail(Fault::BadWidth { name: name.to_string(), width });
        }
        width.clamp(1, MAX_WIDTH)
    }

    #[track_caller]
    pub(super) fn checked_value(&self, width: u32, value: u128) -> u128 {
        if value > mask(width) {
            self.fail(Fault::Literal { value: value.to_string(), width });
        }
        value & mask(width)
    }
}
