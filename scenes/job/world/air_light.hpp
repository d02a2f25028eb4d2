#pragma once

#include <array>
#include <functional>
#include <map>
#include <span>
#include <utility>

#include "materials/air/moist_air.hpp"
#include "materials/atmosphere/band_model.hpp"
#include "terrain/place/sun.hpp"

namespace diurna {

/// Air at the ground and the sun over it, refracted.
struct AirMoment {
    AirState air;
    SunPosition sun;
};

/// Irradiance of level ground under a cloudless sky, and the longwave under a complete black cloud
/// [W m⁻²].
struct CloudlessLight {
    double direct_normal = 0.0, diffuse = 0.0;
    double longwave = 0.0, longwave_overcast = 0.0;
};

/// Broadband light of a scene's air at many moments, interpolated from ground_fluxes() at few: over
/// a table of air mass and vapour for sunlight, of temperature and vapour for longwave. The
/// tabulated value is the ratio to a broadband formula (Bird's clear sky, Dilley and O'Brien's,
/// σT⁴), which is smooth. Only corners of cells in use are computed, some 40 for a day, 150 for a
/// year, at 7 and 2 ms each.
///
/// Against ground_fluxes() at each moment: beam and diffuse 1.5 % (4 % at a visibility of 3 km)
/// and 1 W/m² (3 below 3°), longwave 1 W/m² (tests/scenes/air_light_test.cpp). Pictures are scaled
/// to these sums exactly (materials/atmosphere/light_of_instant.hpp).
class AirLight {
 public:
    /// - air_of: the scene's air, cloudless, for air at the ground
    /// - ground_km: above the sea, height of the light
    /// - moments: all that will be requested
    /// - sunlight, longwave, overcast: which of the three are needed
    struct Wanted {
        bool sunlight = true, longwave = true, overcast = true;
    };
    AirLight(const std::function<BandModel(const AirState&)>& air_of, double ground_km,
             std::span<const AirMoment> moments, const Wanted& wanted);

    CloudlessLight at(const AirMoment& moment) const;

 private:
    using Key = std::pair<int, int>;
    using Ratios = std::array<double, 2>;  // ln of beam's and diffuse's; longwave's, overcast's

    std::map<Key, Ratios> sunlight_;  // (air mass, vapour)
    std::map<Key, Ratios> longwave_;  // (temperature, vapour)
};

}  // namespace diurna
