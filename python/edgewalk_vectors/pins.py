"""The ports of a design by the unit's names."""

import re
from difflib import get_close_matches

from .directory import VectorsError


class Place:
    """Where a value stands in a port of the design."""

    def __init__(self, port, lsb=0, width=None):
        self.port, self.lsb, self.width = port, lsb, width


class Wiring:
    """Which port of a design stands for which of the unit's.

    `widths` are the bits of the unit's ports by name, None where they are not known; `signed` the names of those in two's complement. `ports` says where
    they are in the design: `"name"`, `"name[high:low]"`, or None where the design has no such port. A name that ends in
    `*` stands for all that begin so: `{"span_*": "s_*"}`. `clk` and `rst` are among the names; `"!resetn"` is active low.
    """

    def __init__(self, widths, signed, ports=None):
        self.widths, self.signed = widths, signed
        self.clock, self.reset, self.active_low, self.reset_cycles = "clk", "rst", False, 3
        self.tie, self.absent, self.places = {}, set(), {}
        given = dict(ports or {})
        self.clock = given.pop("clk", self.clock)
        self.reset = given.pop("rst", self.reset)
        for name, port in [("clk", self.clock), ("rst", self.reset)]:
            if not isinstance(port, str):
                raise VectorsError(f"ports: {name} = {port!r}; permitted: the name of a port")
        if self.reset.startswith("!"):
            self.reset, self.active_low = self.reset[1:], True
        for key in given:
            if not any(matches(key, name) for name in widths):
                raise VectorsError(f"ports: {key}: {unknown(key, [*widths, 'clk', 'rst'])}")
        for name in widths:
            # The longest key is the one that says most.
            keys = sorted((key for key in given if matches(key, name)), key=lambda key: (key == name, len(key)))
            if keys:
                self._place(name, keys[-1], given[keys[-1]])

    def _place(self, name, key, value):
        if value is None:
            self.absent.add(name)
            return
        found = re.fullmatch(r"([A-Za-z_][\w$*]*)(?:\[(\d+)(?::(\d+))?\])?", value)
        if not found:
            raise VectorsError(f"ports: {key} = {value!r}; permitted: a name, name[bit], name[high:low], or None")
        port, high, low = found.groups()
        if key != name or key.endswith("*"):
            port = port.replace("*", name[len(key) - 1 :])
        if high is None:
            self.places[name] = Place(port)
            return
        low = high if low is None else low
        width = int(high) - int(low) + 1
        if self.widths[name] not in (None, width):
            raise VectorsError(f"ports: {key} = {value!r}: {width} bits; permitted: {self.widths[name]}")
        self.places[name] = Place(port, int(low), width)

    @classmethod
    def of_manifest(cls, manifest, ports=None):
        """The wiring of a directory: that of its design, or by `ports`."""
        links = [(channel["name"], channel["fields"]) for channel in manifest["channels"]]
        singles = manifest["status"]["fields"]
        fields = [field for _, of in links for field in of] + singles
        widths = {f"{name}_{end}": 1 for name, _ in links for end in ("valid", "ready")}
        widths.update((field["port"], field["width"]) for field in fields)
        widths.update((name, None) for name in manifest["constants"])
        widths.update((level["port"], 1) for level in manifest["side_inputs"])
        signed = {field["port"] for field in fields if field["signed"]}
        own = manifest.get("dut")
        if own and ports:
            raise VectorsError("ports: the directory was written with --dut, which says them; permitted: none")
        wiring = cls(widths, signed, ports)
        if own:
            wiring.clock, wiring.reset = own["clock"], own["reset"]["port"]
            wiring.active_low, wiring.reset_cycles = own["reset"]["active"] == "low", own["reset"]["cycles"]
            wiring.tie, wiring.absent = own["tie"], set(own["absent"])
            places = own["ports"].items()
            wiring.places = {name: Place(place["port"], place["lsb"], place["width"]) for name, place in places}
        return wiring

    def place(self, name):
        """Where the value of a port is; None where the design has not got it."""
        return None if name in self.absent else self.places.get(name) or Place(name)


def matches(key, name):
    """Whether a key of `ports` stands for the name."""
    return name.startswith(key[:-1]) if key.endswith("*") else key == name


def unknown(name, known):
    """What is said of a name that does not exist."""
    close = get_close_matches(name, known, 1, 0.0)
    return f"no such port; nearest: {close[0]}" if close else "no such port"


class Pins:
    """The ports of a design in a simulation; `outputs` are the names of those that are sampled."""

    def __init__(self, dut, wiring, inputs, outputs):
        self.dut, self.wiring = dut, wiring
        self.clock, self.reset = self._handle(wiring.clock), self._handle(wiring.reset)
        self.absent = [name for name in outputs if name in wiring.absent]
        self.outputs = [name for name in outputs if name not in wiring.absent]
        self.last = {}
        self.handles = {}
        for name in [*inputs, *self.outputs]:
            place = wiring.place(name)
            if place:
                self.handles[place.port] = self._handle(place.port)
                self._check(name, place, self.handles[place.port])

    def _handle(self, port):
        try:
            return getattr(self.dut, port)
        except AttributeError:
            known = [handle._name for handle in self.dut]
            raise VectorsError(f"{self.dut._name}: {port}: {unknown(port, known)}") from None

    def _check(self, name, place, handle):
        """A port has the bits that are read or written; a simulator would cut or extend them."""
        needed = self.wiring.widths.get(name)
        try:
            found = len(handle)
        except TypeError:
            found = 1
        end = place.lsb + (place.width or needed or found)
        exact = place.width is None and needed is not None
        if found < end or (exact and found != needed):
            raise VectorsError(f"{self.dut._name}: {place.port}: found {found} bits, needed {end} for {name}")

    def set_reset(self, on):
        """Holds the design in reset, or lets it go."""
        self.reset.value = int(bool(on) != self.wiring.active_low)

    def in_reset(self):
        """Whether the design is held in reset; a reset with unknown bits is taken for one."""
        return number(self.reset.value) != int(self.wiring.active_low)

    def tie_off(self):
        """Gives the inputs that hold one value this value."""
        for name, value in self.wiring.tie.items():
            self._handle(name).value = value

    def drive(self, inputs):
        """Writes the ports whose values changed."""
        ports = {}
        for name, value in inputs.items():
            place = self.wiring.place(name)
            if place is None:
                continue
            own = self.wiring.widths.get(name)
            if name in self.wiring.signed and place.width and value >> own - 1:
                value |= (1 << place.width) - (1 << own)
            ports[place.port] = ports.get(place.port, 0) | value << place.lsb
        for port, value in ports.items():
            if self.last.get(port) != value:
                self.handles[port].value = value
                self.last[port] = value

    def sample(self):
        """The outputs; None where a bit is unknown, or a wider port holds more than its value.

        A ready that the design has not got is 1.
        """
        words, outputs = {}, dict.fromkeys(self.absent, 1)
        for name in self.outputs:
            place = self.wiring.place(name)
            if place.port not in words:
                words[place.port] = number(self.handles[place.port].value)
            word = words[place.port]
            if word is not None and place.width:
                word = word >> place.lsb & (1 << place.width) - 1
                word = self._without_extension(name, word, place.width)
            outputs[name] = word
        return outputs

    def _without_extension(self, name, word, width):
        own = self.wiring.widths.get(name) or width
        low = word & (1 << own) - 1
        negative = name in self.wiring.signed and low >> own - 1
        above = (1 << width) - (1 << own) if negative else 0
        return low if word == low | above else None


def number(value):
    """A value of the simulator; None where a bit is unknown."""
    try:
        return int(value)
    except ValueError:
        return None
