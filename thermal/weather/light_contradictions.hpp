#pragma once

#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// Measured light of a weather's samples from `begin` to `end` that contradicts itself, each kind
/// once, with the numbers of its first sample and how many there are:
///
/// - global light more than a quarter off the sum of direct and diffuse light on the horizontal
///   (BSRN's limits for good instruments are 8 and 15 %, Long & Shi 2008); direct and diffuse light
///   are used then (sun_rows.hpp)
/// - without direct light: diffuse light above the global by a tenth and 10 W/m2 (BSRN: 5 to 10 %)
/// - without diffuse light: direct light on the horizontal above the global by a quarter and 10
/// W/m2
/// - reflected light above the global by a tenth
/// - an overcast (cloud fraction 0.95 or more) beside a direct beam of 400 W/m2 or more: WMO counts
///   120 W/m2 as sunshine, thin cirrus may pass 300
///
/// For a sun above 10 degrees and light above 50 W/m2. Of means over intervals the sun's height is
/// the mean of five moments.
std::vector<Mistake> light_contradictions(const Weather& weather, const Site& site, Instant begin,
                                          Instant end, const std::string& where);

}  // namespace diurna
