#pragma once

#include <memory>

#include "materials/air/moist_air.hpp"
#include "materials/air/profile.hpp"

namespace diurna {

/// How the air near the ground changes with height, from weather measured at one height: the one
/// rule by which facets and lines of sight have the same air.
///
/// Temperature falls by a constant lapse, or follows a profile (inversions included) moved to meet
/// the weather at the station; what it is moved by fades linearly to nothing over `mixed_depth`
/// above the station. Pressure is hydrostatic from the station's, by the virtual temperature in
/// between. Vapour pressure falls by exp(−vapour_fall Δz), the mean of the year of Kunkel's monthly
/// coefficients (1989, J. Climate 2, 656) as MicroMet has them (Liston & Elder 2006, J.
/// Hydrometeor. 7, 217: 0.33 to 0.42 km⁻¹), or by the profile's mixing ratio; never above
/// saturation over water. Wind is left as it is: MicroMet and its kind change it by slope and
/// curvature, of height alone no published rule holds from one range of hills to the next.
/// Cold pools, the air that drains into hollows at night, are not modelled.
struct AirByHeight {
    double station = 0.0;    // [m] above the sea, where the weather was measured
    double lapse = -6.5e-3;  // [K m⁻¹] dT/dz; ICAO's. 0 without a profile: all air is
                             // the station's, its pressure too
    std::shared_ptr<const Profile> profile{};  // in place of `lapse`; null: none

    bool same_everywhere() const { return !profile && lapse == 0.0; }
};
inline constexpr double vapour_fall = 0.379e-3;  // [m⁻¹]
inline constexpr double mixed_depth = 1500.0;    // [m]

/// The air at a height [m] above the sea under a station's.
AirState air_at_height(const AirByHeight& rule, const AirState& station, double height);

/// A profile whose lowest part is that air, at every height from `low` to `high` [m] above the sea
/// to 0.01 K, 0.01 % of pressure and 0.2 % of vapour (1 % where saturation sets in); above, what
/// it was changed by fades to nothing over `mixed_depth`. With the same air everywhere: as
/// with_surface at the station.
Profile profile_over(Profile free_air, const AirByHeight& rule, const AirState& station, double low,
                     double high);

}  // namespace diurna
