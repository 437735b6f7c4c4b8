"""A scoreboard under cocotb, 1.9 or 2: the tokens of a design beside those of the live model."""

from .bench import SHOWN, Fault, Offered
from .directory import Directory, VectorsError
from .pins import Pins, Wiring


class Out:
    """A channel out: its tokens beside the model's, in order."""

    def __init__(self, name, widths):
        self.name, self.widths, self.held = name, widths, Offered()
        self.fields = list(widths)
        self.came, self.faults = 0, []

    def sample(self, cycle, outputs, wanted_of):
        """Takes what stands at the channel's ports before the clock's edge; `wanted_of` gives the model's next token."""
        valid, ready = outputs[f"{self.name}_valid"], outputs[f"{self.name}_ready"]
        token = {field: outputs[field] for field in self.fields}
        if self.held.broken(valid, token, ready != 0):
            self.tell(cycle, "the token changed, or valid fell, before it was taken")
        if valid == 0 or ready == 0:
            return
        if valid is None or ready is None:
            self.tell(cycle, "unknown bits in valid or ready")
        wanted = wanted_of(self.name)
        if wanted is None:
            self.tell(cycle, "one more than the model gives")
            return
        for field in self.fields:
            bits = wanted[field] & (1 << self.widths[field]) - 1
            if token[field] != bits:
                found = "unknown bits" if token[field] is None else f"{token[field]:x}"
                self.tell(cycle, f"{field}: expected {bits:x}, found {found}")
        self.came += 1

    def tell(self, cycle, what):
        """Keeps a fault."""
        self.faults.append(f"{self.name}: token {self.came}, cycle {cycle}: {what}")


class Scoreboard:
    """Compares what a design gives with what the model gives for the tokens that the design took.

        board = Scoreboard(dut, "pixel", edgewalk.Machine("small"))
        board.start()
        ...            # the test drives the design as it likes
        board.finish() # raises Fault, or returns how many tokens were compared

    Values and order count, cycles do not. `unit` is a unit of the machine, or "machine". `ports` says which ports of the
    design stand for those of the unit: see `Wiring`. `constants`, `memories` and `clear` are those of `edgewalk.Live`: the
    model has memories of its own. `channels` are the channels out that are compared; all of them if left out.

    Ports are sampled at the falling edge of the clock: whatever drives the design changes its inputs behind the rising
    edge. A reset begins anew.
    """

    def __init__(
        self, dut, unit, machine=None, *, ports=None, constants=None, memories=None, clear=None, channels=None
    ):
        try:
            import edgewalk
        except ImportError:
            raise VectorsError("the module edgewalk is not installed; try: pip install ./crates/python") from None
        self._model = lambda: edgewalk.Live(unit, machine, constants=constants, memories=memories, clear=clear)
        live = self._model()
        links = live.ports
        widths = {f"{name}_{end}": 1 for name in links for end in ("valid", "ready")}
        widths.update((port, width) for of in links.values() for port, width, _ in of)
        signed = {port for of in links.values() for port, _, signed in of if signed}
        self._begin(dut, live, Wiring(widths, signed, ports), channels)

    @classmethod
    def of_directory(cls, dut, directory, channels=None):
        """For the design, the machine, the constants and the memories of a directory of vectors."""
        import edgewalk

        vectors = Directory(directory)
        manifest = vectors.manifest
        machine = edgewalk.Machine(keys=manifest["machine"]["settings"])
        memories = {of["name"]: vectors.numbers(of["start"]) for of in manifest["memories"] if of.get("start")}
        clear = {of["name"]: int(of["clear"], 16) for of in manifest["memories"]}
        board = cls.__new__(cls)
        board._model = lambda: edgewalk.Live(
            manifest["unit"], machine, constants=manifest["constants"], memories=memories, clear=clear
        )
        board._begin(dut, board._model(), Wiring.of_manifest(manifest), channels)
        return board

    def _begin(self, dut, live, wiring, channels):
        wanted = list(live.gives if channels is None else channels)
        for name in wanted:
            if name not in live.gives:
                raise VectorsError(f"channels: {name}; permitted: {', '.join(live.gives)}")
        self.takes, self.fields = live.takes, [port for port, _, _ in live.ports[live.takes]]
        there = {name: {p: w for p, w, _ in live.ports[name] if p not in wiring.absent} for name in wanted}
        self.outs = [Out(name, widths) for name, widths in there.items()]
        self.log, self.absent = dut._log, wiring.absent
        read = [f"{name}_{end}" for name in [self.takes, *wanted] for end in ("valid", "ready")]
        read += [field for field in self.fields if field not in wiring.absent]
        read += [field for out in self.outs for field in out.fields]
        self.pins = Pins(dut, wiring, [], read)
        self.live, self.cycle, self.faults = live, 0, []
        # Tokens taken, the one that is offered, and whether the model has that one already.
        self.taken, self.offered, self.early = 0, None, False

    def start(self):
        """Watches the design from now on."""
        import cocotb

        return cocotb.start_soon(self._watch())

    async def _watch(self):
        from cocotb.triggers import FallingEdge, ReadOnly

        while True:
            await FallingEdge(self.pins.clock)
            await ReadOnly()
            self.sample()

    def sample(self):
        """Takes a cycle, from the values that stand before its clock edge. `start` does so by itself."""
        if self.pins.in_reset():
            for out in self.outs:
                out.held = Offered()
            if self.taken or self.early:
                self.live, self.taken = self._model(), 0
            self.offered, self.early = None, False
            return
        outputs = self.pins.sample()
        valid, ready = outputs[f"{self.takes}_valid"], outputs[f"{self.takes}_ready"]
        self.offered = None
        if valid is None or ready is None:
            self.faults.append(f"{self.takes}: cycle {self.cycle}: unknown bits in valid or ready")
        elif valid:
            # A field that the design has not got is 0.
            self.offered = {field: 0 if field in self.absent else outputs[field] for field in self.fields}
            if ready:
                self._take()
        for out in self.outs:
            out.sample(self.cycle, outputs, self._wanted)
        self.cycle += 1

    def _take(self):
        """The design takes the token that is offered."""
        unknown = [field for field, value in self.offered.items() if value is None]
        if unknown:
            self.faults.append(f"{self.takes}: cycle {self.cycle}: {unknown[0]}: the design took unknown bits")
        elif not self.early:
            self.live.give(self.offered)
        self.taken += 1
        self.offered, self.early = None, False

    def _wanted(self, name):
        """The next token of a channel. A design may give what follows from a token before it takes it, as EDGE does."""
        wanted = self.live.next(name)
        if wanted is None and self.offered and not self.early and None not in self.offered.values():
            self.live.give(self.offered)
            self.early = True
            wanted = self.live.next(name)
        return wanted

    @property
    def checked(self):
        """Tokens that were compared."""
        return sum(out.came for out in self.outs)

    def finish(self):
        """Raises `Fault` unless all that the model gives came, as it gives it, and nothing else; returns `checked`."""
        told = self.faults[:SHOWN]
        rest = self.live.rest()
        for out in self.outs:
            told += out.faults[:SHOWN]
            if rest[out.name]:
                told.append(f"{out.name}: token {out.came}: never came, the first of {rest[out.name]}")
        if self.checked == 0:
            told.append("nothing was compared")
        if told:
            raise Fault("\n".join(told))
        self.log.info("scoreboard: %d tokens compared", self.checked)
        return self.checked
