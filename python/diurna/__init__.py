"""diurna from Python: thermal and diurnal terrain scenes with an offline spectral renderer."""

from ._core import data_folder, set_threads
from ._core import version as __version__
from .errors import Error, Mistake, NotConverged, Warning
from .pictures import Frame, read_frame
from .point import Column, PathInBand, Sun, apparent_temperature, band_radiance, calibrate, column, path, sun
from .scene import Check, Plan, Run, Scene, Stepper, Temperatures, temperatures
from .studies import Calibration, Studies, Study
from .sweep import Sweep
from .toml_text import toml_text
