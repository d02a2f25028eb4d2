#pragma once

#include <string>

#include "materials/base/section.hpp"
#include "scenes/input/read_terrain.hpp"

namespace diurna {

/// A place on a sphere about an object, from where its middle is looked at: that of the upright box
/// around it that faces as it does, as labels have it.
struct Around {
    std::string object;
    double range = 0.0;          // [m] to that middle
    double aspect_deg = 0.0;     // 0 before its front, 90 on its right-hand side
    double elevation_deg = 0.0;  // above its level
    bool draw_again = false;     // another aspect where the object is hidden
    double heading_deg = 0.0;    // of the object
    Eigen::Vector2d place = Eigen::Vector2d::Zero();  // of the object, east, north [m]

    /// The eye's, near enough for what asks how far it is.
    Eigen::Vector2d eye() const;
};

/// The table `around` of an observer. Objects and buildings of the terrain are known already.
Around read_around(const Section& section, const TerrainInput& terrain);

}  // namespace diurna
