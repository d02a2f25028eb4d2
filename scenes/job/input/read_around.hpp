#pragma once

#include <string>

#include "materials/base/section.hpp"
#include "scenes/job/input/read_terrain.hpp"

namespace diurna {

/// A position on a sphere around an object, looking at its middle: that of the upright box around
/// it along its heading, as in labels.
struct Around {
    std::string object;
    double range = 0.0;                               // [m] to that middle
    double aspect_deg = 0.0;                          // 0 in front of it, 90 on its right-hand side
    double elevation_deg = 0.0;                       // above its level
    bool draw_again = false;                          // another aspect if the object is hidden
    double heading_deg = 0.0;                         // of the object
    Eigen::Vector2d place = Eigen::Vector2d::Zero();  // of the object, east, north [m]

    /// The eye's position, approximately, for distances.
    Eigen::Vector2d eye() const;
};

/// The table `around` of an observer. Objects and buildings of the terrain are known already.
Around read_around(const Section& section, const TerrainInput& terrain);

}  // namespace diurna
