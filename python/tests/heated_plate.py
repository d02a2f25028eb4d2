"""A scene with a closed form: thin black plates in a vacuum without sun, so that sigma T^4 = q.

One has 200 to 400 W/m2 from 6 to 12 h of the scene's clock and back to 200 at 18 h, in a plain with 300 W/m2 all day,
seen from 60 m above: they cross at 9 and 15 h. (tests/support/heated_plate.hpp has the same for C++.)
"""

import pathlib
import shutil

import diurna

samples = pathlib.Path(diurna.data_folder()).parent / "scenes"

SIGMA = 5.670374419e-8  # CODATA 2018
LONGITUDE = -84.203333


def kelvin(heat):
    return (heat / SIGMA) ** 0.25


def heated_plate(folder, **more):
    """Lays the scene's files into a folder and returns the scene as a dictionary, with further tables."""
    for name in ("level.asc", "level.prj"):
        shutil.copy(samples / "crossover" / name, folder / name)
    rows = ["time,air_temperature_K,shortwave_down_W_m2,direct_normal_W_m2,diffuse_W_m2,longwave_down_W_m2"]
    rows += [f"2026-07-{14 + h // 24:02}T{h % 24:02}:00:00-04:00,290,0,0,0,0" for h in range(49)]
    (folder / "dark.csv").write_text("\n".join(rows) + "\n")
    sheet = {"thickness_m": 0.001, "conductivity_W_mK": 1.0, "density_kg_m3": 10.0, "heat_capacity_J_kgK": 1000.0}
    black = {
        "like": "asphalt",
        "emissivity": 1.0,
        "albedo": 0.0,
        "internal_heat_W_m2": 300.0,
        "convection": {"kind": "constant", "value_W_m2K": 0.0},
        "evaporation": {"kind": "none"},
        "store": {"capacity_mm": 0},
        "bottom": {"kind": "flux", "value_W_m2": 0.0},
        "layers": [sheet],
    }
    return {
        "scene": {"name": "plain"},
        "site": {"latitude_deg": 36.32, "longitude_deg": LONGITUDE},
        "terrain": {"elevation": "level.asc", "radius_m": 300.0, "material": "black"},
        "material": {
            "black": black,
            "heated": {"like": "black", "internal_schedule": [[6.0, 200.0], [12.0, 400.0], [18.0, 200.0]]},
        },
        "weather": {"file": "dark.csv", "interval": "instant"},
        "atmosphere": {"profile": "vacuum"},
        "time": {"start": "2026-07-15T00:00:00-04:00", "frame_every_s": 21600.0},
        "ground": [
            {
                "name": "plate",
                "material": "heated",
                "rectangle_m": [0.0, 0.0, 30.0, 30.0, 0.0],
                "largest_edge_m": 10.0,
            }
        ],
        "observer": [
            {
                "name": "drone",
                "place_m": [0.0, 0.0],
                "height_above_ground_m": 60.0,
                "azimuth_deg": 0.0,
                "elevation_deg": -90.0,
                "horizontal_fov_deg": 60.0,
                "width": 48,
                "height": 32,
                "samples": 4,
                "bands": ["8-12"],
            }
        ],
        **more,
    }

