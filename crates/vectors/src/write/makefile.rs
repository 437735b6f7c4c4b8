//! `filelist.f` and `Makefile`: run from inside the directory, no path leaves it.

/// The files for a simulator, relative to the directory, test bench last.
#[must_use]
pub fn filelist(hdl: &[String]) -> String {
    let mut text = String::from("+incdir+.\n");
    for file in
        hdl.iter().map(String::as_str).chain(super::testbench::MODULES.map(|(name, _)| name)).chain(["tb.v"])
    {
        text.push_str(file);
        text.push('\n');
    }
    text
}

/// The Makefile; `top` is the module under test, `hdl` its files.
#[must_use]
pub fn makefile(top: &str, hdl: &[String]) -> String {
    MAKEFILE.replace("{top}", top).replace("{hdl}", &hdl.join(" "))
}

const MAKEFILE: &str = r"# Targets: icarus, verilator, lint, clean. Each fails unless the test bench prints PASS.
HDL = {hdl}
BENCH = bench_source.v bench_sink.v bench_change.v bench_memory.v tb.v
DATA = params.vh $(wildcard *.mem)

.PHONY: all icarus verilator lint clean
all: icarus verilator lint

icarus: tb.vvp
	vvp -n tb.vvp | tee icarus.log
	grep -qx PASS icarus.log

tb.vvp: filelist.f $(HDL) $(BENCH) $(DATA)
	iverilog -g2001 -o $@ -s tb -c filelist.f

verilator: obj_dir/Vtb
	./obj_dir/Vtb | tee verilator.log
	grep -qx PASS verilator.log

obj_dir/Vtb: filelist.f $(HDL) $(BENCH) $(DATA)
	verilator --binary --timing -O3 --top-module tb -f filelist.f

lint:
	verilator --lint-only -Wall --top-module {top} $(HDL)

clean:
	rm -rf obj_dir tb.vvp icarus.log verilator.log
";
