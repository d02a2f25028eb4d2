"""The tables of library materials, as dictionaries."""

from __future__ import annotations

import copy
import functools
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from . import _core


@functools.lru_cache(maxsize=4)
def _library(file: Path, changed: float) -> dict[str, Any]:
    return tomllib.loads(file.read_text(encoding="utf-8"))


def library_table(name: str) -> dict[str, Any]:
    """Keys of a material of the library, with those of the materials it is `like`, nearest first. {} for an unknown one."""
    file = Path(_core.data_folder()) / "library.toml"
    tables = _library(file, file.stat().st_mtime)
    found: dict[str, Any] = {}
    seen: set[str] = set()
    while name in tables and name not in seen:
        seen.add(name)
        table: Mapping[str, Any] = tables[name]
        for key, value in table.items():
            found.setdefault(key, copy.deepcopy(value))
        name = str(table.get("like", ""))
    found.pop("like", None)
    return found
