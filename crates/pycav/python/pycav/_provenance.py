"""Where datasets are from: attributes as of the CF conventions, the same of a run, a sweep and hits."""

from __future__ import annotations

import datetime
from collections.abc import Mapping
from typing import Any

from .histories import text


def provenance(title: str, history: str, run: Mapping[str, Any], **more: Any) -> dict[str, Any]:
    """Title, program and revision, date and what has written the dataset.

    - `run`: attributes of the history of a run, which name program and revision; empty if there is none yet.
    - `more`: further attributes.
    """
    now = datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds")
    told = {name: str(text(run[name])) for name in ("program", "git_revision") if name in run}
    return {"Conventions": "CF-1.11", "title": title, **told, "source": " ".join(told.values()).strip() or "cav",
            "history": f"{now} {history}", "date_created": now, **more}
