#pragma once

#include <algorithm>

#include "materials/air/profile.hpp"

namespace diurna {

/// The same temperature [K] at every level: the air of an enclosure.
inline Profile isothermal(Profile profile, double temperature) {
    std::fill(profile.temperature.begin(), profile.temperature.end(), temperature);
    return profile;
}

}  // namespace diurna
