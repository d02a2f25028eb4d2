"""diurna from Python: thermal and diurnal terrain scenes with an offline spectral renderer.

diurna.Scene(...) checks, plans and runs a scene file or a dictionary with its keys; diurna.column(...) solves one facet under a
weather file or a pandas.DataFrame; diurna.sun(...), path(...), band_radiance(...) need no scene; materials(), models(), bands()
list the names that scenes use. Wrong input raises diurna.Error with the key and the remedy.
"""

from . import _core, checks
from ._core import version as __version__
from .columns import Column, calibrate, column
from .errors import Error, Mistake, NotConverged, Warning
from .lists import BandName, Material, Model, Names, aerosols, bands, materials, models, profiles
from .pictures import Frame, read_frame
from .point import PathInBand, Sun, apparent_temperature, band_radiance, path, sun
from .results import Check, Plan, Run, Temperatures, temperatures
from .scene import Scene
from .stepper import Pose, Stepper
from .studies import Calibration, Studies, Study
from .sweep import Sweep
from .toml_text import toml_text


def data_folder() -> str:
    """The folder with the material library, spectra and tables that the package uses."""
    return str(_core.data_folder())


def set_threads(threads: int) -> None:
    """Sets the number of worker threads of all later calls.

    threads: 0 (one for each core) to 1024; results do not depend on it. Raises diurna.Error for another number, and while
    another call is running.
    """
    _core.set_threads(checks.whole("threads", threads, 0, 1024))


def __dir__() -> list[str]:
    return sorted(__all__)


__all__ = [
    "BandName",
    "Calibration",
    "Check",
    "Column",
    "Error",
    "Frame",
    "Material",
    "Mistake",
    "Model",
    "Names",
    "NotConverged",
    "PathInBand",
    "Plan",
    "Pose",
    "Run",
    "Scene",
    "Stepper",
    "Studies",
    "Study",
    "Sun",
    "Sweep",
    "Temperatures",
    "Warning",
    "__version__",
    "aerosols",
    "apparent_temperature",
    "band_radiance",
    "bands",
    "calibrate",
    "column",
    "data_folder",
    "materials",
    "models",
    "path",
    "profiles",
    "read_frame",
    "set_threads",
    "sun",
    "temperatures",
    "toml_text",
]
