"""The test that `run` starts inside the simulator."""

import os

from .replay import replay
from .run import VARIABLE

test = replay(os.environ[VARIABLE])
