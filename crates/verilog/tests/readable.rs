//! What a reader sees, and that the tools take it.
#![allow(clippy::unwrap_used)] // a test may

mod tools;

use std::sync::Arc;

use edgewalk_netlist::{Module, Netlist, Signal};
use expect_test::expect_file;

/// An edge register pair: every kind of item in a small module.
fn dda() -> Arc<Netlist> {
    let m = Module::new("dda", "A value that steps by a slope.");
    m.doc("\nvalue Q8.14 LSB, slope Q8.14 LSB/px; the integer part is shown.\nTiming: load and step take effect at the end of the cycle.");
    let load = m.input("load", 1);
    let step = m.input("step", 1);
    let init = m.input_doc("init", 22, "Q8.14 LSB");
    let slope_in = m.input_doc("slope_in", 22, "Q8.14 LSB/px, two's complement");
    m.comment("The slope, held until the next load");
    let slope = m.reg("slope", 22).doc("Q8.14 LSB/px");
    slope.when(load, slope_in);
    m.comment("The value");
    let value = m.reg("value", 22).doc("Q8.14 LSB").reset(0);
    let next = (value.q() + slope.q()).named("next");
    value.when(load | step, load.mux(init, next));
    let falling = m.reg("falling", 1).doc("the slope is negative").reset(0);
    falling.when(load, slope_in.slt(0));
    m.output_doc("integer_part", value.q().slice(21, 14), "LSB");
    m.output("falling", falling);
    m.finish().unwrap()
}

/// Two of them with a memory and feedback between.
fn pair() -> Arc<Netlist> {
    let dda = dda();
    let m = Module::new("pair", "Two DDAs, one of them fed from a small memory.");
    let (load, init) = (m.input("load", 1), m.input("init", 22));
    let (write, addr) = (m.input("write", 1), m.input("addr", 3));
    let idle = m.constant("IDLE", 2, 0);
    let busy = m.constant("BUSY", 2, 1);
    let state = m.reg("state", 2).reset(0);
    m.comment("Slopes");
    let slopes = m.memory("slopes", 3, 8, 22).starts(0).doc("Q8.14 LSB/px").write(write, addr, init);
    let slope = slopes.read(!write, addr);
    m.comment("The two");
    let stop = m.wire("stop", 1).doc("the left one has passed the right");
    let is_busy = state.q().eq(busy).named("is_busy");
    let left = m.instance("u_left", &dda);
    left.connect("load", load)
        .connect("step", is_busy & !stop.q())
        .connect("init", init)
        .connect("slope_in", slope);
    let right = m.instance("u_right", &dda);
    right
        .connect("load", load)
        .connect("step", is_busy)
        .connect("init", -init)
        .connect("slope_in", slope.sar(1) + 3);
    let (l, r) = (left.output("integer_part"), right.output("integer_part"));
    stop.drive(l.ge(r) & left.output("falling"));
    state.when(load, busy).when(stop.q(), idle);
    m.comment("Out");
    m.output("stop", stop);
    m.output_doc("middle", (l.zext(9) + r.zext(9)).slice(8, 1), "LSB");
    m.output("furthest", l.gt(r).mux(l, r).any().mux(l.sext(12), r.sext(12)));
    m.finish().unwrap()
}

fn text(netlist: &Arc<Netlist>) -> String {
    edgewalk_verilog::print(netlist).last().unwrap().1.clone()
}

#[test]
fn a_small_module_reads_well() {
    expect_file!["snapshots/dda.v"].assert_eq(&text(&dda()));
    expect_file!["snapshots/pair.v"].assert_eq(&text(&pair()));
}

#[test]
fn a_memory_that_is_unknown_at_the_start_has_no_initial_block() {
    let of = |known: bool| {
        let m = Module::new("ram", "");
        let (write, addr) = (m.input("write", 1), m.input("addr", 3));
        let words = m.memory("words", 3, 8, 4).write(write, addr, m.input("data", 4));
        let words = if known { words.starts(9) } else { words };
        m.output("word", words.read(!write, addr));
        text(&m.finish().unwrap())
    };
    assert!(of(true).contains("words[words_index] = 4'd9;"), "{}", of(true));
    assert!(!of(false).contains("initial") && of(false).contains("reg [3:0] words [0:7];"), "{}", of(false));
}

/// A program of 284 words of 48 bits, as a microprogram has them, and a RAM of 128 words of which 46 are constants.
fn program() -> Arc<Netlist> {
    let m = Module::new("fetch", "A ROM, and a RAM with constant rows.");
    let (write, data) = (m.input("write", 1), m.input("data", 48));
    let (pc, row) = (m.input("pc", 9), m.input("row", 7));
    let rom = m.memory("words", 9, 284, 48).doc("word of the program");
    for address in 0..284 {
        let text = if address < 2 { ["load the first vertex", "subtract"][address] } else { "" };
        rom.holds(address, (address as u128 + 1) * 0x1234_5678_9abc % (1 << 48), text);
    }
    let ram = m.memory("rows", 7, 128, 48).write(write, row, data);
    (0..46).for_each(|row| _ = ram.holds(row, 1 << row, ""));
    m.output("word", rom.read(m.lit(1, 1), pc));
    m.output("value", ram.read(!write, row));
    m.finish().unwrap()
}

#[test]
fn contents_stand_row_by_row_with_their_words() {
    let text = text(&program());
    let wanted = [
        "  initial begin : words_init\n",
        "    words[0] = 48'h123456789abc;    // load the first vertex\n",
        "    words[1] = 48'h2468acf13578;    // subtract\n",
        "    rows[3] = 48'd8;\n",
    ];
    wanted.iter().for_each(|line| assert!(text.contains(line), "{line}\n{text}"));
    let rows = |name: &str| text.lines().filter(|line| line.trim().starts_with(&format!("{name}["))).count();
    assert_eq!((rows("words"), rows("rows")), (284, 46), "each row once, no other");
    assert!(!text.contains("integer"), "no loop where no word is like another\n{text}");
}

#[test]
fn a_rom_becomes_block_ram_with_its_contents() {
    let files = edgewalk_verilog::print(&program());
    let directory = tempfile::tempdir().unwrap();
    tools::write(directory.path(), &files);
    tools::lint(directory.path(), &files, "fetch", &[]);
    tools::run(directory.path(), "iverilog", &["-Wall", "-t", "null", "fetch.v"]);
    let script = "read_verilog fetch.v; synth_ice40 -top fetch; check -assert; stat; write_verilog cells.v";
    let report = tools::run(directory.path(), "yosys", &["-p", script]);
    let count = |cell: &str| {
        let line = report.lines().rev().find(|line| line.trim().starts_with(cell));
        line.and_then(|line| line.split_whitespace().last()?.parse::<u32>().ok()).unwrap_or(0)
    };
    // 512 words of 48 bits in blocks of 256 x 16, and three for the RAM; their outputs are the registers.
    assert_eq!((count("SB_RAM40_4K"), count("SB_DFF")), (6 + 3, 0), "{report}");
    let cells = std::fs::read_to_string(directory.path().join("cells.v")).unwrap();
    assert!(cells.contains("INIT_0(256'h"), "the blocks have their contents: {cells}");
}

#[test]
fn a_port_has_the_words_of_what_it_is_and_of_no_other() {
    let m = Module::new("two", "");
    let a = m.input("a", 1);
    m.output("own", m.reg("own", 1).doc("seen outside").set(a));
    m.output("other", m.reg("held", 1).doc("seen inside").set(a));
    m.output("sum", (!a).named_doc("sum", "a wire outside"));
    m.output("rest", (a ^ 1).named_doc("kept", "a wire inside"));
    let text = text(&m.finish().unwrap());
    let comments = |name: &str| {
        let lines = text.lines().filter(|line| line.contains(&format!(" {name}")) && line.contains("//"));
        lines.collect::<Vec<_>>()
    };
    let [own, other, held] = ["own", "other", "held"].map(comments);
    assert!(own.len() == 1 && own[0].contains("output") && own[0].ends_with("// seen outside"), "{text}");
    assert!(other.is_empty() && held.len() == 1 && held[0].ends_with("// seen inside"), "{text}");
    let [sum, rest, kept] = ["sum", "rest", "kept"].map(comments);
    assert!(sum.len() == 1 && sum[0].contains("output") && sum[0].ends_with("// a wire outside"), "{text}");
    assert!(rest.is_empty() && kept.len() == 1 && kept[0].ends_with("// a wire inside"), "{text}");
}

/// How many `always` blocks two registers have whose conditions were built one by one.
fn blocks(condition: impl for<'m> Fn(Signal<'m>, u32) -> Signal<'m>) -> usize {
    let m = Module::new("two", "");
    let a = m.input("a", 8);
    let conditions = [0, 1].map(|register| condition(a, register));
    for (name, condition) in ["one", "two"].into_iter().zip(conditions) {
        m.output(name, m.reg(name, 8).when(condition, a));
    }
    text(&m.finish().unwrap()).matches("always @").count()
}

#[test]
fn registers_with_the_same_condition_stand_in_one_block() {
    assert_eq!((blocks(|a, _| a.eq(5)), blocks(|a, register| a.eq(5 + u128::from(register)))), (1, 2));
    assert_eq!((blocks(|a, _| a.bit(1)), blocks(|a, register| a.bit(register))), (1, 2));
    // The same number in more bits is another constant.
    let number =
        |more| blocks(move |a, register| a.module().cat(&[a.module().lit(2 + more * register, 1), a]).all());
    assert_eq!([0, 1].map(number), [1, 2]);
    // Of more than five operators behind one another nobody sees that they are the same.
    let deep = |operators| blocks(|a, _| (1..operators).fold(a.any(), |bit, _| !bit));
    assert_eq!([4, 5, 6, 7].map(deep), [1, 1, 2, 2]);
}

#[test]
fn long_expressions_go_on_below_their_beginning_but_not_behind_the_middle_of_a_line() {
    let m = Module::new("choices", "");
    let bit = |name: &str| m.input(name, 1);
    let choose = |prefix: &str| {
        let conditions = [0, 1, 2].map(|i| bit(&format!("{prefix}_is_chosen_by_its_place_{i}")));
        conditions
            .into_iter()
            .fold(bit(&format!("{prefix}_otherwise")), |rest, condition| condition.mux(!condition, rest))
    };
    let long = "a_name_that_takes_more_than_half_of_what_a_line_holds_for_itself";
    m.output("short", choose("short"));
    m.output(long, choose("long"));
    let text = text(&m.finish().unwrap());
    let columns = |name: &str| {
        let mut lines = text.lines().skip_while(|line| !line.contains(&format!("assign {name} = ")));
        let first = lines.next().and_then(|line| line.find('='));
        (first, lines.map_while(|line| line.find(": ")).take(3).collect::<Vec<_>>())
    };
    assert_eq!(columns("short"), (Some(15), vec![15; 3]), "{text}");
    assert_eq!(columns(long), (Some(74), vec![50; 3]), "{text}");
}

#[test]
fn a_word_that_is_shifted_out_is_0() {
    let m = Module::new("shifted", "");
    let a = m.input("a", 8);
    m.output("kept", a.shl(7));
    m.output("gone", a.shl(8));
    m.output("gone_too", a.shr(9));
    let text = text(&m.finish().unwrap());
    let assigned =
        |name: &str| text.lines().find_map(|line| line.trim().strip_prefix(&format!("assign {name} = ")));
    let gone = Some("8'd0;");
    assert_eq!((assigned("gone"), assigned("gone_too")), (gone, gone), "{text}");
    assert_ne!(assigned("kept"), gone, "{text}");
}

#[test]
fn an_operator_that_says_nothing_is_not_written() {
    let m = Module::new("plain", "");
    let (a, bit, by) = (m.input("a", 8), m.input("b", 1), m.lit(3, 0));
    let (none, ones) = (m.lit(8, 0), m.lit(8, 255));
    let same = [a & ones, ones & a, a | none, none | a, a ^ none, none ^ a, a + none, none + a, a - none];
    let same =
        same.into_iter().chain([a.shl_by(by), a.shr_by(by), a.sar_by(by), a.shl(0), a.shr(0), a.sar(0)]);
    let same = same.chain([m.cat(&[a]), a.zext(8), a.sext(8), a.slice(7, 0), bit.mux(a, a)]);
    let same = same.chain([m.lit(1, 1).mux(a, none), m.lit(1, 0).mux(none, a)]);
    let bits = [bit.any(), bit.all(), bit.parity()];
    let constants = [(a & none, 0), (none & a, 0), (a | ones, 255), (ones + ones, 254), (a.shl(8), 0)];
    let certain = [(a.lt(none), 0), (a.ge(none), 1), (a.le(ones), 1), (a.gt(ones), 0), (none.gt(a), 0)];
    let ends = [(a.slt(0x80), 0), (a.sge(0x80), 1), (a.sle(0x7f), 1), (a.sgt(0x7f), 0)];
    // One beside the end is not certain.
    let open = [a.lt(1), a.gt(0xfe), a.slt(0x81), a.sgt(0x7e), a & 0xfe, a | 1];
    let mut wanted = Vec::new();
    let mut port = |signal: Signal<'_>, text: Option<String>| {
        let name = format!("y{}", wanted.len());
        m.output(&name, signal);
        wanted.push((name, text));
    };
    same.for_each(|signal| port(signal, Some("a".into())));
    bits.into_iter().for_each(|signal| port(signal, Some("b".into())));
    constants.into_iter().for_each(|(signal, value)| port(signal, Some(format!("8'd{value}"))));
    certain.into_iter().chain(ends).for_each(|(signal, value)| port(signal, Some(format!("1'b{value}"))));
    open.into_iter().for_each(|signal| port(signal, None));
    let text = text(&m.finish().unwrap());
    for (name, wanted) in wanted {
        let assign = format!("assign {name} = ");
        let found = text.lines().find_map(|line| line.trim().strip_prefix(&assign)?.split_once(';'));
        let found = found.map(|(expression, _)| expression.to_owned());
        match wanted {
            Some(_) => assert_eq!(found, wanted, "{name}\n{text}"),
            None => assert!(
                found.is_some_and(|found| found.contains("a ") || found.contains("(a)")),
                "{name}\n{text}"
            ),
        }
    }
}

#[test]
fn printing_is_deterministic() {
    assert_eq!(edgewalk_verilog::print(&pair()), edgewalk_verilog::print(&pair()));
}

#[test]
fn lint_is_silent_and_synthesis_passes() {
    let files = edgewalk_verilog::print(&pair());
    assert_eq!(files.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), ["dda.v", "pair.v"]);
    let directory = tempfile::tempdir().unwrap();
    tools::write(directory.path(), &files);
    tools::lint(directory.path(), &files, "pair", &[]);
    tools::run(directory.path(), "iverilog", &["-Wall", "-t", "null", "dda.v", "pair.v"]);
    let script = "read_verilog dda.v pair.v; synth_ice40 -top pair; check -assert; stat";
    let report = tools::run(directory.path(), "yosys", &["-p", script]);
    let cells = report.matches("SB_RAM40_4K").count();
    assert!(cells > 0, "the memory becomes block RAM:\n{report}");
}
