#pragma once

namespace diurna {

struct MoonLight {
    double phase_deg = 0.0;         // angle sun - moon - observer, 0 full, 180 new
    double distance_km = 384400.0;  // from the observer
    double sun_distance_au = 1.0;   // of the moon
};

/// Moonlight is computed below this wavelength [µm]; above it thermal emission exceeds it.
inline constexpr double moonlight_ends_um = 3.0;

/// Ratio of moonlight to sunlight at 1 AU, both above the air, 0.35 to 3 µm; zero beyond.
/// Multiplied by any sunlight of this program at 1 AU (solar_at_nodes, SunField) it gives the light
/// of a moon at the sun's position.
///
/// Visual magnitude -12.73 + 0.026 |φ| + 4e-9 φ⁴ (Allen 1976) against the sun's -26.75; colour from
/// the disk's mean reflectance rising 1 to 2.2 times from 0.55 to 2.5 µm (rounded from Kieffer and
/// Stone 2005, doi:10.1086/430185). About 15 %; within 7° of full the moon is up to 35 % brighter
/// than this (opposition); its thermal emission is not included. The full moon sends 0.004 of the
/// sun's 1361 W m⁻², which is negligible in the heat balance.
/// Throws InputError for a phase outside 0 to 180 or a distance outside the moon's range.
double moon_over_sun(double wavelength_um, const MoonLight& moon);

/// Share of the moon's disk that is lit, (1 + cos phase) / 2.
double lit_share(const MoonLight& moon);

}  // namespace diurna
