//! What a viewer reads back from a trace is what the simulator said.
#![allow(clippy::unwrap_used)] // a test may

use std::io::Cursor;
use std::sync::Arc;

use edgewalk_netlist::{BitBlocks, FstTrace, Labels, Module, Netlist, Simulator, Transitions, VcdTrace};

/// Two counters of different width, one inside an instance inside an instance, each with a ROM that follows it.
fn counters() -> Arc<Netlist> {
    let counter = |name: &str, width| {
        let m = Module::new(name, "");
        let step = m.input("step", 1);
        let count = m.reg("count", width).reset(0);
        count.when(step, count.q() + m.constant("ONE", width, 1));
        let rom = m.memory("rom", 3, 8, 6);
        (0..8).for_each(|row| _ = rom.holds(row as usize, row * row, "a square"));
        m.output("square", rom.read(step, count.q().trunc(3)));
        m.output("q", count);
        m.finish().unwrap()
    };
    let (small, large) = (counter("narrow", 3), counter("broad", 100));
    let m = Module::new("middle", "");
    let inner = m.instance("u_small", &small).connect("step", m.input("step", 1));
    m.output("q", inner.output("q"));
    let middle = m.finish().unwrap();
    let m = Module::new("top", "");
    let step = m.input("step", 1);
    let one = m.instance("u_middle", &middle).connect("step", step);
    let two = m.instance("u_large", &large).connect("step", !step);
    m.output("both", one.output("q").any() & two.output("q").bit(99));
    m.finish().unwrap()
}

const CYCLES: u64 = 40;

/// Runs the counters; `sample` sees every cycle. Returns what some signals were, by cycle.
fn run(mut sample: impl FnMut(&mut Simulator)) -> Vec<[u128; 4]> {
    let mut sim = Simulator::new(&counters());
    (0..CYCLES)
        .map(|cycle| {
            sim.set_input("rst", u128::from(cycle == 20)).unwrap();
            sim.set_input("step", u128::from(cycle % 3 != 0)).unwrap();
            sample(&mut sim);
            let values = WATCHED.map(|path| sim.get(path).unwrap());
            sim.tick();
            values
        })
        .collect()
}

/// Names for the values of the narrow counter; the last has none.
const LABELS: [Labels; 1] = [Labels {
    signal: "u_middle.u_small.count",
    names: &["none", "one", "two", "three", "four", "five", "six"],
}];

/// The name beside a signal: text, or a character a byte.
fn names(wave: &mut wellen::simple::Waveform, expected: &[[u128; 4]]) {
    let scopes = ["top", "u_middle", "u_small"];
    let variable = wave.hierarchy().lookup_var(&scopes, "count_name").expect("a name beside the count");
    let signal = wave.hierarchy()[variable].signal_ref();
    wave.load_signals(&[signal]);
    for (cycle, values) in expected.iter().enumerate() {
        let index = wave.time_table().partition_point(|time| *time <= cycle as u64 * 10 + 2) - 1;
        let signal = wave.get_signal(signal).unwrap();
        let value = signal.get_value_at(&signal.get_offset(index as u32).unwrap(), 0);
        let found = match value.to_bit_string() {
            Some(bits) => bits
                .as_bytes()
                .chunks(8)
                .map(|byte| u8::from_str_radix(std::str::from_utf8(byte).unwrap(), 2).unwrap() as char)
                .filter(|character| *character != '\0')
                .collect(),
            None => value.to_string(),
        };
        assert_eq!(found, *LABELS[0].names.get(values[1] as usize).unwrap_or(&"?"), "cycle {cycle}");
    }
    assert!(wave.hierarchy().lookup_var(&scopes, "ONE").is_none(), "a constant is no signal to watch");
    assert!(wave.hierarchy().lookup_var(&scopes, "count").is_some());
}

const WATCHED: [&str; 4] = ["step", "u_middle.u_small.count", "u_large.count", "u_middle.u_small.rom_q"];

fn check(file: Vec<u8>, expected: &[[u128; 4]]) {
    let mut wave = wellen::simple::read_from_reader(Cursor::new(file)).unwrap();
    let paths = WATCHED.map(|path| format!("top.{path}"));
    let mut compared = 0;
    for (column, path) in paths.iter().chain([&"top.clk".to_string()]).enumerate() {
        let parts: Vec<&str> = path.split('.').collect();
        let (name, scopes) = parts.split_last().unwrap();
        let variable = wave.hierarchy().lookup_var(scopes, *name).unwrap_or_else(|| panic!("no {path}"));
        let signal = wave.hierarchy()[variable].signal_ref();
        wave.load_signals(&[signal]);
        // The value in the middle of each half of a cycle.
        for half in 0..2 * CYCLES {
            let index = wave.time_table().partition_point(|time| *time <= half * 5 + 2) - 1;
            let signal = wave.get_signal(signal).unwrap();
            let offset = signal.get_offset(index as u32).unwrap();
            let bits = signal.get_value_at(&offset, 0).to_bit_string().unwrap();
            let found = u128::from_str_radix(&bits, 2).unwrap();
            let wanted = match expected[half as usize / 2].get(column) {
                Some(value) => *value,
                None => u128::from(half % 2 == 0), // clk
            };
            assert_eq!(found, wanted, "{path} at {} ns", half * 5 + 2);
            compared += 1;
        }
    }
    assert_eq!(compared, 5 * 2 * CYCLES);
    names(&mut wave, expected);
    assert_eq!(*wave.time_table().last().unwrap(), CYCLES * 10, "the last cycle has its length");
}

#[test]
fn vcd_reads_back() {
    let mut file = Vec::new();
    let mut trace = VcdTrace::new(Box::new(&mut file), &Simulator::new(&counters()), "top", &LABELS).unwrap();
    let expected = run(|sim| trace.sample(sim).unwrap());
    trace.finish().unwrap();
    assert!(String::from_utf8_lossy(&file).starts_with("$timescale 1 ns $end\n$scope module top $end\n"));
    check(file, &expected);
}

#[test]
fn fst_reads_back() {
    let mut file = Cursor::new(Vec::new());
    let mut trace = FstTrace::new(&mut file, &Simulator::new(&counters()), "top", &LABELS).unwrap();
    let expected = run(|sim| trace.sample(sim).unwrap());
    trace.finish().unwrap();
    check(file.into_inner(), &expected);
}

/// Times and transitions of one bit in a SAIF file: T0, T1, TC.
fn saif_net(text: &str, name: &str) -> [u64; 3] {
    let line = text.lines().find(|line| line.trim().starts_with(&format!("({name} "))).expect(name);
    ["T0", "T1", "TC"].map(|key| {
        let (_, rest) = line.split_once(&format!("({key} ")).expect("the key is in the entry");
        rest.split_once(')').expect("the key is closed").0.parse().expect("a number")
    })
}

#[test]
fn saif_counts_what_the_simulator_said() {
    let mut file = Vec::new();
    let mut trace = Transitions::new(&Simulator::new(&counters()), "top");
    let values = run(|sim| trace.sample(sim));
    trace.write_saif(&mut file).unwrap();
    let text = String::from_utf8(file).unwrap();
    assert!(text.contains("(DURATION 400)\n"), "{text}");
    assert_eq!(saif_net(&text, "clk"), [200, 200, 79]);
    let mut compared = 0;
    for (column, name, bits) in [(0, "step", 1), (3, "rom_q", 6)] {
        for bit in 0..bits {
            let waves: Vec<u128> = values.iter().map(|row| row[column] >> bit & 1).collect();
            let high = 10 * waves.iter().sum::<u128>() as u64;
            let changes = waves.windows(2).filter(|pair| pair[0] != pair[1]).count() as u64;
            let scope =
                if column == 3 { text.split_once("(INSTANCE u_small").expect("the scope").1 } else { &text };
            let name = if bits == 1 { name.to_owned() } else { format!("{name}\\[{bit}\\]") };
            assert_eq!(saif_net(scope, &name), [400 - high, high, changes], "{name}");
            compared += 1;
        }
    }
    assert_eq!(compared, 7);
    let units = trace.units();
    let names: Vec<&str> = units.iter().map(|unit| unit.unit.as_str()).collect();
    assert_eq!(names, ["", "u_large", "u_middle"]);
}

/// Samples until the next edge of a wave's cycles, as a run of [`BitBlocks`] handed them over.
struct Waves {
    names: Vec<String>,
    /// Of each name, a value a cycle.
    values: Vec<Vec<u128>>,
}

/// Runs a simulator under [`BitBlocks`], and reads each block at its end.
fn waves(sim: &mut Simulator, cycles: u32, mut cycle: impl FnMut(&mut Simulator, u32)) -> Waves {
    let mut blocks = BitBlocks::new(sim);
    let names: Vec<String> = blocks.names().keys().cloned().collect();
    let mut values = vec![Vec::new(); names.len()];
    for now in 0..cycles {
        cycle(sim, now);
        blocks.sample(sim);
        sim.tick();
        let (words, filled) = blocks.block();
        if filled == BitBlocks::CYCLES || now + 1 == cycles {
            for (values, place) in values.iter_mut().zip(blocks.names().values()) {
                values.extend((0..filled).map(|bit| u128::from(words[*place] >> bit & 1)));
            }
        }
    }
    Waves { names, values }
}

#[test]
fn blocks_have_the_values_of_signals_and_written_memories() {
    let m = Module::new("top", "");
    let count = m.reg("count", 4).reset(0);
    count.set(count.q() + m.constant("ONE", 4, 1));
    let memory = m.memory("ram", 2, 4, 4).starts(0);
    memory.write(count.q().bit(3), count.q().trunc(2), count.q());
    m.output("q", memory.read(m.lit(1, 1), count.q().trunc(2)));
    let mut sim = Simulator::new(&m.finish().unwrap());
    let mut seen = Vec::new();
    let waves = waves(&mut sim, 150, |sim, cycle| {
        sim.set_input("rst", u128::from(cycle % 67 == 0)).unwrap();
        let [count, q, rst] = ["count", "q", "rst"].map(|name| sim.get(name).unwrap());
        seen.push((count, q, rst, sim.memory("ram").unwrap().to_vec()));
    });
    let mut changes = 0;
    for (name, values) in waves.names.iter().zip(&waves.values) {
        let bit =
            |path: &str| name.strip_prefix(path)?.strip_prefix('[')?.strip_suffix(']').map(str::to_owned);
        let expected = |of: &dyn Fn(&(u128, u128, u128, Vec<u128>)) -> u128, bit: u32| {
            seen.iter().map(|row| of(row) >> bit & 1).collect::<Vec<_>>()
        };
        let expected = if let Some(place) = bit("ram") {
            let (word, bit) = place.split_once("][").unwrap();
            let word: usize = word.parse().unwrap();
            expected(&|row| row.3[word], bit.parse().unwrap())
        } else if let Some(bit) = bit("count") {
            expected(&|row| row.0, bit.parse().unwrap())
        } else if let Some(bit) = bit("q") {
            expected(&|row| row.1, bit.parse().unwrap())
        } else if name == "rst" {
            expected(&|row| row.2, 0)
        } else {
            continue;
        };
        assert_eq!(values, &expected, "{name}");
        changes += expected.windows(2).filter(|pair| pair[0] != pair[1]).count();
    }
    assert_eq!(waves.names.iter().filter(|name| name.starts_with("ram[")).count(), 16);
    assert!(changes > 500, "{changes} transitions");
}

/// A signal within instances is there by its path.
#[test]
fn blocks_name_bits_by_their_paths() {
    let values = std::cell::RefCell::new(Vec::new());
    let mut sim = Simulator::new(&counters());
    let waves = waves(&mut sim, 40, |sim, cycle| {
        sim.set_input("rst", u128::from(cycle == 0)).unwrap();
        sim.set_input("step", u128::from(cycle % 3 == 0)).unwrap();
        values.borrow_mut().push(sim.get("u_middle.u_small.rom_q").unwrap());
    });
    for bit in 0..6 {
        let name = format!("u_middle.u_small.rom_q[{bit}]");
        let place = waves.names.iter().position(|other| *other == name).expect(&name);
        let expected: Vec<u128> = values.borrow().iter().map(|value| value >> bit & 1).collect();
        assert_eq!(waves.values[place], expected, "{name}");
    }
}
