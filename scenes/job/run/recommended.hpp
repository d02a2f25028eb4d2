#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "scenes/job/plan/prepared.hpp"

/// Settings that bring the measured error of a run (scenes/job/run/check_error.hpp) below its
/// tolerance.
namespace diurna {

/// Parts of the mean square difference at check points [K²].
struct ErrorParts {
    double ground_rays = 0.0;  // rays to the sky and to neighbours, of ground
    double object_rays = 0.0;  // the same of buildings and objects
    double sun_rays = 0.0;     // rays to the sun's disc
    double size = 0.0;         // facets are larger than places

    double all() const { return ground_rays + object_rays + sun_rays + size; }
};

/// One setting, and the part that it reduces.
struct Recommended {
    std::string key;  // "scene.sky_rays", "scene.finer_edges"
    double value = 0.0;
    std::string part;    // description
    double share = 0.0;  // of the mean square that it reduces, 0 to 1
};

/// The fewest settings with which the expected rms is nine tenths of `tolerance` [K], the largest
/// part first: only the largest if that is enough, otherwise all parts by the same factor.
///
/// Mean squares fall as 1/number of rays, and with the facets' edge: most of that part is due to
/// shadows' edges, which cross a share of the facets that is proportional to it. Values do not
/// exceed the keys' ranges.
std::vector<Recommended> recommended_settings(const ErrorParts& parts, const Scene& scene,
                                              double tolerance);

/// "scene.sky_rays = 256 (rays of the ground, 80 % of the mean square), ..."
std::string in_words(const std::vector<Recommended>& settings);

}  // namespace diurna
