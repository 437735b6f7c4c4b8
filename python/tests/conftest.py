"""Designs for the tests of `edgewalk_vectors` that need no simulator. Run by tests/python."""

import sys
from pathlib import Path

import pytest

import edgewalk

sys.path.insert(0, str(Path(__file__).parents[1]))

SMALL = {"screen.width": 24, "screen.height": 20, "formats.z_bits": 8, "formats.color_bits": 4}


@pytest.fixture(scope="session")
def vectors(tmp_path_factory):
    """Vectors of a unit, and their directory: the first cases of the suite, as all would take longer."""
    made = {}
    machine = edgewalk.Machine(keys=SMALL)
    cases = edgewalk.vectors(machine, unit="pixel").manifest["suite"]["cases"]
    first = [case["name"] for case in cases[:4]]

    def of(unit):
        if unit not in made:
            of_unit = edgewalk.vectors(machine, unit=unit, only=first)
            folder = tmp_path_factory.mktemp("vectors") / of_unit.name
            of_unit.write(folder)
            made[unit] = (of_unit, folder)
        return made[unit]

    return of


class Player:
    """A design that does, cycle for cycle, what the vectors say that ours does."""

    def __init__(self, vectors):
        self.vectors = vectors
        channels = vectors.manifest["channels"]
        self.ins = [channel["name"] for channel in channels if channel["direction"] == "in"]
        self.outs = [channel["name"] for channel in channels if channel["direction"] == "out"]
        self.tokens = {name: vectors.tokens(name) for name in vectors.links}
        self.moves = {name: set(vectors.cycles(name).tolist()) for name in vectors.links}
        self.place = dict.fromkeys(vectors.links, 0)
        self.widths = {field["port"]: field["width"] for channel in channels for field in channel["fields"]}
        self.status = vectors.status
        self.changes = {int(cycle): place for place, cycle in enumerate(self.status["cycle"])}
        self.shown = 0

    def token(self, link):
        """The next token of a link as bits."""
        tokens = self.tokens[link]
        row = tokens[min(self.place[link], len(tokens) - 1)]
        return {name: int(row[name]) & (1 << self.widths[name]) - 1 for name in tokens.dtype.names}

    def outputs(self, cycle):
        """What the design shows in a cycle."""
        self.shown = self.changes.get(cycle, self.shown)
        status = self.status[self.shown]
        shown = {name: int(status[name]) for name in self.status.dtype.names if name != "cycle"}
        for link in self.ins:
            shown.setdefault(f"{link}_ready", int(cycle in self.moves[link]))
        for link in self.outs:
            shown.update(self.token(link))
        return shown

    def clock(self, cycle):
        """The clock's edge behind a cycle."""
        for link in self.vectors.links:
            self.place[link] += cycle in self.moves[link]


@pytest.fixture
def player():
    """A new design for these vectors."""
    return Player
