"""Ports of a design by the unit's names, without a simulator."""

import pytest

from edgewalk_vectors import Directory, VectorsError, Wiring
from edgewalk_vectors.pins import Pins, number


class Handle:
    """A port of some bits; unknown bits are x."""

    def __init__(self, name, width, value=0):
        self._name, self.width, self.value = name, width, value

    def __len__(self):
        return self.width


class Dut:
    """A design with these ports, name and bits."""

    _name = "mine"

    def __init__(self, **ports):
        for name, width in ports.items():
            setattr(self, name, Handle(name, width))

    def __iter__(self):
        return (handle for handle in vars(self).values())


WIDTHS = {"a_valid": 1, "a_ready": 1, "a_x": 6, "a_y": 4, "mode": None}


def pins(dut, ports=None, inputs=("a_ready", "mode"), outputs=("a_valid", "a_x", "a_y")):
    return Pins(dut, Wiring(WIDTHS, {"a_x"}, ports), inputs, outputs)


def test_ports_have_other_names_and_places():
    dut = Dut(aclk=1, nrst=1, s_valid=1, s_ready=1, s_data=10, mode=3)
    of = pins(dut, {"clk": "aclk", "rst": "!nrst", "a_*": "s_*", "a_x": "s_data[9:4]", "a_y": "s_data[3:0]"})
    assert of.clock is dut.aclk
    of.set_reset(True)
    assert dut.nrst.value == 0 and of.in_reset()
    of.set_reset(False)
    assert dut.nrst.value == 1 and not of.in_reset()
    dut.s_data.value, dut.s_valid.value = 0b1010010011, 1
    assert of.sample() == {"a_valid": 1, "a_x": 0b101001, "a_y": 0b0011}
    of.drive({"a_ready": 1, "mode": 5})
    assert (dut.s_ready.value, dut.mode.value) == (1, 5)


def test_reset_with_unknown_bits_is_a_reset():
    dut = Dut(clk=1, rst=1, a_valid=1, a_ready=1, a_x=6, a_y=4, mode=3)
    of = pins(dut)
    dut.rst.value = "x"
    assert number("x") is None and number("101") == 101 and of.in_reset()


def test_signed_value_is_extended_both_ways():
    dut = Dut(clk=1, rst=1, a_valid=1, a_ready=1, a_x=8, a_y=4, mode=3)
    wiring = Wiring(WIDTHS, {"a_x"})
    wiring.places["a_x"] = type("Place", (), {"port": "a_x", "lsb": 0, "width": 8})()
    of = Pins(dut, wiring, ["a_x"], ["a_x"])
    of.drive({"a_x": 0b100000})
    assert dut.a_x.value == 0b11100000
    assert of.sample()["a_x"] == 0b100000
    for wrong in [0b00100000, 0b01100000, 0b11000001]:
        dut.a_x.value = wrong
        assert of.sample()["a_x"] is None, "more than the value extended"
    dut.a_x.value = 0b00011111
    assert of.sample()["a_x"] == 0b011111


def test_absent_output_is_not_sampled_and_absent_ready_is_1():
    dut = Dut(clk=1, rst=1, a_valid=1, a_x=6, mode=3)
    of = pins(dut, {"a_ready": None, "a_y": None}, ["mode"], ["a_valid", "a_ready", "a_x", "a_y"])
    assert of.sample() == {"a_valid": 0, "a_ready": 1, "a_x": 0, "a_y": 1}
    of.drive({"a_ready": 1, "mode": 1})


REFUSED = [
    ({"a_z": "z"}, "ports: a_z: no such port; nearest: a_"),
    ({"b_*": "z_*"}, "ports: b_\\*: no such port; nearest: "),
    ({"a_x": "x["}, "ports: a_x = 'x\\['; permitted: a name, name\\[bit\\], name\\[high:low\\], or None"),
    ({"a_x": "s[4:0]"}, "ports: a_x = 's\\[4:0\\]': 5 bits; permitted: 6"),
    ({"rst": None}, "ports: rst = None; permitted: the name of a port"),
    ({"a_x": "wide"}, "mine: wide: found 8 bits, needed 6 for a_x"),
    ({"a_x": "narrow"}, "mine: narrow: found 3 bits, needed 6 for a_x"),
    ({"a_x": "narrow[5:0]"}, "mine: narrow: found 3 bits, needed 6 for a_x"),
    ({"a_x": "widee"}, "mine: widee: no such port; nearest: wide"),
    ({"clk": "clock"}, "mine: clock: no such port; nearest: clk"),
]


@pytest.mark.parametrize("ports, said", REFUSED)
def test_ports_that_are_not_there_are_refused(ports, said):
    dut = Dut(clk=1, rst=1, a_valid=1, a_ready=1, a_x=6, a_y=4, mode=3, wide=8, narrow=3)
    with pytest.raises(VectorsError, match=said):
        pins(dut, ports)


def test_manifest_says_the_wiring(vectors):
    of_unit, folder = vectors("pixel")
    manifest = Directory(folder).manifest
    wiring = Wiring.of_manifest(manifest, {"frag_*": "m_*", "rst": "!n"})
    assert (wiring.clock, wiring.reset, wiring.active_low, wiring.reset_cycles) == ("clk", "n", True, 3)
    assert wiring.place("frag_z").port == "m_z" and wiring.place("span_x").port == "span_x"
    own = {
        "clock": "c", "reset": {"port": "r", "active": "low", "cycles": 7}, "tie": {"t": 1}, "absent": ["frag_b"],
        "ports": {"frag_z": {"port": "d", "lsb": 3, "width": 8}},
    }
    wiring = Wiring.of_manifest({**manifest, "dut": own})
    assert (wiring.clock, wiring.reset, wiring.active_low, wiring.reset_cycles, wiring.tie) == ("c", "r", True, 7, {"t": 1})
    place = wiring.place("frag_z")
    assert (place.port, place.lsb, place.width) == ("d", 3, 8) and wiring.place("frag_b") is None
    with pytest.raises(VectorsError, match="written with --dut"):
        Wiring.of_manifest({**manifest, "dut": own}, {"frag_z": "z"})
