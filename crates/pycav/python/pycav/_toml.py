"""Python values written as TOML."""

from __future__ import annotations

import json
import re
import sys
from collections.abc import Mapping
from typing import Any

import numpy as np

BARE = re.compile(r"[A-Za-z0-9_-]+")


def key(name: str) -> str:
    return name if BARE.fullmatch(name) else json.dumps(name, ensure_ascii=False)


def value(given: Any) -> str:
    """A value on one line: numbers, texts, truth values, sequences, arrays, tables."""
    if isinstance(given, (bool, np.bool_)):
        return "true" if given else "false"
    if isinstance(given, (int, np.integer)):
        return str(int(given))
    if isinstance(given, (float, np.floating)):
        # repr() gives the shortest text that reads back as the same number; TOML wants digits around a point.
        text = repr(float(given))
        return text if any(c in text for c in ".enai") else text + ".0"
    if isinstance(given, str):
        return json.dumps(given, ensure_ascii=False)
    if isinstance(given, np.ndarray):
        return value(given.tolist())
    if isinstance(given, Mapping):
        return "{ " + ", ".join(f"{key(str(name))} = {value(item)}" for name, item in given.items()) + " }"
    if isinstance(given, (list, tuple)):
        return "[" + ", ".join(value(item) for item in given) + "]"
    raise TypeError(f"{given!r} has no place in a case file: give numbers, texts, truth values, lists or dictionaries")


def document(given: Mapping[str, Any]) -> str:
    """A whole document: tables under heads of their own, so that errors name lines a reader finds."""
    lines: list[str] = []
    _table(given, "", lines)
    return "\n".join(lines) + "\n"


def _table(given: Mapping[str, Any], path: str, lines: list[str]) -> None:
    later: list[tuple[str, str, Mapping[str, Any]]] = []
    for name, item in given.items():
        place = f"{path}.{key(str(name))}" if path else key(str(name))
        if isinstance(item, Mapping):
            later.append(("[{}]", place, item))
        elif isinstance(item, (list, tuple)) and item and all(isinstance(table, Mapping) for table in item):
            later.extend(("[[{}]]", place, table) for table in item)
        elif item is not None:
            lines.append(f"{key(str(name))} = {value(item)}")
    for head, place, item in later:
        lines.append(head.format(place))
        _table(item, place, lines)


def parse(text: str) -> dict[str, Any]:
    """A TOML text as nested dictionaries."""
    if sys.version_info >= (3, 11):
        import tomllib
    else:
        import tomli as tomllib
    return tomllib.loads(text)
