"""Scenes: checked, planned, run, driven."""

import os
import warnings
from pathlib import Path
from typing import NamedTuple

from . import _core
from .errors import NotConverged, Warning
from .pictures import Frame, read_frame
from .point import settings_given
from .studies import Studies, converged
from .sweep import Sweep
from .tables import instant_text
from .toml_text import toml_text


class Check(NamedTuple):
    facets: int
    observers: int
    warnings: list
    notes: list


class Temperatures(NamedTuple):
    """temperatures.nc: the instants (datetime64, UTC) and [K] as (instant, facet). The file opens in xarray, too."""

    time: object
    kelvin: object


class Run:
    """A run's folder and what the run has told."""

    def __init__(self, folder, told):
        self.folder = Path(folder)
        for name in ("facets", "frames_rendered", "files", "stages", "notes", "warnings", "start", "not_converged"):
            setattr(self, name, told[name])

    report = property(lambda self: self.folder / "report.html")
    seconds = property(lambda self: sum(self.stages.values()))

    def frame_files(self):
        """Pictures (EXR), by observer, band and instant as their names have them."""
        return sorted((self.folder / "frames").glob("*.exr"))

    def frames(self, planes=None):
        """Each of them, one after the other."""
        return (read_frame(file, planes) for file in self.frame_files())

    def temperatures(self):
        return Temperatures(*_core.temperatures(self.folder / "temperatures.nc"))

    def __repr__(self):
        return f"<diurna.Run {self.folder}: {self.facets} facets, {self.frames_rendered} pictures, {self.seconds:.1f} s>"


class Plan(dict):
    """What would be computed: facets, pictures, seconds, memory_bytes, stages, decisions; its text when shown."""

    def __repr__(self):
        return self["text"]


class Scene:
    """A scene file, or a dictionary of what one says, which is written to `file` first.

    settings: "key.path=value" in place of what the file says. Files that the scene names are read beneath its folder
    unless allow_outside is true.
    """

    def __init__(self, scene, file=None, settings=(), allow_outside=False, overwrite=False):
        if isinstance(scene, dict):
            if file is None:
                raise TypeError("Scene of a dictionary: expected file=, where it is written")
            with open(file, "w" if overwrite else "x", encoding="utf-8") as out:
                out.write(toml_text(scene))
            scene = file
        elif file is not None:
            raise TypeError("Scene of a file takes no other file=")
        self.file = Path(scene)
        self._given = (os.fspath(self.file), settings_given(settings), allow_outside)

    def check(self, strict=False):
        """All that can be known to be wrong before anything is computed: raises diurna.Error. Doubts are told as
        `warnings`; with `strict` they are raised."""
        found = Check(**_core.check_scene(*self._given, None))
        if strict and found.warnings:
            raise ValueError("\n".join(found.warnings))
        return found

    def plan(self):
        return Plan(_core.plan_scene(*self._given, None))

    def run(self, out="out", resume=False, fresh=False, max_memory_bytes=0.0, progress=None):
        """The whole job into a folder, as `diurna run`. Doubts are told by warnings.warn. Raises diurna.Error, and
        NotConverged with the Run, whose results are kept.

        progress: called with a stage's name and its share, 0 when it begins, 1 when it ends. What it raises ends the
        run, as Ctrl-C does: what was written stays, whole, and `resume` goes on from there.
        """
        run = Run(out, _core.run_scene(*self._given, out, resume, fresh, max_memory_bytes, progress))
        for doubt in run.warnings:
            warnings.warn(doubt, Warning, stacklevel=2)
        if run.not_converged:
            raise NotConverged(run.not_converged, run)
        return run

    def sweep(self, out="out", resume=False, max_memory_bytes=0.0, progress=None):
        """All variants of a scene with [sweep] into a folder, as `diurna run`; raises and tells as run()."""
        told = _core.sweep_scene(*self._given, out, resume, max_memory_bytes, progress)
        swept = Sweep(out, told)
        if told["not_converged"]:
            raise NotConverged("\n".join(told["not_converged"]), swept)
        return swept

    def _study(self, kind, temperatures, out, progress):
        raw = _core.study(kind, *self._given, temperatures or "", out or "", progress)
        return converged(Studies(raw), raw)

    # Studies, each of the tables of its name in the scene, as the verbs of `diurna`. temperatures: a file of `diurna
    # solve` or a run's temperatures.nc, else they are solved; out: a folder for the program's files, else none is
    # written; progress as run() has it. They raise diurna.Error, and NotConverged with what there is.

    def crossover(self, temperatures=None, out=None, progress=None):
        """When two things look equally warm, and how well that is known: of every [[crossover]] a row for each."""
        return self._study("crossover", temperatures, out, progress)

    def contrast(self, temperatures=None, out=None, progress=None):
        """How targets stand out from what is around them: of every [[contrast]] a row for each picture."""
        return self._study("contrast", temperatures, out, progress)

    def signature(self, temperatures=None, out=None, progress=None):
        """Radiant and contrast intensity of objects: of every [[signature]] a row for each direction."""
        return self._study("signature", temperatures, out, progress)

    def detection(self, temperatures=None, out=None, progress=None):
        """Ranges at which a display shows objects: of every [[detection]] a row for each range."""
        return self._study("detection", temperatures, out, progress)

    def sensitivity(self, out=None, progress=None):
        """What numbers not known well do to figures: of every [[sensitivity]] a row for each figure and number."""
        return self._study("sensitivity", None, out, progress)

    def stepper(self):
        """The scene to be driven step by step."""
        return Stepper(self)


class Stepper:
    """A scene that a program drives: go on in time, put an object elsewhere, take a picture.

    Heat goes by the scene's own steps, whatever instants are asked for. Objects that are put elsewhere have a
    trajectory, be it one that rests. The same calls give the same numbers on any number of threads.
    """

    def __init__(self, scene):
        self._core = _core.Stepper(*scene._given)

    now = property(lambda self: self._core.now(), doc="ISO 8601, UTC; at first the span's start")
    steps_solved = property(lambda self: self._core.steps_solved)

    def advance(self, to):
        self._core.advance(instant_text(to))

    def put(self, name, east_m, north_m, heading_deg=0.0):
        """On the ground there, its front so many degrees clockwise from north."""
        self._core.put(name, east_m, north_m, heading_deg)

    def pose(self, name):
        """4 x 4: of its frame (middle in plan and lowest point; right, front, up) in east, north, up."""
        return self._core.pose(name)

    def temperature(self):
        """[K] (facet) now."""
        return self._core.temperature()

    def facets(self):
        """vertex_m, corner, normal, area_m2, material, object: arrays of what temperature() is of."""
        return self._core.facets()

    def observer(self, name):
        """Its pose in its first picture, to be changed and handed in to picture()."""
        return self._core.observer(name)

    def picture(self, name, pose=None):
        return Frame(self._core.picture(name, pose if pose is not None else self.observer(name)))


def temperatures(file):
    """Of temperatures.nc, or of what `diurna solve` has written."""
    return Temperatures(*_core.temperatures(file))
