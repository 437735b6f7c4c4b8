//! The adders of PIXEL: words cut into segments, each added a clock after the one below it.

use edgewalk_machine::{Channel, Plan};
use edgewalk_netlist::{Module, Reg, Signal};

use crate::wires::Token;

/// For the header of machines with more than one segment.
pub(super) const SKEW_DOC: &str =
    "Segments: words are cut into segments; the carry moves one segment a clock.
  clock   0  1  2  3        Each segment loads, adds and leaves one clock behind the segment below it.
  seg 0   a  b  c  d        A segment needs only the carry of the clock before.
  seg 1      a  b  c        The output stages bring the bits of a fragment together.
  seg 2         a  b";

/// What a segment of all words does in a clock in which PIXEL advances.
#[derive(Clone, Copy)]
pub(super) struct Step<'m> {
    /// The span in it goes on; else one may enter.
    pub stays: Signal<'m>,
    /// One that enters has new increments.
    pub fresh: Signal<'m>,
    /// Each adder adds the increment of one channel; only in a span that goes on.
    pub add: Signal<'m>,
    /// Which one: the place among the channels of the adder. `None` if each has only one.
    pub slot: Option<Signal<'m>>,
}

/// The steps of all segments: each does what the one below it did at the last advance.
fn steps<'m>(m: &'m Module, plan: &Plan, advance: Signal<'m>, first: Step<'m>) -> Vec<Step<'m>> {
    if plan.segments > 1 {
        m.comment("Each segment repeats what the segment below did at the last advance.");
    }
    let mut steps = vec![first];
    for segment in 1..plan.segments {
        let below = steps[segment as usize - 1];
        let late = |name: &str, signal: Signal<'m>| {
            m.reg(&format!("{name}{segment}"), signal.width()).reset(0).when(advance, signal).q()
        };
        let (stays, fresh) = (late("stays", below.stays), late("fresh", below.fresh));
        // With one channel an adder it adds wherever it stays.
        let add = if below.slot.is_some() { late("add", below.add) } else { stays };
        let slot = below.slot.map(|slot| late("slot", slot));
        steps.push(Step { stays, fresh, add, slot });
    }
    steps
}

/// A segment of a channel's word.
pub(super) struct Segment<'m> {
    /// Lowest bit of the segment in the word.
    low: u32,
    value: Reg<'m>,
    inc: Reg<'m>,
    /// The value of a span that enters.
    first: Signal<'m>,
}

/// The words of all channels.
pub(super) struct Words<'m> {
    /// By channel, then by segment; a narrow word beside a wide one has no bits in the upper segments of their adder.
    segments: Vec<Vec<Option<Segment<'m>>>>,
}

impl<'m> Words<'m> {
    /// The registers, the adders, and the loads.
    pub fn new(
        m: &'m Module,
        plan: &Plan,
        advance: Signal<'m>,
        first: Step<'m>,
        span: &Token<'m>,
        increments: &Token<'m>,
    ) -> Words<'m> {
        let steps = steps(m, plan, advance, first);
        let mut words = Words { segments: Vec::new() };
        for (adder, slots) in plan.slots().into_iter().enumerate() {
            let channels = &plan.channels()[slots.clone()];
            let bounds = bounds(plan, channels);
            for channel in channels {
                let entering = Entering { value: span[channel.name], inc: increments[channel.name] };
                words.segments.push(registers(m, advance, channel, &bounds, &steps, &entering));
            }
            let name = match channels {
                [own] => {
                    m.comment("Adder of this channel.");
                    own.name.to_owned()
                }
                several => {
                    let names: Vec<&str> = several.iter().map(|channel| channel.name).collect();
                    m.comment(&format!("Adder of {}.", names.join(", ")));
                    format!("adder{adder}")
                }
            };
            add(m, advance, &name, &bounds, &steps, &words.segments[slots]);
        }
        words
    }

    /// The bits that segment `segment` of a channel has of the output; `None` if they are all fraction.
    pub fn output(&self, plan: &Plan, channel: usize, segment: usize) -> Option<Signal<'m>> {
        let part = self.segments[channel][segment].as_ref()?;
        let fraction = plan.channels()[channel].fraction;
        let value = part.value.q();
        let below = fraction.saturating_sub(part.low);
        (below < value.width()).then(|| value.slice(value.width() - 1, below))
    }
}

/// Where the segments of an adder begin, and where the last one ends; the adder is as wide as its widest channel.
fn bounds(plan: &Plan, channels: &[Channel]) -> Vec<u32> {
    let width = channels.iter().map(|channel| channel.word()).max().unwrap_or(1);
    (0..=plan.segments).map(|segment| segment * width / plan.segments).collect()
}

/// What a span loads into the words of a channel.
struct Entering<'m> {
    value: Signal<'m>,
    inc: Signal<'m>,
}

/// The registers of a channel, a pair a segment, and what a span loads into them.
fn registers<'m>(
    m: &'m Module,
    advance: Signal<'m>,
    channel: &Channel,
    bounds: &[u32],
    steps: &[Step<'m>],
    entering: &Entering<'m>,
) -> Vec<Option<Segment<'m>>> {
    let name = channel.name;
    m.comment(&format!("Value and increment of channel {name}."));
    let Entering { value: mut value_in, inc: mut inc_in } = *entering;
    let word = value_in.width();
    let mut segments = Vec::new();
    for (segment, step) in steps.iter().enumerate() {
        let (low, high) = (bounds[segment], bounds[segment + 1].min(word));
        if low >= high {
            segments.push(None);
            continue;
        }
        if segment > 0 {
            let late = |what: &str, below: Signal<'m>| {
                let rest = m.reg(&format!("{name}_{what}_late{segment}"), word - low);
                rest.doc("upper bits of the next span")
                    .when(advance, below.slice(below.width() - 1, low - bounds[segment - 1]))
                    .q()
            };
            (value_in, inc_in) = (late("value", value_in), late("inc", inc_in));
        }
        let register = |what: &str| {
            let format = format!("{} LSB, modular", channel.word_format());
            let (part, doc) = match steps.len() {
                1 => (String::new(), format),
                _ => (segment.to_string(), format!("bits {} to {low} of {format}", high - 1)),
            };
            m.reg(&format!("{name}_{what}{part}"), high - low).doc(&doc)
        };
        let (value, inc) = (register("value"), register("inc"));
        inc.when(advance & !step.stays & step.fresh, lowest(inc_in, high - low));
        segments.push(Some(Segment { low, value, inc, first: lowest(value_in, high - low) }));
    }
    segments
}

/// One adder with all its segments, and the carries between them.
fn add<'m>(
    m: &'m Module,
    advance: Signal<'m>,
    name: &str,
    bounds: &[u32],
    steps: &[Step<'m>],
    channels: &[Vec<Option<Segment<'m>>>],
) {
    let mut carry: Option<Signal> = None;
    for (segment, step) in steps.iter().enumerate() {
        let is_last = segment + 1 == steps.len();
        let part = if steps.len() == 1 { String::new() } else { segment.to_string() };
        let bits = bounds[segment + 1] - bounds[segment];
        let sum_bits = if is_last { bits } else { bits + 1 };
        let here = channels
            .iter()
            .enumerate()
            .filter_map(|(slot, channel)| Some((slot, channel[segment].as_ref()?)));
        let here: Vec<(usize, &Segment)> = here.collect();
        let turn = |slot: usize| step.slot.map(|now| now.eq(slot as i32));
        let operand = |of: fn(&Segment<'m>) -> Signal<'m>| {
            let choices = here.iter().map(|(slot, part)| (turn(*slot), of(part).zext(sum_bits)));
            choices.reduce(|(_, chosen), (turn, other)| {
                (turn, turn.map_or(other, |turn| turn.mux(other, chosen)))
            })
        };
        let (Some((_, value)), Some((_, inc))) =
            (operand(|part| part.value.q()), operand(|part| part.inc.q()))
        else {
            continue;
        };
        let sum = carry.map_or(value + inc, |carry| value + inc + carry.zext(sum_bits));
        let sum = sum.named(&format!("{name}_sum{part}"));
        for (slot, part) in &here {
            let sum = lowest(sum, part.value.q().width());
            match turn(*slot) {
                // One or the other in every clock: the enable is `advance` alone.
                None => part.value.when(advance, step.stays.mux(sum, part.first)),
                Some(turn) => {
                    part.value.when(advance & !step.stays, part.first).when(advance & step.add & turn, sum)
                }
            };
        }
        carry = (!is_last)
            .then(|| m.reg(&format!("{name}_carry{}", segment + 1), 1).when(advance, sum.msb()).q());
    }
}

/// The lowest bits of a signal; all of it where it has no more.
fn lowest(signal: Signal<'_>, bits: u32) -> Signal<'_> {
    if signal.width() == bits { signal } else { signal.trunc(bits) }
}
