"""The bench of a directory as a test of cocotb, 1.9 or 2."""

from .bench import Bench
from .directory import Directory


class Pins:
    """The ports of a design by the unit's names."""

    def __init__(self, dut, directory):
        manifest = directory.manifest
        own = manifest.get("dut")
        self.dut = dut
        self.clock = getattr(dut, own["clock"] if own else "clk")
        self.reset = getattr(dut, own["reset"]["port"] if own else "rst")
        self.active = 0 if own and own["reset"]["active"] == "low" else 1
        self.cycles = own["reset"]["cycles"] if own else 3
        self.tie = own["tie"] if own else {}
        self.absent = set(own["absent"]) if own else set()
        self.places = own["ports"] if own else {}
        fields = [field for channel in manifest["channels"] for field in channel["fields"]]
        self.signed = {field["port"]: field["width"] for field in fields if field["signed"]}
        self.widths = {field["port"]: field["width"] for field in fields}
        outputs = [f"{c['name']}_{'valid' if c['direction'] == 'out' else 'ready'}" for c in manifest["channels"]]
        of_out = [field["port"] for c in manifest["channels"] if c["direction"] == "out" for field in c["fields"]]
        by_cycle = not own or own["compare"] == "cycle"
        status = [field["port"] for field in manifest["status"]["fields"]] if by_cycle else []
        self.outputs = dict.fromkeys(name for name in outputs + of_out + status if name not in self.absent)
        self.ready_always = [name for name in outputs if name in self.absent]
        self.last = {}

    def set_reset(self, on):
        self.reset.value = self.active if on else 1 - self.active

    def tie_off(self):
        for name, value in self.tie.items():
            getattr(self.dut, name).value = value

    def drive(self, inputs):
        """Writes the ports whose values changed."""
        ports = {}
        for name, value in inputs.items():
            if name in self.absent:
                continue
            place = self.places.get(name)
            if place is None:
                ports[name] = value
                continue
            width = self.signed.get(name)
            if width and value >> width - 1:
                value |= (1 << place["width"]) - (1 << width)
            ports[place["port"]] = ports.get(place["port"], 0) | value << place["lsb"]
        for port, value in ports.items():
            if self.last.get(port) != value:
                getattr(self.dut, port).value = value
                self.last[port] = value

    def sample(self):
        """The outputs; None where a bit is unknown, or a wider port holds more than its value."""
        words, outputs = {}, dict.fromkeys(self.ready_always, 1)
        for name in self.outputs:
            place = self.places.get(name) or {"port": name, "lsb": 0, "width": None}
            port = place["port"]
            if port not in words:
                words[port] = number(getattr(self.dut, port).value)
            word = words[port]
            if word is not None and place["width"]:
                word = word >> place["lsb"] & (1 << place["width"]) - 1
                word = self.without_extension(name, word, place["width"])
            outputs[name] = word
        return outputs

    def without_extension(self, name, word, width):
        own = self.widths.get(name, width)
        low = word & (1 << own) - 1
        negative = name in self.signed and low >> own - 1
        above = (1 << width) - (1 << own) if negative else 0
        return low if word == low | above else None


def number(value):
    """A value of the simulator; None where a bit is unknown."""
    try:
        return int(value)
    except ValueError:
        return None


def replay(directory):
    """The test that replays a directory of vectors: `test = replay("out/v/hazards_pixel")`."""
    import cocotb
    from cocotb.triggers import Timer

    vectors = Directory(directory)

    async def run(dut):
        bench, pins = Bench(vectors), Pins(dut, vectors)
        pins.clock.value = 0
        pins.set_reset(True)
        pins.tie_off()
        pins.drive(dict.fromkeys(bench.drive(), 0))

        async def edge():
            """The rising edge; inputs change behind it."""
            pins.clock.value = 1
            await Timer(5, "ns")
            pins.clock.value = 0

        for _ in range(pins.cycles):
            await Timer(5, "ns")
            await edge()
        pins.set_reset(False)
        going = True
        while going:
            pins.drive(bench.drive())
            await Timer(5, "ns")
            going = bench.sample(pins.sample())
            await edge()
        checked = bench.finish()
        dut._log.info("checked %d / %d", checked, bench.expected)

    run.__name__ = run.__qualname__ = vectors.path.name.replace("-", "_")
    return cocotb.test()(run)
