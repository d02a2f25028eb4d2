"""A camera that a program drives: up from 120 to 300 m while an hour goes by."""

import pathlib

import numpy as np

import diurna

sample = pathlib.Path(diurna.data_folder()).parent / "scenes" / "crossover" / "scene.toml"
stepper = diurna.Scene(sample).stepper()
pose = stepper.observer("drone")
for minute in range(0, 61, 20):
    stepper.advance(np.datetime64("2026-07-15T10:00:00") + np.timedelta64(minute, "m"))
    pose.position_m = pose.position_m + np.array([0.0, 0.0, 60.0])
    frame = stepper.picture("drone", pose)
    print(frame.instant, f"height {pose.position_m[2]:.0f} m, mean {np.nanmean(frame['apparent_temperature.8-12']):.2f} K")
