"""How much of a difference of one kelvin at 300 K remains behind 1 to 10 km of summer air, in two bands?

The mean transmittance of a band overestimates it: a body emits most where the air absorbs. `contrast_transmittance` is
weighted by the body's own spectrum.
"""

import diurna

for band in ("3-5", "8-12"):
    step = diurna.band_radiance(band, 300.5) - diurna.band_radiance(band, 299.5)
    for range_km in (1, 2, 5, 10):
        air = diurna.path(band, "MLS", "rural", 23.0, zenith_deg=90, range_km=range_km)[band]
        through = air.contrast_transmittance
        seen = through * diurna.band_radiance(band, 300.0) + air.thermal_W_m2_sr
        warmer = diurna.apparent_temperature(band, seen + through * step)
        left = warmer - diurna.apparent_temperature(band, seen)
        print(f"{band} um, {range_km:2} km: transmittance {through:.3f}, apparent difference {left:.3f} K")
