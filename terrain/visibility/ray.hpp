#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>

#include "terrain/facets.hpp"
#include "terrain/visibility/copies.hpp"

namespace diurna {

struct Ray {
    Eigen::Vector3f origin;     // east-north-up [m]
    float near = 0.0f;          // [m] along the direction
    Eigen::Vector3f direction;  // unit
    float far = 1e30f;
    float time = 0.5f;  // in scenes with motion (FacetMotion), 0 to 1
};

struct Hit {
    FacetId facet = no_facet;      // no_facet: nothing was hit
    float range = 0.0f;            // [m], recomputed in double from the facet's corners
    std::uint32_t copy = no_copy;  // copy in which the facet was hit
};

/// Sixteen incoherent rays side by side, from 0 to infinity.
struct RayPacket {
    alignas(64) std::array<float, 16> origin_x, origin_y, origin_z;
    alignas(64) std::array<float, 16> direction_x, direction_y, direction_z;  // unit
};

}  // namespace diurna
