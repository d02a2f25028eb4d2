"""What needs no scene: the sun, a path through the air, Planck's law."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

from . import _core, checks
from .tables import instant_text


class Sun(NamedTuple):
    """Position of the sun.

    `azimuth_deg`: clockwise from true north, 0 to 360. `elevation_deg`: above the horizontal, -90 to 90. `distance_au`:
    from the earth [astronomical units].
    """

    azimuth_deg: float
    elevation_deg: float
    distance_au: float


def sun(
    latitude_deg: float,
    longitude_deg: float,
    time: checks.Instant,
    height_m: float = 0.0,
    pressure_hPa: float | None = None,
    temperature_C: float = 15.0,
) -> Sun:
    """Position of the sun at a place and an instant (Reda and Andreas 2004, 0.0003 deg).

    latitude_deg: -90 to 90, north; longitude_deg: -360 to 360, east; time: text in ISO 8601 with its offset, datetime with
    tzinfo, or numpy.datetime64 (UTC); height_m: above the sea, -1e4 to 1e5; pressure_hPa: of the air, 0 to 1200; the sun is
    refracted if it is given; temperature_C: of that air, -100 to 80.

    Raises diurna.Error with the argument that is wrong.
    """
    at = _core.sun(
        checks.number("latitude_deg", latitude_deg, -90, 90),
        checks.number("longitude_deg", longitude_deg, -360, 360),
        instant_text(time, "time"),
        checks.number("height_m", height_m, -1e4, 1e5, "m"),
        checks.optional_number("pressure_hPa", pressure_hPa, 0, 1200, "hPa"),
        checks.number("temperature_C", temperature_C, -100, 80, "C"),
    )
    return Sun(*at)


def band_radiance(band: str, temperature_K: Any) -> Any:
    """Radiance of a black body in a band of wavelengths.

    band: as in scenes: "lwir", "8-12" or "8:12" [um], see diurna.bands(); temperature_K: a number or an array [K], 100 to
    20000. Returns [W m-2 sr-1], a float or an array of the same shape. Raises diurna.Error with the argument that is wrong: also
    for NaN and for degrees Celsius.
    """
    return _core.band_radiance(checks.text("band", band), checks.kelvin("temperature_K", temperature_K))


def apparent_temperature(band: str, radiance: Any) -> Any:
    """Temperature of the black body that has a radiance in a band of wavelengths.

    band: as in scenes: "lwir", "8-12" or "8:12" [um]; radiance: a number or an array [W m-2 sr-1], 0 or more. Returns [K], a float
    or an array of the same shape. Raises diurna.Error with the argument that is wrong: also for NaN and negative radiance.
    """
    return _core.apparent_temperature(checks.text("band", band), checks.radiance("radiance", radiance))


class PathInBand(NamedTuple):
    """A path through the air in a band.

    `transmittance`: mean over wavelength, 0 to 1. `thermal_W_m2_sr`: radiance that the air emits along the path.
    `scattered_W_m2_sr`: radiance of scattered sunlight, 0 without `sun_zenith_deg`. `contrast_transmittance`: mean weighted by
    the derivative of Planck's law at 300 K, the share of a small difference in radiance that arrives.
    """

    transmittance: float
    thermal_W_m2_sr: float
    scattered_W_m2_sr: float
    contrast_transmittance: float


def path(
    bands: str | Sequence[str],
    profile: str = "US76",
    aerosol: str = "none",
    visibility_km: float = 23.0,
    co2_ppm: float | None = None,
    ground_km: float = 0.0,
    rain_mm_h: float = 0.0,
    *,
    height_km: float = 0.0,
    zenith_deg: float = 0.0,
    range_km: float | None = None,
    to_height_km: float | None = None,
    to_ground: bool = False,
    to_space: bool = False,
    sun_zenith_deg: float | None = None,
    azimuth_from_sun_deg: float = 0.0,
    ground_albedo: float = 0.2,
) -> dict[str, PathInBand]:
    """Transmittance and radiance of one path through the air, as `diurna path`.

    bands: a name or several, as in scenes: "lwir", "8-12" [um]; profile: one of diurna.profiles(), or a radiosonde file
    (.csv, .txt); aerosol: one of diurna.aerosols(); visibility_km: through it, 0.05 to 300; co2_ppm: 0 to 10000, None: today's;
    ground_km: height of the ground above the sea; rain_mm_h: 0 or more.
    The path starts at height_km above the sea (-0.5 to 1e6) under zenith_deg (0 up, 90 level, 180 down) and has one end:
    range_km, to_height_km, to_ground or to_space. sun_zenith_deg (0 to 180): adds scattered sunlight, with
    azimuth_from_sun_deg (-360 to 360) and ground_albedo (0 to 1).

    Returns a diurna.PathInBand for each band, by the name given. Raises diurna.Error with the argument that is wrong.
    """
    names = checks.texts("bands", bands, 'a band as "8-12" or "lwir"')
    air_path = _core.AirPath()
    air_path.height_km = checks.number("height_km", height_km, -0.5, 1e6, "km")
    air_path.zenith_deg = checks.number("zenith_deg", zenith_deg, 0, 180)
    air_path.range_km = checks.optional_number("range_km", range_km, 0, 1e7, "km")
    air_path.to_height_km = checks.optional_number("to_height_km", to_height_km, -0.5, 1e6, "km")
    air_path.to_ground = checks.flag("to_ground", to_ground)
    air_path.to_space = checks.flag("to_space", to_space)
    air_path.sun_zenith_deg = checks.optional_number("sun_zenith_deg", sun_zenith_deg, 0, 180)
    air_path.azimuth_from_sun_deg = checks.number("azimuth_from_sun_deg", azimuth_from_sun_deg, -360, 360)
    air_path.ground_albedo = checks.number("ground_albedo", ground_albedo, 0, 1)
    rows = _core.path(
        names,
        checks.text("profile", profile),
        checks.text("aerosol", aerosol),
        checks.number("visibility_km", visibility_km),
        _core.todays_co2_ppm if co2_ppm is None else checks.number("co2_ppm", co2_ppm),
        checks.number("ground_km", ground_km),
        checks.number("rain_mm_h", rain_mm_h),
        air_path,
    )
    return dict(zip(names, (PathInBand(*row) for row in rows)))
