"""In which state a run is."""

from __future__ import annotations

import fcntl
import json
import os
from pathlib import Path
from typing import Any


def status(directory: Path) -> str:
    """"finished", "running", "failed" or "interrupted", as `pycav.runs` has it; read anew, since a run may go on."""
    summary: dict[str, Any] = json.loads((directory / "summary.json").read_text())
    if summary.get("completed"):
        return "finished"
    if _is_held(directory):
        return "running"
    return "failed" if summary.get("error") else "interrupted"


def _is_held(directory: Path) -> bool:
    """Whether a process holds the lock that a run has on its directory; `False` where there are no locks."""
    handle = os.open(directory, os.O_RDONLY)
    try:
        fcntl.flock(handle, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        return True
    except OSError:
        return False
    finally:
        os.close(handle)
    return False
