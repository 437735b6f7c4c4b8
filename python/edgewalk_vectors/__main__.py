"""python -m edgewalk_vectors DIR [--simulator icarus|verilator] [--results FILE.xml]

Exit code 0: everything expected came, and nothing else. 1: not. 2: the directory cannot be replayed.
"""

import argparse
import sys

from .directory import VectorsError
from .run import run


def main():
    parser = argparse.ArgumentParser(prog="python -m edgewalk_vectors", description="Replays test vectors under cocotb.")
    parser.add_argument("directory", help="a directory that `edgewalk vectors` wrote")
    parser.add_argument("--simulator", default="icarus", choices=["icarus", "verilator"])
    parser.add_argument("--results", help="file for the results as JUnit")
    asked = parser.parse_args()
    try:
        passed = run(asked.directory, asked.simulator, asked.results)
    except VectorsError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    print("PASS" if passed else "FAIL")
    return 0 if passed else 1


sys.exit(main())
