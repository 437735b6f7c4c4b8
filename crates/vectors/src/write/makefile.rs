//! `filelist.f` and `Makefile`: run from inside the directory, no path leaves it.

/// The files for a simulator, relative to the directory, test bench last.
#[must_use]
pub fn filelist(hdl: &[String]) -> String {
    let mut text = String::from("+incdir+.\n");
    for file in hdl.iter().cloned().chain(bench().map(str::to_owned)) {
        text.push_str(&file);
        text.push('\n');
    }
    text
}

/// The files of the test bench, itself last.
fn bench() -> impl Iterator<Item = &'static str> {
    super::testbench::MODULES.into_iter().map(|(name, _)| name).chain(["tb.v"])
}

/// The Makefile; `top` is the module under test, `hdl` its files.
#[must_use]
pub fn makefile(top: &str, hdl: &[String]) -> String {
    let bench: Vec<&str> = bench().collect();
    let text = ["iverilog", "verilator"].iter().fold(MAKEFILE.to_owned(), |text, tool| {
        text.replace(&format!("{{{tool}}}"), edgewalk_tool::install(tool).unwrap_or_default())
    });
    text.replace("{top}", top).replace("{hdl}", &hdl.join(" ")).replace("{bench}", &bench.join(" "))
}

const MAKEFILE: &str = r#"# Targets: icarus, verilator, lint, clean. Each run fails unless the test bench prints PASS.
#   make icarus HDL="mine.v other.v"   another design with the same ports: these files are compiled, and no other design
#   make icarus CHECK_CYCLES=0         a design with other timing: order and values count, its status ports are not needed
HDL = {hdl}
BENCH = {bench}
CHECK_CYCLES = 1
SHA256SUM = sha256sum

ifeq ($(filter 0 1,$(CHECK_CYCLES)),)
$(error CHECK_CYCLES=$(CHECK_CYCLES): 0 or 1)
endif
DEFINES = $(if $(filter 0,$(CHECK_CYCLES)),-DORDER_ONLY)

# $(call needs,PROGRAM,HOW TO GET IT)
needs = @command -v $(firstword $(1)) >/dev/null || { echo "$(firstword $(1)) is not installed; $(2)" >&2; exit 3; }
# $(call judge,LOG): shows what a run printed, as far as anybody reads it; the verdict is in the file.
judge = @cat $(1) || :; grep -qx PASS $(1)

.PHONY: all check icarus verilator lint clean
all: icarus verilator lint

# What the bench reads is what was written.
check:
	$(call needs,$(SHA256SUM),name another program: make SHA256SUM='shasum -a 256')
	@$(SHA256SUM) -c --quiet SHA256SUMS >&2

# Compiled anew each time: whatever HDL names may be older than what was compiled last.
icarus: check
	$(call needs,iverilog,try: {iverilog})
	$(call needs,vvp,try: {iverilog})
	@iverilog -g2001 $(DEFINES) -I. -o tb.vvp -s tb $(HDL) $(BENCH)
	@vvp -n tb.vvp >icarus.log 2>&1 || :
	$(call judge,icarus.log)

# Verilator knows by itself what need not be compiled again. A foreign file may lack `timescale, or draw warnings: lint is
# where they count.
verilator: check
	$(call needs,verilator,try: {verilator})
	@verilator --binary --timing -O3 -Wno-fatal --timescale 1ns/1ps $(DEFINES) --top-module tb $(HDL) $(BENCH) >build.log 2>&1 \
		|| { cat build.log >&2; exit 1; }
	@grep "^%" build.log >&2 || :
	@./obj_dir/Vtb >verilator.log 2>&1 || :
	$(call judge,verilator.log)

lint:
	$(call needs,verilator,try: {verilator})
	@verilator --lint-only -Wall --top-module {top} $(HDL)

clean:
	rm -rf obj_dir tb.vvp *.log
"#;
