"""How this installation starts the program."""

import sys

PROGRAM = [sys.executable, "-m", "pycav"]
"""The command line of `cav` as this installation has it, for the processes of a run."""
