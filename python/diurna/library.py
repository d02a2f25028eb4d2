"""Values of library materials, so that settings can change a part of them: material.layers.0.thickness_m."""

from __future__ import annotations

import copy
import functools
import re
import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from . import _core
from .toml_text import toml_key, toml_value


@functools.lru_cache(maxsize=4)
def _library(file: Path, changed: float) -> dict[str, Any]:
    return tomllib.loads(file.read_text(encoding="utf-8"))


def _tables() -> dict[str, Any]:
    file = Path(_core.data_folder()) / "library.toml"
    return _library(file, file.stat().st_mtime)


def library_table(name: str, own: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """Keys of a material, with those of the materials it is `like`, nearest first.

    name: of a material of `own` (tables by name, as [material] of a scene) or of the library. {} for an unknown one.
    """
    found: dict[str, Any] = {}
    seen: set[tuple[str, bool]] = set()
    of_scene = own is not None and name in own
    while (name, of_scene) not in seen:
        seen.add((name, of_scene))
        tables: Mapping[str, Any] = own if of_scene and own is not None else _tables()
        table = tables.get(name)
        if not isinstance(table, Mapping):
            break
        for key, value in table.items():
            found.setdefault(key, copy.deepcopy(value))
        like = table.get("like")
        if like is None and not of_scene:
            break  # a material of the library that starts from nothing
        base = name if like is None else str(like)
        of_scene = of_scene and own is not None and base in own and base != name  # the library knows no scene
        name = base
    found.pop("like", None)
    found.pop("name", None)
    return found


def path_words(path: str) -> list[str]:
    """The words of a key path; dots within double quotes belong to a word."""
    return [word[1:-1] if word[:1] == '"' else word for word in re.findall(r'"[^"]*"|[^."]+', path)]


def key_paths(table: Any) -> Iterable[str]:
    """Key paths that tables of a scene or column name in `key` and `keys`: of [calibrate], [sweep], uncertain numbers."""
    if isinstance(table, Mapping):
        for name, value in table.items():
            if name == "key" and isinstance(value, str):
                yield value
            elif name == "keys" and isinstance(value, (list, tuple)):
                yield from (one for one in value if isinstance(one, str))
            else:
                yield from key_paths(value)
    elif isinstance(table, (list, tuple)):
        for one in table:
            yield from key_paths(one)


def _names_a_file(value: Any) -> bool:
    """Files are named relative to the library, which another file cannot repeat."""
    if isinstance(value, Mapping):
        return any(str(key).endswith("file") or _names_a_file(one) for key, one in value.items())
    return isinstance(value, (list, tuple)) and any(map(_names_a_file, value))


def with_library_values(table: Mapping[str, Any], settings: list[str], column: bool) -> list[str]:
    """The settings, preceded by tables of the library where a setting changes a part of one.

    `material.layers.0.thickness_m=0.1` of a material that has its layers from the library needs them in the file first:
    `material.layers=[...]` comes before it. Likewise for `convection`, `bottom` and the others, and for key paths that the
    file's [calibrate], [sweep] and uncertain numbers name.

    table: the file as a dictionary; column: whether it is a column file, with one [material], or a scene, with many.
    """
    given = table.get("material")
    own: dict[str, Any] = {**given} if isinstance(given, Mapping) else {}
    first = 1 if column else 2  # words before the part: material, or material.NAME
    out: list[str] = []
    done: set[tuple[str, str]] = set()

    def add(path: str) -> None:
        words = path_words(path)
        if len(words) < first + 2 or words[0] != "material":
            return
        name, part = "" if column else words[1], words[first]
        of_it = own if column else own.get(name, {})
        if not isinstance(of_it, Mapping) or part in of_it or (name, part) in done:
            return
        done.add((name, part))
        if column:
            base = library_table(str(of_it.get("like", of_it.get("name", ""))))
        else:
            base = library_table(name, own)
        value = base.get(part)
        if isinstance(value, (Mapping, list)) and not _names_a_file(value):
            place = ["material", *([toml_key(name)] if name else []), part]
            out.append(f"{'.'.join(place)}={toml_value(value, part)}")

    for setting in settings:
        path, is_setting, value = setting.partition("=")
        words = path_words(path.strip())
        add(path.strip())
        out.append(setting)
        if is_setting and len(words) == first + 1 and words[0] == "material":  # takes the place of what the file says
            read = _read_value(value)
            if column:
                own[words[1]] = read
            elif isinstance(own.get(words[1], {}), Mapping):
                own[words[1]] = {**own.get(words[1], {}), words[2]: read}
    for path in dict.fromkeys(key_paths(table)):
        add(path)
    return out


def _read_value(text: str) -> Any:
    try:
        return tomllib.loads(f"value = {text}")["value"]
    except tomllib.TOMLDecodeError:
        return text
