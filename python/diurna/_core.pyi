"""Types of the compiled module; python/tests/test_public.py compares names and arguments with it."""

from collections.abc import Callable, Sequence
from os import PathLike
from typing import Any

import numpy as np
import numpy.typing as npt

version: str
todays_co2_ppm: float

_File = str | PathLike[str]
_Progress = Callable[[str, float], Any] | None

class AirPath:
    height_km: float
    zenith_deg: float
    range_km: float | None
    to_height_km: float | None
    to_ground: bool
    to_space: bool
    sun_zenith_deg: float | None
    azimuth_from_sun_deg: float
    ground_albedo: float
    def __init__(self) -> None: ...

class ColumnSource:
    def __init__(
        self, file: _File, text: str | None, settings: Sequence[str], folders: Sequence[_File], allow_outside: bool
    ) -> None: ...

class Observer:
    @property
    def name(self) -> str: ...
    position_m: npt.NDArray[np.float64]
    azimuth_deg: float
    elevation_deg: float
    roll_deg: float
    horizontal_fov_deg: float
    width: int
    height: int

class Stepper:
    def __init__(self, file: _File, settings: Sequence[str], allow_outside: bool) -> None: ...
    def now(self) -> str: ...
    def advance(self, to: str) -> None: ...
    def put(self, name: str, east_m: float, north_m: float, heading_deg: float) -> None: ...
    def pose(self, name: str) -> npt.NDArray[np.float64]: ...
    def temperature(self) -> npt.NDArray[np.float32]: ...
    def facets(self) -> dict[str, npt.NDArray[Any]]: ...
    def material_names(self) -> list[str]: ...
    def object_names(self) -> list[str]: ...
    def observer(self, name: str) -> Observer: ...
    def picture(self, name: str, pose: Observer) -> dict[str, Any]: ...
    @property
    def steps_solved(self) -> int: ...

def data_folder() -> str: ...
def set_threads(threads: int) -> None: ...
def sun(
    latitude_deg: float, longitude_deg: float, time: str, height_m: float, pressure_hPa: float | None, temperature_C: float
) -> tuple[float, float, float]: ...
def band_radiance(band: str, temperature_K: npt.ArrayLike) -> Any: ...
def apparent_temperature(band: str, radiance: npt.ArrayLike) -> Any: ...
def path(
    bands: Sequence[str],
    profile: str,
    aerosol: str,
    visibility_km: float,
    co2_ppm: float,
    ground_km: float,
    rain_mm_h: float,
    air_path: AirPath,
) -> list[tuple[float, float, float, float]]: ...
def column(source: ColumnSource) -> dict[str, Any]: ...
def calibrate(source: ColumnSource, out: _File) -> dict[str, Any]: ...
def materials() -> list[dict[str, Any]]: ...
def models() -> list[dict[str, Any]]: ...
def bands() -> list[dict[str, Any]]: ...
def profiles() -> list[str]: ...
def aerosols() -> list[str]: ...
def check_scene(file: _File, settings: Sequence[str], allow_outside: bool, progress: _Progress) -> dict[str, Any]: ...
def plan_scene(file: _File, settings: Sequence[str], allow_outside: bool, progress: _Progress) -> dict[str, Any]: ...
def run_scene(
    file: _File,
    settings: Sequence[str],
    allow_outside: bool,
    out: _File,
    resume: bool,
    fresh: bool,
    only: Sequence[str],
    threads: int,
    max_memory_bytes: float,
    progress: _Progress,
) -> dict[str, Any]: ...
def sweep_scene(
    file: _File,
    settings: Sequence[str],
    allow_outside: bool,
    out: _File,
    resume: bool,
    threads: int,
    max_memory_bytes: float,
    progress: _Progress,
) -> dict[str, Any]: ...
def study(
    kind: str,
    file: _File,
    settings: Sequence[str],
    allow_outside: bool,
    temperatures: _File,
    out: _File,
    progress: _Progress,
) -> dict[str, Any]: ...
def temperatures(
    file: _File,
) -> tuple[npt.NDArray[np.datetime64], npt.NDArray[np.float32], npt.NDArray[np.uint32], list[str], npt.NDArray[np.uint32], list[str]]: ...
def frame(file: _File, planes: Sequence[str] | None) -> dict[str, Any]: ...
