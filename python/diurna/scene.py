"""Scenes: checked, planned, run, studied, driven."""

from __future__ import annotations

import hashlib
import os
import warnings
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from . import _core, checks
from .errors import Error, NotConverged, Warning
from .results import Check, Plan, Run
from .settings import settings_list
from .stepper import Stepper
from .studies import Studies, converged
from .sweep import Sweep
from .tables import csv_text
from .toml_text import toml_text, toml_value


class Scene:
    """A scene file, or a dictionary with its keys.

    `file`: the scene file. Its methods run it, as the verbs of `diurna` do, and raise diurna.Error with file, line, key and
    remedy for every mistake in it.
    """

    def __init__(
        self,
        scene: checks.File | Mapping[str, Any],
        file: checks.File | None = None,
        settings: checks.Settings = (),
        allow_outside: bool = False,
        overwrite: bool = False,
        weather: Any = None,
    ) -> None:
        """A scene from a file or a dictionary.

        scene: a scene file, or a dictionary with the keys of one, which is written to `file`; files that it names are
        relative to the folder of `file`. settings: values in place of the file's: "key.path=value", a list of them, or a
        dictionary by key path; parts of a library material too: {"material.asphalt.layers.0.thickness_m": 0.1}.
        allow_outside: files of other folders than the scene's may be read. overwrite: an existing `file` is replaced.
        weather: in place of [weather] file: a pandas.DataFrame or a dictionary of columns named as in weather files
        (`air_temperature_K`, `wind_speed_m_s`, ...), with `time` or instants as the index, NaN where a value is missing. It is
        written beside the scene as NAME.weather-DIGEST.csv, one file for each content, which the scene of a dictionary names.

        Raises diurna.Error with the argument that is wrong, FileExistsError for a `file` that exists.
        """
        self._allow_outside: bool = checks.flag("allow_outside", allow_outside)
        self._settings: list[str] = settings_list(settings)
        checks.flag("overwrite", overwrite)
        if isinstance(scene, Mapping):
            if file is None:
                raise Error([("file", "found None for a scene of a dictionary", 'give file="scene.toml", where it is written')])
            self.file: Path = Path(checks.file("file", file))
            if not overwrite and self.file.exists():
                raise FileExistsError(f"{self.file} exists (overwrite=True replaces it)")
            if weather is not None:  # named in the file, which is then whole without this object
                table = scene.get("weather", {})
                own = dict(table) if isinstance(table, Mapping) else {}
                scene = {**scene, "weather": {**own, "file": self._write_weather(weather)}}
                weather = None
            text = toml_text(scene)
            try:
                with open(self.file, "w" if overwrite else "x", encoding="utf-8") as out:
                    out.write(text)
            except FileExistsError:
                raise FileExistsError(f"{self.file} exists (overwrite=True replaces it)") from None
        else:
            if file is not None:
                raise Error([("file", "found a file= for a scene that is a file already", "remove file=")])
            self.file = Path(checks.file("scene", scene))
        if weather is not None:
            self._settings.append(f"weather.file={toml_value(self._write_weather(weather), 'weather.file')}")

    def _write_weather(self, weather: Any) -> str:
        """Its name, beside the scene."""
        data = csv_text(weather, "weather").encode()
        name = f"{self.file.stem}.weather-{hashlib.sha256(data).hexdigest()[:8]}.csv"
        place = self.file.with_name(name)
        try:
            if not place.exists() or place.read_bytes() != data:
                place.write_bytes(data)
        except OSError as error:
            hint = "copy the scene into a folder where you may write"
            raise Error([("weather", f"cannot write {place}: {error.strerror}", hint)]) from None
        return name

    def _given(self, *more: str) -> tuple[str, list[str], bool]:
        """File, settings and confinement as the compiled module takes them."""
        return os.fspath(self.file), [*self._settings, *more], self._allow_outside

    def __repr__(self) -> str:
        return f"<diurna.Scene {self.file}>"

    def check(self, strict: bool = False) -> Check:
        """Finds every mistake that can be known before anything is computed, as `diurna check`.

        strict: warnings count as mistakes. Returns a diurna.Check with warnings and notes. Raises diurna.Error with all
        mistakes.
        """
        found = Check(**_core.check_scene(*self._given(), None))
        if checks.flag("strict", strict) and found.warnings:
            raise Error([(str(self.file), line, "strict=False lets it pass") for line in found.warnings])
        return found

    def plan(self) -> Plan:
        """What a run would compute, with estimates of its time and memory, as `diurna plan`. Raises diurna.Error."""
        return Plan(_core.plan_scene(*self._given(), None))

    def run(
        self,
        out: checks.File = "out",
        resume: bool = False,
        fresh: bool = False,
        max_memory_bytes: float = 0.0,
        progress: checks.Progress | None = None,
        *,
        only: str | Sequence[str] | Mapping[str, Any] = (),
        threads: int | None = None,
        tolerance_K: float | None = None,
    ) -> Run:
        """Runs the scene into a folder, as `diurna run`: temperatures, pictures, labels, report.

        out: the folder. resume: what an earlier run of the same inputs has written is kept. fresh: nothing is taken from the
        cache. max_memory_bytes: that the plan may need; 0: what is free. progress: called with the name of a stage and its
        share, 0 when it begins, 1 when it ends; an exception that it raises ends the run, as Ctrl-C does, and files written
        until then are whole.
        only: the pictures to render: "observer=east", "band=8-12", "frames=05:00..09:00" or an instant, one or a list, or a
        dictionary {"observer": "east", "band": ["8-12"]}. threads: worker threads of this call; 0: one for each core; None: as
        diurna.set_threads() says. The results do not depend on it. tolerance_K: allowed rms error of a picture [K], 0 to 10,
        in place of the scene's; larger is faster.

        Returns a diurna.Run. Warnings come as diurna.Warning. Raises diurna.Error, and diurna.NotConverged with the Run, whose
        results are kept.
        """
        more = []
        if tolerance_K is not None:
            more.append(f"tolerance_K={checks.number('tolerance_K', tolerance_K, 0, 10, 'K')!r}")
        raw = _core.run_scene(
            *self._given(*more),
            checks.file("out", out),
            checks.flag("resume", resume),
            checks.flag("fresh", fresh),
            _chosen(only),
            -1 if threads is None else checks.whole("threads", threads, 0, 1024),
            checks.number("max_memory_bytes", max_memory_bytes, 0),
            checks.progress_callable("progress", progress),
        )
        run = Run(out, raw)
        for line in run.warnings:
            warnings.warn(line, Warning, stacklevel=2)
        if run.not_converged:
            raise NotConverged(run.not_converged, run)
        return run

    def sweep(
        self,
        out: checks.File = "out",
        resume: bool = False,
        max_memory_bytes: float = 0.0,
        progress: checks.Progress | None = None,
        *,
        threads: int | None = None,
    ) -> Sweep:
        """Runs all variants of a scene with [sweep] into a folder, as `diurna run`.

        out, resume, max_memory_bytes, progress, threads: as of run(). Returns a diurna.Sweep. Raises diurna.Error, and
        diurna.NotConverged with the Sweep.
        """
        raw = _core.sweep_scene(
            *self._given(),
            checks.file("out", out),
            checks.flag("resume", resume),
            -1 if threads is None else checks.whole("threads", threads, 0, 1024),
            checks.number("max_memory_bytes", max_memory_bytes, 0),
            checks.progress_callable("progress", progress),
        )
        swept = Sweep(out, raw)
        if raw["not_converged"]:
            raise NotConverged("\n".join(raw["not_converged"]), swept)
        return swept

    def _study(self, kind: str, stored: checks.File | None, out: checks.File | None, progress: checks.Progress | None) -> Studies:
        heat, folder = checks.optional_file("temperatures", stored), checks.optional_file("out", out)
        raw = _core.study(kind, *self._given(), heat, folder, checks.progress_callable("progress", progress))
        return converged(Studies(raw), raw)

    def crossover(
        self, temperatures: checks.File | None = None, out: checks.File | None = None, progress: checks.Progress | None = None
    ) -> Studies:
        """When two things have the same apparent temperature, and how uncertain that is: each [[crossover]], a row for each
        crossing, times in s and differences in K.

        temperatures: temperatures.nc of a run or a file of `diurna solve`; None: they are solved. out: a folder for the
        program's files; None: none is written. progress: as of run(). Raises diurna.Error, and diurna.NotConverged with the
        result.
        """
        return self._study("crossover", temperatures, out, progress)

    def contrast(
        self, temperatures: checks.File | None = None, out: checks.File | None = None, progress: checks.Progress | None = None
    ) -> Studies:
        """How targets differ from their background [K]: each [[contrast]], a row for each picture.

        temperatures, out, progress, errors: as of crossover().
        """
        return self._study("contrast", temperatures, out, progress)

    def signature(
        self, temperatures: checks.File | None = None, out: checks.File | None = None, progress: checks.Progress | None = None
    ) -> Studies:
        """Radiant and contrast intensity of objects [W/sr]: each [[signature]], a row for each direction.

        temperatures, out, progress, errors: as of crossover().
        """
        return self._study("signature", temperatures, out, progress)

    def detection(
        self, temperatures: checks.File | None = None, out: checks.File | None = None, progress: checks.Progress | None = None
    ) -> Studies:
        """Ranges [m] at which an instrument's display shows objects: each [[detection]], a row for each range.

        temperatures, out, progress, errors: as of crossover().
        """
        return self._study("detection", temperatures, out, progress)

    def sensitivity(self, out: checks.File | None = None, progress: checks.Progress | None = None) -> Studies:
        """How uncertain numbers change results: each [[sensitivity]], a row for each result and number.

        out, progress, errors: as of crossover().
        """
        return self._study("sensitivity", None, out, progress)

    def stepper(self) -> Stepper:
        """The scene step by step, objects and cameras moved by the caller: with scene.stepper() as stepper: ...

        Raises diurna.Error.
        """
        return Stepper(self)


def _chosen(only: str | Sequence[str] | Mapping[str, Any]) -> list[str]:
    """A list of "kind=name" of what run(only=) takes."""
    expected = '"observer=NAME", "band=NAME" or "frames=HH:MM..HH:MM"'
    if isinstance(only, Mapping):
        return [f"{kind}={name}" for kind, names in only.items() for name in checks.texts(f"only.{kind}", names, "a name")]
    chosen = checks.texts("only", only, expected)
    for one in chosen:
        if "=" not in one:
            raise Error([("only", f"found '{one}'", f"expected {expected}")])
    return chosen
