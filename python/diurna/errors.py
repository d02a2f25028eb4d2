"""What goes wrong with an input, told so that its author can mend it."""

import re
from typing import NamedTuple


class Mistake(NamedTuple):
    """One of them; `file`, `line`, `column` and `key` are None where it has none."""

    file: str | None
    line: int | None
    column: int | None
    key: str | None
    problem: str
    hint: str
    where: str

    def __str__(self):
        return f"{self.where}: {self.problem}" + (f" ({self.hint})" if self.hint else "")


_place = re.compile(r"(?P<file>.+?):(?P<line>\d+):(?P<column>\d+)(?:: (?P<key>\S.*))?$")


class Error(ValueError):
    """An input that cannot be used. `mistakes` has all of it, `file`, `line`, `column`, `key` the first one's."""

    def __init__(self, mistakes):
        self.mistakes = []
        for where, problem, hint in mistakes:
            at = _place.match(where)
            place = (at["file"], int(at["line"]), int(at["column"]), at["key"]) if at else (where, None, None, None)
            self.mistakes.append(Mistake(*place, problem, hint, where))
        super().__init__("\n".join(map(str, self.mistakes)))

    file = property(lambda self: self.mistakes[0].file)
    line = property(lambda self: self.mistakes[0].line)
    column = property(lambda self: self.mistakes[0].column)
    key = property(lambda self: self.mistakes[0].key)


class NotConverged(RuntimeError):
    """The heat balance has not converged. Results are kept; `result` has what there is."""

    def __init__(self, message, result):
        self.result = result
        super().__init__(message)


class Warning(UserWarning):
    """What can be computed but is hardly meant, and what was modelled for want of data."""
