"""Errors and warnings of the package, each with the key that is wrong and the remedy."""

from __future__ import annotations

import re
from collections.abc import Iterable
from typing import Any, NamedTuple


class Mistake(NamedTuple):
    """One mistake in an input.

    `file`, `line`, `column`: where it is in a file, each None if it is not there. `key`: the scene key or the argument, or
    None. `problem`: what was found and what was expected. `hint`: the remedy, "" if there is none. `where`: file, line,
    column and key as the message prints them.
    """

    file: str | None
    line: int | None
    column: int | None
    key: str | None
    problem: str
    hint: str
    where: str

    def of_dictionary(self, file: str, argument: str) -> Mistake:
        """The same, of a dictionary that the program has read as the text of `file`, which does not exist: the place is the
        key path, or the argument where there is none."""
        at = re.compile(rf"{re.escape(file)}(?::\d+)*(?:: )?")
        own = self.file == file
        problem, hint = at.sub("", self.problem), at.sub("", self.hint)
        if not own:
            return self._replace(problem=problem, hint=hint)
        key = self.key or argument
        return Mistake(None, None, None, key, problem, hint, key)

    def __str__(self) -> str:
        return f"{self.where}: {self.problem}" + (f" ({self.hint})" if self.hint else "")


_in_file = re.compile(r"(?P<file>.+?):(?P<line>\d+)(?::(?P<column>\d+))?(?:: (?P<key>\S.*))?$")
_file_and_key = re.compile(r"(?P<file>.+?): (?P<key>\S.*)$")
_option = re.compile(r"--(?P<option>[a-z-]+) ?(?P<rest>.*)$")
_key = re.compile(r"[A-Za-z_][\w.\[\]-]*$")
_endings = (".toml", ".csv", ".nc", ".exr", ".tif", ".obj", ".ply", ".txt", ".json", ".asc", ".epw", ".png", ".html")

# How Python says what the command line says.
_spellings = (
    ("--allow-outside", "allow_outside=True"),
    ("--max-memory", "max_memory_bytes"),
    ("--resume", "resume=True"),
    ("`diurna materials`", "diurna.materials()"),
)


def _placed(where: str, problem: str, hint: str, key: str | None = None) -> Mistake:
    """The mistake at a place as the program prints it: a file with line, column and key, an option, or a key alone."""
    for option, argument in _spellings:
        problem, hint = problem.replace(option, argument), hint.replace(option, argument)
    given = _option.match(where)
    if given and given["option"] == "set":
        key = key or given["rest"].split("=")[0].split(":")[0].strip()
        return Mistake(None, None, None, key, problem, hint, f"settings: {key}")
    if given:
        name = {"max-memory": "max_memory_bytes"}.get(given["option"], given["option"].replace("-", "_"))
        return Mistake(None, None, None, key or name, problem, hint, f"{name} {given['rest']}".strip())
    at = _in_file.match(where)
    if at:
        column = int(at["column"]) if at["column"] else None
        return Mistake(at["file"], int(at["line"]), column, key or at["key"], problem, hint, where)
    at = _file_and_key.match(where)
    if at and key is None:
        return Mistake(at["file"], None, None, at["key"], problem, hint, where)
    if key is None and _key.match(where) and not where.endswith(_endings):
        key = where
    return Mistake(None if key else where, None, None, key, problem, hint, where)


class Error(ValueError):
    """An input that cannot be used: a file, a key in it, or an argument of the wrong type or out of range.

    `mistakes` lists all of them; `file`, `line`, `column` and `key` are those of the first. The text has one line for each
    mistake: place, what was found and expected, and the remedy in parentheses.
    """

    def __init__(self, mistakes: Iterable[tuple[Any, ...]]) -> None:
        """mistakes: tuples (where, problem, hint) or (where, problem, hint, key), at least one."""
        self.mistakes: list[Mistake] = [_placed(*one) for one in mistakes]
        super().__init__("\n".join(map(str, self.mistakes)))

    @property
    def file(self) -> str | None:
        """File of the first mistake, or None."""
        return self.mistakes[0].file

    @property
    def line(self) -> int | None:
        """Line of the first mistake in its file, from 1, or None."""
        return self.mistakes[0].line

    @property
    def column(self) -> int | None:
        """Column of the first mistake in its line, from 1, or None."""
        return self.mistakes[0].column

    @property
    def key(self) -> str | None:
        """Key or argument of the first mistake, or None."""
        return self.mistakes[0].key


class NotConverged(RuntimeError):
    """The heat balance has not converged. The results are kept: `result` is what the call would have returned."""

    def __init__(self, message: str, result: Any) -> None:
        """message: which residual, and its limit; result: what the call would have returned."""
        self.result = result
        super().__init__(message)


class Warning(UserWarning):
    """An input that is implausible but can be computed. `diurna.Scene.check(strict=True)` raises it as diurna.Error."""
