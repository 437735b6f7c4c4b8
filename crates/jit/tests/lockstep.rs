//! Native code against the interpreter: every signal in every cycle.
#![allow(clippy::unwrap_used)] // a test may

mod common {
    pub mod enables;
}
#[path = "../../verilog/tests/random_module"]
mod random {
    #[path = "mod.rs"]
    pub mod module;
}

use edgewalk_netlist::Netlist;
use rand::Rng;
use rand_pcg::Pcg64Mcg;

/// Runs both for so many cycles with random inputs; returns how many values were compared.
fn compare(netlist: &Netlist, random: &mut Pcg64Mcg, cycles: usize) -> usize {
    let mut wanted = edgewalk_netlist::Simulator::new(netlist);
    let mut found = edgewalk_jit::Simulator::new(netlist).unwrap();
    let paths: Vec<String> = wanted.signals().map(|(path, _)| path.to_owned()).collect();
    assert_eq!(found.paths().collect::<Vec<_>>(), paths);
    let signals: Vec<_> =
        paths.iter().map(|path| (path, wanted.signal(path).unwrap(), found.signal(path).unwrap())).collect();
    let outputs: Vec<_> = netlist.outputs.iter().map(|output| &output.name).collect();
    let outputs: Vec<_> =
        outputs.iter().map(|name| (wanted.signal(name).unwrap(), found.output(name).unwrap())).collect();
    let mut compared = 0;
    for cycle in 0..cycles {
        for input in &netlist.inputs {
            let value = corner_or_any(random, netlist.width(input.node));
            wanted.set_input(&input.name, value).unwrap();
            found.set_input(&input.name, value).unwrap();
        }
        if netlist.has_reset {
            let reset = u128::from(cycle == 0 || random.random_bool(0.02));
            wanted.set_input("rst", reset).unwrap();
            found.set_input("rst", reset).unwrap();
        }
        for (path, a, b) in &signals {
            assert_eq!(wanted.width(*a), found.width(*b), "{path}");
            assert_eq!(wanted.value(*a), found.value(*b), "{} cycle {cycle} {path}", netlist.name);
            compared += 1;
        }
        let before: Vec<u128> = outputs.iter().map(|(signal, _)| wanted.value(*signal)).collect();
        // Now and then several clocks at once.
        let clocks = if random.random_bool(0.1) { random.random_range(1..5) } else { 1 };
        (1..clocks).for_each(|_| wanted.tick());
        let before = if clocks > 1 {
            outputs.iter().map(|(signal, _)| wanted.value(*signal)).collect()
        } else {
            before
        };
        wanted.tick();
        found.run(clocks);
        for ((_, output), before) in outputs.iter().zip(before) {
            assert_eq!(
                found.sampled(*output),
                before,
                "{} cycle {cycle}: an output before the clock",
                netlist.name
            );
            compared += 1;
        }
    }
    compared
}

/// Half the time one of 0, 1, the largest, and both sides of the sign change.
fn corner_or_any(random: &mut Pcg64Mcg, width: u32) -> u128 {
    let mask = u128::MAX >> (128 - width);
    let half = 1 << (width - 1);
    let corners = [0, 1, mask, half, half - 1];
    if random.random() {
        corners[random.random_range(0..corners.len())]
    } else {
        random.random::<u128>() & mask
    }
}

#[test]
fn random_hierarchies() {
    let mut random = Pcg64Mcg::new(2);
    let mut compared = 0;
    for index in 0..40 {
        let netlist = random::module::hierarchy(&mut random, &format!("top{index}"));
        compared += compare(&netlist, &mut random, 100);
    }
    println!("{compared} values compared");
    assert!(compared > 1_000_000);
}

#[test]
fn registers_that_share_enables() {
    let mut random = Pcg64Mcg::new(3);
    let mut compared = 0;
    for _ in 0..100 {
        let netlist = common::enables::module(&mut random);
        compared += compare(&netlist, &mut random, 200);
    }
    println!("{compared} values compared");
    assert!(compared > 500_000);
}
