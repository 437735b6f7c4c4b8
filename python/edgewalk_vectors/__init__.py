"""Replays a directory of edgewalk's test vectors into a design under cocotb.

    from edgewalk_vectors import replay
    test = replay("out/v/hazards_pixel")

`run("out/v/hazards_pixel")` builds the design of the directory with a simulator and runs that test;
`python -m edgewalk_vectors DIR` does it from a shell. Of a directory of `edgewalk vectors --dut` the design is the user's.

`Scoreboard` needs no directory: in a test of your own it compares a design with the live model of the module `edgewalk`.
"""

from .bench import Bench, Fault
from .directory import Directory, VectorsError
from .pins import Wiring
from .replay import replay
from .run import run
from .scoreboard import Scoreboard

__all__ = ["Bench", "Directory", "Fault", "Scoreboard", "VectorsError", "Wiring", "replay", "run"]
