"""The sun, a path through the air, Planck's law, one facet under a weather file."""

import os
import tempfile
from contextlib import contextmanager
from typing import NamedTuple

import numpy as np

from . import _core
from .errors import Error, NotConverged
from .studies import Calibration, converged
from .tables import as_frame, instant_text, write_csv
from .toml_text import toml_text


class Sun(NamedTuple):
    azimuth_deg: float  # clockwise from true north
    elevation_deg: float
    distance_au: float


def sun(latitude_deg, longitude_deg, time, height_m=0.0, pressure_hPa=None, temperature_C=15.0):
    """Where the sun stands, refracted where the air's pressure is given."""
    return Sun(*_core.sun(latitude_deg, longitude_deg, instant_text(time), height_m, pressure_hPa, temperature_C))


def band_radiance(band, temperature_K):
    """A black body's radiance [W m-2 sr-1] in a band of wavelengths ("8-12" um); of arrays, arrays."""
    return _core.band_radiance(band, temperature_K)


def apparent_temperature(band, radiance):
    """[K] of the black body that has this radiance [W m-2 sr-1] in the band."""
    return _core.apparent_temperature(band, radiance)


class PathInBand(NamedTuple):
    transmittance: float  # mean over wavelength
    thermal_W_m2_sr: float
    scattered_W_m2_sr: float  # of sunlight; 0 where no sun is named
    contrast_transmittance: float  # mean weighted by Planck's slope at 300 K: of a small difference of temperature


def path(bands, profile="US76", aerosol="none", visibility_km=23.0, co2_ppm=None, ground_km=0.0, rain_mm_h=0.0, **way):
    """Transmittance and radiance of one path through the air, by band name.

    The way: height_km, zenith_deg and one of range_km, to_height_km, to_ground, to_space; sun_zenith_deg,
    azimuth_from_sun_deg and ground_albedo for scattered sunlight.
    """
    air_path = _core.AirPath()
    for name, value in way.items():
        if not hasattr(air_path, name):
            raise TypeError(f"path() has no {name!r}")
        setattr(air_path, name, value)
    names = [bands] if isinstance(bands, str) else list(bands)
    co2 = _core.todays_co2_ppm if co2_ppm is None else co2_ppm
    rows = _core.path(names, profile, aerosol, visibility_km, co2, ground_km, rain_mm_h, air_path)
    return dict(zip(names, (PathInBand(*row) for row in rows)))


class Column:
    """What one facet went through: arrays by name, as the CSV of `diurna column` has them; `column["latent_W_m2"]`."""

    def __init__(self, raw):
        self.columns, self.note = raw["columns"], raw["note"]
        self.converged, self.passes = raw["converged"], raw["passes"]
        self.depth_m, self.final_profile_K = raw["depth_m"], raw["final_profile_K"]

    def __getitem__(self, name):
        return self.columns[name]

    def __repr__(self):
        kelvin = self["surface_temperature_K"]
        return f"<diurna.Column {len(kelvin)} rows, surface {kelvin.min():.2f} to {kelvin.max():.2f} K>"

    def frame(self):
        """As pandas.DataFrame, its index the instants in UTC."""
        return as_frame(self.columns, "time")

    def _repr_svg_(self):
        kelvin = np.asarray(self["surface_temperature_K"])
        low, high = float(kelvin.min()), max(float(kelvin.max()), float(kelvin.min()) + 1e-3)
        x = np.linspace(40, 590, len(kelvin))
        y = 190 - 170 * (kelvin - low) / (high - low)
        points = " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y))
        first, last = (str(t)[:16] for t in (self["time"][0], self["time"][-1]))
        return (
            '<svg xmlns="http://www.w3.org/2000/svg" width="600" height="215" font-family="sans-serif" font-size="11">'
            f'<polyline points="{points}" fill="none" stroke="#b3541e" stroke-width="1.5"/>'
            f'<text x="2" y="24">{high:.1f} K</text><text x="2" y="194">{low:.1f} K</text>'
            f'<text x="40" y="210">{first}Z</text><text x="590" y="210" text-anchor="end">{last}Z</text></svg>'
        )


def settings_given(settings):
    """Of "key.path=value"; one by itself is taken for a list of one."""
    return [settings] if isinstance(settings, str) else list(settings)


@contextmanager
def _column_source(job, tables, settings, allow_outside):
    """The column file or dictionary; tables, by what they are called and the key that names their file, are written to
    files of their own."""
    with tempfile.TemporaryDirectory() as folder:
        text, settings = None, settings_given(settings)
        if isinstance(job, dict):
            text, job = toml_text(job), os.path.abspath("column.toml")
        given = [(what, key, table) for (what, key), table in tables.items() if table is not None]
        for what, key, table in given:
            settings.append(f'{key}="{write_csv(table, os.path.join(folder, what + ".csv"), what)}"')
        try:
            yield _core.ColumnSource(job, text, settings, [folder] if given else [], allow_outside)
        except Error as error:  # of files that are gone by then: tables, whose rows begin in line 2
            told = ((one.where.replace(folder + os.sep, "given "), one.problem, one.hint) for one in error.mistakes)
            raise Error(told) from None


def column(job, weather=None, settings=(), allow_outside=False):
    """One facet driven by weather: `job` a column file or a dictionary of what one says.

    weather: in place of [weather] file: a pandas.DataFrame or dictionary of columns as weather files have them, `time`
    with its offset from UTC, NaN where a value is missing. What files the dictionary names lie beneath the working
    folder. What was modelled for want of measurements is in `note`. Raises diurna.Error, and NotConverged with what
    there is.
    """
    with _column_source(job, {("weather", "weather.file"): weather}, settings, allow_outside) as source:
        result = Column(_core.column(source))
    if not result.converged:
        raise NotConverged(f"the spin-up has not converged in {result.passes} passes; a shorter time.longest_step_s may help", result)
    return result


def calibrate(job, measured=None, weather=None, settings=(), allow_outside=False, out=None):
    """Numbers of a column that its [calibrate] asks for, found from a measured curve, as `diurna calibrate`.

    measured: in place of [calibrate] measured: a Series whose index are the instants, or a table with `time` and the values;
    NaN where one is missing. weather and the rest as column() has them; out: a folder for the program's files. Returns a
    Calibration. Raises diurna.Error, and NotConverged with what there is.
    """
    tables = {("weather", "weather.file"): weather, ("measured", "calibrate.measured"): measured}
    with _column_source(job, tables, settings, allow_outside) as source:
        raw = _core.calibrate(source, out or "")
    return converged(Calibration(raw["findings"][0]), raw)
