"""What does a climbing camera see? A program moves it from 120 to 300 m within an hour."""

import pathlib

import numpy as np

import diurna

sample = pathlib.Path(diurna.data_folder()).parent / "scenes" / "crossover" / "scene.toml"

# %% The stepper frees its memory at the end of the block
with diurna.Scene(sample).stepper() as stepper:
    pose = stepper.observer("drone")
    for minute in range(0, 61, 20):
        stepper.advance(np.datetime64("2026-07-15T10:00:00") + np.timedelta64(minute, "m"))
        pose.position_m = pose.position_m + np.array([0.0, 0.0, 60.0])
        frame = stepper.picture("drone", pose)
        print(frame.instant, f"height {pose.position_m[2]:.0f} m, mean {np.nanmean(frame['apparent_temperature.8-12']):.2f} K")
