//! `filelist.f` and `Makefile`: run from inside the directory, no path leaves it.

use super::rules;
use crate::dut::{Compare, Dut};

/// The design that a directory is for.
pub struct Sources<'a> {
    /// The unit's module, by which the rules are named.
    pub module: &'a str,
    /// The top module.
    pub top: &'a str,
    /// The design's files.
    pub hdl: Vec<String>,
    /// A user's design: what else is to be known of it.
    pub dut: Option<&'a Dut>,
    /// The modules of the test bench.
    pub modules: Vec<&'static str>,
}

impl Sources<'_> {
    /// The files for a simulator, relative to the directory, test bench last.
    pub fn filelist(&self) -> String {
        let include = self.dut.into_iter().flat_map(|dut| &dut.include);
        let include = include.map(|folder| format!("+incdir+{}", folder.display()));
        let bench = self.bench().into_iter().map(str::to_owned);
        let lines =
            ["+incdir+.".to_owned()].into_iter().chain(include).chain(self.hdl.iter().cloned()).chain(bench);
        lines.map(|line| line + "\n").collect()
    }

    /// The files of the test bench, itself last.
    pub(super) fn bench(&self) -> Vec<&'static str> {
        self.modules.iter().copied().chain(["tb.v"]).collect()
    }

    /// The Makefile; `mark` is what the lines of the test bench begin with.
    pub fn makefile(&self, mark: &str) -> String {
        let text = ["iverilog", "verilator"].iter().fold(MAKEFILE.to_owned(), |text, tool| {
            text.replace(&format!("{{{tool}}}"), edgewalk_tool::install(tool).unwrap_or_default())
        });
        let (head, timing, choice, defines) = match self.dut {
            None => (ANOTHER, CYCLES, CHOICE, "$(DEFINES) "),
            Some(_) => (OWN, "", "", ""),
        };
        text.replace("{head}", head)
            .replace("{timing}", timing)
            .replace("{choice}", choice)
            .replace("{defines}", defines)
            .replace("{standard}", self.dut.map_or("2001", Dut::standard))
            .replace("{include}", &listed(self.dut.map(include), |option| format!(" {option}")))
            .replace(
                "{how}",
                match self.dut.map(|dut| dut.compare) {
                    Some(Compare::Order) => "order and values count",
                    _ => "order, values, cycles and status ports count",
                },
            )
            .replace("{rules}", RULES)
            .replace("{rules_top}", &format!("{}_rules", self.module))
            .replace("{modules}", rules::MODULES)
            .replace("{outside}", rules::OUTSIDE)
            .replace("{bind}", rules::BIND)
            .replace("{top}", &word(self.top))
            .replace("{hdl}", &self.hdl.join(" "))
            .replace("{bench}", &self.bench().join(" "))
            .replace("{mark}", mark)
            // The last, as a text of a parameter can have any words.
            .replace("{parameters}", &listed(self.dut.map(parameters), |option| format!(" {}", word(option))))
    }
}

fn listed(options: Option<Vec<String>>, written: impl Fn(&String) -> String) -> String {
    options.iter().flatten().map(written).collect()
}

/// A text in a recipe: make takes `$` for its own, and the shell whatever is not between `'`.
fn word(text: &str) -> String {
    format!("'{}'", text.replace('\'', r"'\''").replace('$', "$$"))
}

/// Folders for include lines, as options of both simulators.
pub(super) fn include(dut: &Dut) -> Vec<String> {
    dut.include.iter().map(|folder| format!("-I{}", folder.display())).collect()
}

/// Parameters of the top module, as options of Verilator's lint.
pub(super) fn parameters(dut: &Dut) -> Vec<String> {
    dut.parameters.iter().map(|(name, value)| format!("-G{name}={value}")).collect()
}

/// The head of a Makefile for our own design.
const ANOTHER: &str = r#"#   make icarus HDL="mine.v other.v"   another design with the same ports: these files are compiled, and no other design
#   make icarus CHECK_CYCLES=0         a design with other timing: order and values count, its status ports are not needed
"#;

/// Of a user's design.
const OWN: &str = "# The design is wired to the test bench by its description; {how}.\n";

/// Whether cycles count can be chosen for a design with the ports of ours.
const CYCLES: &str = "CHECK_CYCLES = 1\n";
const CHOICE: &str = r"
ifeq ($(filter 0 1,$(CHECK_CYCLES)),)
$(error CHECK_CYCLES=$(CHECK_CYCLES): 0 or 1)
endif
DEFINES = $(if $(filter 0,$(CHECK_CYCLES)),-DORDER_ONLY)
";

/// Whether the rules of the channels look at the design.
const RULES: &str = r"
ifeq ($(filter 0 1,$(RULES)),)
$(error RULES=$(RULES): 0 or 1)
endif
OUTSIDE = $(if $(filter 1,$(RULES)),-s {rules_top} {modules} {outside})
BIND = $(if $(filter 1,$(RULES)),{modules} {bind})
";

const MAKEFILE: &str = r#"# Targets: icarus, verilator, lint, cocotb, clean. Each run fails unless the test bench prints PASS.
#   make icarus RULES=1                the rules of rules.v look at the design too: a broken one fails
#   make verilator SEED=2              registers and memories without a start value begin with other random bits
#   make cocotb PYTHON=venv/bin/python SIMULATOR=verilator   a Python that has the package edgewalk_vectors and cocotb
{head}HDL = {hdl}
BENCH = {bench}
{timing}RULES = 0
SEED = 1
SHA256SUM = sha256sum
PYTHON = python3
SIMULATOR = icarus
{choice}{rules}
# $(call needs,PROGRAM,HOW TO GET IT)
needs = @command -v $(firstword $(1)) >/dev/null || { echo "$(firstword $(1)) is not installed; $(2)" >&2; exit 3; }
# What the bench and the rules print begins with this mark.
MARK = {mark}
# $(call judge,LOG): shows what a run printed, as far as anybody reads it; the verdict is in the file. Lines without the mark
# are the design's and the simulator's: they are shown behind |, and decide nothing.
judge = @cat -v $(1) | sed -e "s/^/| /" -e "s/^.*$(MARK) //" || :; \
	grep -q "$(MARK) PASS$$" $(1) && ! grep -q "$(MARK) rule broken:" $(1)

.PHONY: all check icarus verilator lint cocotb clean
all: icarus verilator lint

# What the bench reads is what was written.
check:
	$(call needs,$(SHA256SUM),name another program: make SHA256SUM='shasum -a 256')
	@$(SHA256SUM) -c --quiet SHA256SUMS >&2

# Compiled anew each time: whatever HDL names may be older than what was compiled last.
icarus: check
	$(call needs,iverilog,try: {iverilog})
	$(call needs,vvp,try: {iverilog})
	@iverilog -g{standard} {defines}-I.{include} -o tb.vvp -s tb $(OUTSIDE) $(HDL) $(BENCH)
	@vvp -n tb.vvp >icarus.log 2>&1 || :
	$(call judge,icarus.log)

# Verilator knows by itself what need not be compiled again. A foreign file may lack `timescale, or draw warnings: lint is
# where they count. Verilator has no unknown bits: registers and memories without a start value begin with random ones.
verilator: check
	$(call needs,verilator,try: {verilator})
	@verilator --binary --timing -O3 -Wno-fatal --timescale 1ns/1ps {defines}--top-module tb{include} $(HDL) $(BENCH) $(BIND) >build.log 2>&1 \
		|| { cat build.log >&2; exit 1; }
	@grep "^%" build.log >&2 || :
	@./obj_dir/Vtb +verilator+rand+reset+2 +verilator+seed+$(SEED) >verilator.log 2>&1 || :
	$(call judge,verilator.log)

cocotb:
	$(call needs,$(PYTHON),name another one: make PYTHON=venv/bin/python)
	@$(PYTHON) -c "import edgewalk_vectors" 2>/dev/null \
		|| { echo "$(PYTHON) has no package edgewalk_vectors; try: pip install ./python, in the repository of edgewalk" >&2; exit 3; }
	@$(PYTHON) -m edgewalk_vectors "$(CURDIR)" --simulator $(SIMULATOR)

lint:
	$(call needs,verilator,try: {verilator})
	@verilator --lint-only -Wall{include}{parameters} --top-module {top} $(HDL)

clean:
	rm -rf obj_dir tb.vvp *.log
"#;
