//! SETUP takes the clocks that `docs/machine.md`, section 2, gives: S1 until a triangle is culled, S1 + S2 + 1 until its prim is there.

mod random;

use edgewalk_machine::{EdgeKind, Fill, Machine, Plan};
use edgewalk_netlist::Simulator;
use edgewalk_rtl as rtl;
use rand::SeedableRng;
use rand_pcg::Pcg64Mcg;

/// S1 and S2, written out of the specification.
fn clocks(plan: &Plan) -> (u32, u32) {
    let t = plan.subpixel_bits.max(1);
    let (g, dw, k) = (plan.guard_bits, plan.guard_bits + t + 2, plan.bits_per_clock());
    let c =
        plan.channels().iter().map(|channel| channel.bits + channel.fraction).max().expect("four at least");
    let div = |n: u32| 1 + n.div_ceil(k);
    let mul = 1 + dw.div_ceil(k);
    let (divq, divc) = match plan.edge_kind {
        EdgeKind::Exact => (div(dw - 1), div(2 * dw - 1 - t)),
        EdgeKind::Slope => (div(dw - 1 + plan.edge_fraction), div(2 * dw - 1 + plan.edge_fraction)),
    };
    let t1 = divq + mul + divc;
    let t2 = match plan.fill {
        Fill::Exact => 4 * mul + div(dw + c + t) + div(dw + c + g + 2 + t) + div(2 * dw + c),
        Fill::Textbook => 3 * mul + 5 * div(dw + c + t),
    };
    let rounds = (plan.channels().len() as u32).div_ceil(plan.lanes);
    (3 + 4 / plan.lanes * t1, 1 + rounds * t2)
}

/// Cycles after the one in which the triangle fired, until this port is 1.
fn cycles_until(plan: &Plan, triangle: [[i64; 2]; 3], port: &str) -> u32 {
    let netlist = rtl::setup(plan).unwrap_or_else(|errors| panic!("{plan:?}\n{errors}"));
    let mut sim = Simulator::new(&netlist);
    let set = |sim: &mut Simulator, name: &str, value: i64| {
        let id = sim.input(name).expect("a port of SETUP");
        sim.set(id, value as u128);
    };
    set(&mut sim, "rst", 1);
    sim.tick();
    set(&mut sim, "rst", 0);
    for (place, [x, y]) in triangle.into_iter().enumerate() {
        set(&mut sim, &format!("tri_x{place}"), x << plan.subpixel_bits);
        set(&mut sim, &format!("tri_y{place}"), y << plan.subpixel_bits);
    }
    set(&mut sim, "tri_valid", 1);
    assert_eq!(sim.get("tri_ready"), Ok(1));
    sim.tick();
    set(&mut sim, "tri_valid", 0);
    (1..100_000)
        .find(|_| {
            let there = sim.get(port) == Ok(1);
            sim.tick();
            there
        })
        .unwrap_or_else(|| panic!("{port} stays 0: {plan:?}"))
}

#[test]
fn setup_takes_s1_and_s2() {
    let mut rng = Pcg64Mcg::seed_from_u64(3);
    let presets = ["default", "textbook"].into_iter().filter_map(Plan::preset);
    let mut checked = 0;
    for plan in presets.chain((0..60).map(|_| random::random_plan(&mut rng))) {
        // The triangle covers a pixel of the smallest screen.
        let plan = Machine { width: plan.width.max(2), height: plan.height.max(2), ..(*plan).clone() };
        let Ok(plan) = plan.plan() else { continue };
        let (s1, s2) = clocks(&plan);
        assert_eq!(cycles_until(&plan, [[-1, -1], [3, -1], [0, 3]], "prim_valid"), s1 + s2 + 1, "{plan:?}");
        assert_eq!(cycles_until(&plan, [[0, 0], [1, 1], [2, 2]], "tri_ready"), s1 + 1, "{plan:?}");
        checked += 1;
    }
    println!("{checked} machines");
    assert!(checked > 50, "only {checked} machines");
}
