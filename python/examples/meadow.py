"""A level meadow on a clear July day as a dictionary. The other examples add objects and studies to it."""

import pathlib
import tempfile

import diurna

samples = pathlib.Path(diurna.data_folder()).parent / "scenes"


def plate(name, material, east_m, north_m, size_m=6.0):
    """A square of another material in it, at a place of the site [m]."""
    return {
        "name": name,
        "material": material,
        "rectangle_m": [east_m, north_m, size_m, size_m, 0.0],
        "largest_edge_m": 3.0,
    }


def drone(**more):
    """A camera that looks straight down on it; keys given by name replace its own."""
    return {
        "name": "drone",
        "place_m": [0.0, 0.0],
        "height_above_ground_m": 60.0,
        "azimuth_deg": 0.0,
        "elevation_deg": -90.0,
        "horizontal_fov_deg": 30.0,
        "width": 64,
        "height": 48,
        "bands": ["8-12"],
        **more,
    }


def meadow(**more):
    """The scene; tables given by name are added or replace its own."""
    return {
        "scene": {"name": "meadow"},
        "site": {"latitude_deg": 36.32, "longitude_deg": -84.203333},
        "terrain": {"elevation": samples / "crossover" / "level.asc", "radius_m": 100.0, "material": "grass"},
        "weather": {"file": samples / "jacksboro" / "weather.csv", "interval": "instant", "wind_height_m": 10.0},
        "atmosphere": {"profile": "MLS", "visibility_km": 23.0},
        "time": {"start": "2026-07-15T00:00:00-04:00", "step_s": 1200.0, "frame_every_s": 3600.0},
        "observer": [drone()],
        **more,
    }


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        scene = diurna.Scene(meadow(), file=pathlib.Path(folder) / "meadow.toml")
        print(scene.check())
        print(scene.plan())
