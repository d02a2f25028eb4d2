#pragma once

#include <memory>

#include "materials/air/moist_air.hpp"
#include "materials/air/profile.hpp"

namespace diurna {

/// How the air near the ground changes with height above or below the weather's measuring height.
/// Facets and lines of sight use this one rule, so both have the same air.
///
/// Temperature falls by a constant lapse rate, or follows a profile (inversions included) shifted
/// to match the weather at the station; the shift fades linearly to zero over `mixed_depth` above
/// the station. Pressure is hydrostatic from the station's, by the virtual temperature in between.
/// Vapour pressure falls by exp(−vapour_fall Δz), with the annual mean of Kunkel's monthly
/// coefficients (1989, J. Climate 2, 656) as in MicroMet (Liston & Elder 2006, J. Hydrometeor. 7,
/// 217: 0.33 to 0.42 km⁻¹), or by the profile's mixing ratio; never above saturation over water.
/// Wind is not changed: MicroMet and similar models change it by slope and curvature, and no
/// published rule for height alone is valid for all ranges of hills.
/// Cold pools, the air that drains into hollows at night, are not modelled.
struct AirByHeight {
    double station = 0.0;    // [m] above the sea, where the weather was measured
    double lapse = -6.5e-3;  // [K m⁻¹] dT/dz; ICAO's. 0 without a profile: all air has the
                             // station's temperature and pressure
    std::shared_ptr<const Profile> profile{};  // replaces `lapse`; null: no profile

    bool same_everywhere() const { return !profile && lapse == 0.0; }
};
inline constexpr double vapour_fall = 0.379e-3;  // [m⁻¹]
inline constexpr double mixed_depth = 1500.0;    // [m]

/// The air at a height [m] above the sea, from the station's air.
AirState air_at_height(const AirByHeight& rule, const AirState& station, double height);

/// A profile whose lowest part is that air, at every height from `low` to `high` [m] above the sea,
/// to 0.01 K, 0.01 % of pressure and 0.2 % of vapour (1 % at saturation); above, the change fades
/// to zero over `mixed_depth`. With the same air everywhere: as with_surface() at the station.
/// with_surface at the station.
Profile profile_over(Profile free_air, const AirByHeight& rule, const AirState& station, double low,
                     double high);

}  // namespace diurna
