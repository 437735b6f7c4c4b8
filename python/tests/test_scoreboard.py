"""The scoreboard without a simulator: what it must pass, and each single fault that it must find."""

import logging
import re

import pytest

import edgewalk
from conftest import SMALL
from edgewalk_vectors import Fault, Scoreboard, VectorsError
from test_pins import Dut

UNITS = ["machine", "setup", "edge", "span", "pixel", "depth"]


class Played:
    """A design in a simulation that stands still: each link fires in the cycles of the vectors."""

    def __init__(self, of_unit, design, names=lambda port: port):
        self.design, self.names = design(of_unit), names
        links = {channel["name"]: channel["fields"] for channel in of_unit.manifest["channels"]}
        widths = {f"{link}_{end}": 1 for link in links for end in ("valid", "ready")}
        widths.update((field["port"], field["width"]) for fields in links.values() for field in fields)
        self.dut = Dut(clk=1, rst=1, **{names(port): width for port, width in widths.items()})
        self.dut._log = logging.getLogger("played")
        self.links, self.cycles = list(links), of_unit.total_cycles

    def __getitem__(self, port):
        return getattr(self.dut, self.names(port))

    def run(self, board, spoil=None, until=None):
        for cycle in range(self.cycles if until is None else until):
            for link in self.links:
                fires = cycle in self.design.moves[link]
                self[f"{link}_valid"].value = self[f"{link}_ready"].value = int(fires)
                for port, value in self.design.token(link).items():
                    self[port].value = value
            if spoil:
                spoil(cycle, self)
            board.sample()
            self.design.clock(cycle)
        return board


def board(of_unit, played, unit, **more):
    constants = of_unit.manifest["constants"] or None
    return Scoreboard(played.dut, unit, edgewalk.Machine(keys=SMALL), constants=constants, **more)


@pytest.mark.parametrize("unit", UNITS)
def test_design_that_does_as_ours_passes(vectors, player, unit):
    of_unit, folder = vectors(unit)
    played = Played(of_unit, player)
    out = [channel["name"] for channel in of_unit.manifest["channels"] if channel["direction"] == "out"]
    tokens = sum(len(of_unit.tokens(link)) for link in out)
    assert played.run(board(of_unit, played, unit)).finish() == tokens > 10
    played = Played(of_unit, player)
    assert played.run(Scoreboard.of_directory(played.dut, folder)).finish() == tokens


def test_design_of_other_names_passes(vectors, player):
    of_unit, _ = vectors("pixel")
    played = Played(of_unit, player, lambda port: port.replace("frag_", "m_").replace("span_", "s_"))
    ports = {"frag_*": "m_*", "span_*": "s_*"}
    assert played.run(board(of_unit, played, "pixel", ports=ports)).finish() == len(of_unit.tokens("frag"))


def fails(vectors, player, spoil, said, unit="pixel", until=None, **more):
    of_unit, _ = vectors(unit)
    played = Played(of_unit, player)
    with pytest.raises(Fault) as raised:
        played.run(board(of_unit, played, unit, **more), spoil, until).finish()
    assert re.search(said, str(raised.value)), raised.value


def at(when, change):
    def spoil(cycle, played):
        if cycle == when:
            change(played)

    return spoil


def put(port, value):
    def change(played):
        played[port].value = value

    return change


def flip(port):
    def change(played):
        played[port].value ^= 1

    return change


def moves(vectors, unit, link, place):
    return int(vectors(unit)[0].cycles(link)[place])


@pytest.mark.parametrize("port", ["frag_addr", "frag_z", "frag_r", "frag_g", "frag_b", "frag_fence"])
def test_wrong_bit_of_each_field_fails(vectors, player, port):
    for place in [0, -1]:
        said = f"frag: token \\d+, cycle \\d+: {port}: expected \\w+, found \\w+"
        fails(vectors, player, at(moves(vectors, "pixel", "frag", place), flip(port)), said)


def test_faults_of_tokens_fail(vectors, player):
    first, last = moves(vectors, "pixel", "frag", 0), moves(vectors, "pixel", "frag", -1)
    fails(vectors, player, at(first, put("frag_valid", 0)), "frag: token 0, cycle \\d+: frag_z: expected")
    fails(vectors, player, at(last, put("frag_valid", 0)), "frag: token \\d+: never came, the first of 1$")
    fails(vectors, player, at(first, put("frag_r", "x")), "frag_r: expected \\w+, found unknown bits")
    fails(vectors, player, at(first, put("frag_valid", "x")), "frag: token 0, cycle \\d+: unknown bits in valid or ready")

    def again(played):
        played["frag_valid"].value = played["frag_ready"].value = 1

    of_unit, _ = vectors("pixel")
    quiet = next(c for c in range(last - 1, 0, -1) if c not in set(of_unit.cycles("frag").tolist()))
    fails(vectors, player, at(quiet, again), "frag: token \\d+, cycle \\d+: ")
    fails(vectors, player, None, "nothing was compared", until=2)


def test_token_too_many_is_told(vectors, player):
    of_unit, _ = vectors("pixel")
    played = Played(of_unit, player)
    scores = played.run(board(of_unit, played, "pixel"))
    played["frag_valid"].value = played["frag_ready"].value = 1
    scores.sample()
    with pytest.raises(Fault, match="one more than the model gives"):
        scores.finish()


def test_token_that_changes_while_it_waits_fails(vectors, player):
    of_unit, _ = vectors("pixel")
    frag = set(of_unit.cycles("frag").tolist())
    when = next(c for c in sorted(frag) if c - 1 not in frag)
    said = "the token changed, or valid fell, before it was taken"

    def waits(wrong):
        def spoil(cycle, played):
            if cycle == when - 1:
                played["frag_valid"].value = 1
                if wrong:
                    played["frag_g"].value ^= 1

        return spoil

    fails(vectors, player, waits(True), said)
    played = Played(of_unit, player)
    assert played.run(board(of_unit, played, "pixel"), waits(False)).finish() == len(frag)


def test_inputs_with_unknown_bits_fail(vectors, player):
    when = moves(vectors, "pixel", "span", 1)
    fails(vectors, player, at(when, put("span_z", "x")), "span: cycle \\d+: span_z: the design took unknown bits")
    fails(vectors, player, at(when, put("span_ready", "x")), "span: cycle \\d+: unknown bits in valid or ready")


def test_reset_begins_anew(vectors, player):
    of_unit, _ = vectors("pixel")
    played = Played(of_unit, player)
    scores = board(of_unit, played, "pixel")
    half = moves(vectors, "pixel", "frag", 9) + 1
    played.run(scores, until=half)
    # A token that waits is gone after the reset.
    played["frag_valid"].value, played["frag_ready"].value, played["span_valid"].value = 1, 0, 0
    scores.sample()
    played.dut.rst.value = 1
    scores.sample()
    played.dut.rst.value = 0
    played.design = player(of_unit)
    assert played.run(scores).finish() == len(of_unit.tokens("frag")) + 10


def test_design_gives_before_it_takes(vectors, player):
    """As EDGE behind a sequenced SETUP: its last token comes while the span is still offered."""
    of_unit, _ = vectors("pixel")
    frag, span = of_unit.cycles("frag"), of_unit.cycles("span")
    # The first span with its fragments; the span is taken behind them.
    count = int(of_unit.tokens("span")["span_count"][0])
    played = Played(of_unit, player)
    scores = board(of_unit, played, "pixel")
    for link in played.links:
        played[f"{link}_valid"].value = played[f"{link}_ready"].value = 0
    for port, value in played.design.token("span").items():
        played[port].value = value
    for place in range(count):
        played.design.place["frag"] = place
        for port, value in played.design.token("frag").items():
            played[port].value = value
        played["span_valid"].value = played["frag_valid"].value = played["frag_ready"].value = 1
        scores.sample()
    played["frag_valid"].value, played["span_ready"].value = 0, 1
    scores.sample()
    assert scores.finish() == count and scores.taken == 1 and len(frag) > count and len(span) > 1


def test_memory_of_another_content_is_found(vectors, player):
    of_unit, _ = vectors("depth")
    fails(vectors, player, None, "wr: token \\d+", unit="depth", clear={"depth": 0})


def test_channels_that_do_not_exist_are_refused(vectors, player):
    of_unit, _ = vectors("depth")
    played = Played(of_unit, player)
    with pytest.raises(VectorsError, match="channels: frag; permitted: rd, wr"):
        board(of_unit, played, "depth", channels=["frag"])
    scores = played.run(board(of_unit, played, "depth", channels=["wr"]))
    assert scores.finish() == len(of_unit.tokens("wr"))
