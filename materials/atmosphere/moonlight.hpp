#pragma once

namespace diurna {

struct MoonLight {
    double phase_deg = 0.0;         // angle sun - moon - observer, 0 full, 180 new
    double distance_km = 384400.0;  // from the observer
    double sun_distance_au = 1.0;   // of the moon
};

/// Moonlight counts below this [µm]; beyond, the heat of all things outshines it.
inline constexpr double moonlight_ends_um = 3.0;

/// Irradiance of moonlight over that of the sun at 1 AU, both above the air, 0.35 to 3 µm; beyond,
/// none. Times anything this program gives for sunlight at 1 AU (solar_at_nodes, SunField) it is
/// that for the moon at the sun's place.
///
/// Visual magnitude -12.73 + 0.026 |φ| + 4e-9 φ⁴ (Allen 1976) against the sun's -26.75; colour from
/// the disk's mean reflectance rising 1 to 2.2 times from 0.55 to 2.5 µm (rounded from Kieffer and
/// Stone 2005, doi:10.1086/430185). About 15 %; within 7° of full the moon is up to 35 % brighter
/// than this (opposition), its own heat is skipped. Of the sun's 1361 W m⁻² the full moon sends
/// 0.004, which no heat balance notices.
/// Throws InputError for a phase outside 0 to 180 or a distance that is not the moon's.
double moon_over_sun(double wavelength_um, const MoonLight& moon);

/// Share of the moon's disk that is lit, (1 + cos phase) / 2.
double lit_share(const MoonLight& moon);

}  // namespace diurna
