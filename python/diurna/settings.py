"""Values in place of those of a file, as the program takes them: "key.path=value"."""

from __future__ import annotations

from collections.abc import Mapping

from .checks import Settings, texts
from .errors import Error
from .toml_text import toml_value


def settings_list(settings: Settings) -> list[str]:
    """A list of "key.path=value" of such a text, a list of them, or a dictionary by key path."""
    if isinstance(settings, Mapping):
        for key in settings:
            if not isinstance(key, str):
                raise Error([("settings", f"found the key {key!r}", "expected key paths as texts")])
        return [f"{key}={toml_value(value, key)}" for key, value in settings.items()]
    given = texts("settings", settings, 'a text as "time.step_s=300"')
    for one in given:
        if "=" not in one[1:]:
            raise Error([("settings", f"found '{one}'", 'expected "key.path=value", as "time.step_s=300"')])
    return given
