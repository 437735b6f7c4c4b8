//! The lanes as instances, and what they do in each clock; what they work on is `operands`.

use std::sync::Arc;

use edgewalk_machine::{Channel, EdgeKind, Fill, Plan};
use edgewalk_netlist::{BuildErrors, Instance, Module, Netlist, Signal};

use super::control::Control;
use super::lane::{Shape, lane};
use super::schedule::{Kind, Op, channel_jobs, edge_jobs, late};

/// One lane in place.
pub(super) struct Lane<'m> {
    /// Which one.
    pub number: usize,
    /// Its jobs on edges, one a round: 0 is the area, 1 to 3 are the edges.
    pub edges: Vec<usize>,
    /// Its jobs on channels, one a round.
    pub channels: Vec<Channel>,
    pub shape: Shape,
    pub instance: Instance<'m>,
}

/// The lanes, with everything connected but their operands.
pub(super) fn lanes<'m>(
    m: &'m Module,
    plan: &Plan,
    control: &Control<'m>,
) -> Result<Vec<Lane<'m>>, BuildErrors> {
    let count = plan.lanes as usize;
    let shapes: Vec<Shape> = (0..count).map(|number| Shape::new(plan, number)).collect();
    let netlists = netlists(plan, &shapes)?;
    let work = Work::new(m, control);
    let in_place = |(number, (shape, netlist)): (usize, (Shape, Arc<Netlist>))| {
        let instance = m.instance(&format!("lane{number}"), &netlist);
        let (edges, channels) = (edge_jobs(plan, number), channel_jobs(plan, number));
        let lane = Lane { number, edges, channels, shape, instance };
        work.connect(m, plan, control, &lane);
        lane
    };
    Ok(shapes.into_iter().zip(netlists).enumerate().map(in_place).collect())
}

/// One netlist a lane; lanes of the same shape share it.
fn netlists(plan: &Plan, shapes: &[Shape]) -> Result<Vec<Arc<Netlist>>, BuildErrors> {
    let mut netlists: Vec<Arc<Netlist>> = Vec::new();
    for (i, shape) in shapes.iter().enumerate() {
        let same = shapes[..i].iter().position(|other| other == shape);
        netlists.push(match same {
            Some(other) => Arc::clone(&netlists[other]),
            None => lane(plan, &format!("edgewalk_setup_lane{i}"), shape)?,
        });
    }
    Ok(netlists)
}

/// What all lanes do in a clock.
struct Work<'m> {
    load_terms: Signal<'m>,
    load_product: Signal<'m>,
    step_product: Signal<'m>,
    first_step: Signal<'m>,
    load_quotient: Signal<'m>,
    load_quotient_of_y: Signal<'m>,
    step_quotient: Signal<'m>,
}

impl<'m> Work<'m> {
    fn new(m: &'m Module, control: &Control<'m>) -> Work<'m> {
        m.comment("What all lanes do.");
        let of_kind = |kind: Kind, name: &str| {
            let ops: Vec<Op> = control.ops().filter(|op| op.kind() == kind).collect();
            control.during(&ops).named(name)
        };
        let product = of_kind(Kind::Product, "is_product");
        let quotient = of_kind(Kind::Quotient, "is_quotient");
        let of_y = of_kind(Kind::QuotientOfY, "is_quotient_of_y");
        let terms = [Op::EdgeProduct, Op::Nx, Op::Ny, Op::ProductA, Op::ProductB];
        Work {
            load_terms: (control.load & control.during(&terms)).named("load_terms"),
            load_product: (control.load & product).named("load_product"),
            step_product: (control.stepping & product).named("step_product"),
            first_step: control.step.eq(1).named("first_step"),
            load_quotient: (control.load & quotient).named("load_quotient"),
            load_quotient_of_y: (control.load & of_y).named("load_quotient_of_y"),
            step_quotient: (control.stepping & (quotient | of_y)).named("step_quotient"),
        }
    }

    fn connect(&self, m: &'m Module, plan: &Plan, control: &Control<'m>, lane: &Lane<'m>) {
        let instance = lane.instance;
        instance
            .connect("load_terms", self.load_terms)
            .connect("load_factors", self.load_product)
            .connect("step_product", self.step_product)
            .connect("first_step", self.first_step)
            .connect("load_divisor", self.load_quotient)
            .connect("from_y", self.load_quotient_of_y)
            .connect("step_quotient", self.step_of(plan, control, lane))
            .connect("digit_at", digit_at(m, plan, control, lane));
        if plan.fill == Fill::Exact {
            instance
                .connect("keep_nx", control.load & control.during(&[Op::Gx]))
                .connect("load_gradients", control.load & control.during(&[Op::LineProduct]))
                .connect("keep_gx", control.after(Op::Gx))
                .connect("add_line", control.after(Op::Line));
        }
    }

    /// A channel with a shorter word than another has fewer digits and begins later.
    fn step_of(&self, plan: &Plan, control: &Control<'m>, lane: &Lane<'m>) -> Signal<'m> {
        let late: Vec<u32> = lane.channels.iter().map(|channel| late(plan, *channel)).collect();
        if late.iter().all(|clocks| *clocks == 0) {
            return self.step_quotient;
        }
        let begun = control.of_round(late.len(), |round| control.step.gt(late[round] as i32));
        self.step_quotient & (control.in_edges | begun)
    }
}

/// Where the operation's digits are, as a place in the shape's list.
fn digit_at<'m>(m: &'m Module, plan: &Plan, control: &Control<'m>, lane: &Lane<'m>) -> Signal<'m> {
    let place = |op: Op, channel: &Channel| {
        let bit = op.first_digit(plan, *channel);
        lane.shape.first_digits.iter().position(|digit| *digit == bit).unwrap_or(0)
    };
    let literal = |place: usize| m.lit(lane.shape.digit_select(), place as u128);
    let quotients = control.ops().filter(|op| op.kind() != Kind::Product);
    // Place 0 is what remains where no other is chosen.
    let others = quotients.filter(|op| lane.channels.iter().any(|channel| place(*op, channel) > 0));
    others.fold(literal(0), |chosen, op| {
        let of_round =
            control.of_round(lane.channels.len(), |round| literal(place(op, &lane.channels[round])));
        control.during(&[op]).mux(of_round, chosen)
    })
}

impl Lane<'_> {
    /// Asks for the outputs that the lane's jobs have a use for, so that their wires are declared beside the lane.
    pub fn ask_results(&self, plan: &Plan) {
        if self.edges.contains(&0) {
            self.instance.output("product");
        }
        if plan.edge_kind == EdgeKind::Exact && self.edges.iter().any(|job| *job > 0) {
            self.instance.output("quotient");
            self.instance.output("remainder");
        }
        self.instance.output("rounded");
        if plan.fill == Fill::Exact {
            self.instance.output("d1");
        }
    }
}
