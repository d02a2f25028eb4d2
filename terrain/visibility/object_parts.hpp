#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "terrain/facets.hpp"

namespace diurna {

/// Sizes [m] of a facet's surroundings as used for convection: of the smooth part of its object's
/// surface around it (neighbours over common edges, at angles of less than 20 degrees), and of the
/// body, whose vertices are connected.
struct PartSize {
    float rise = 0.0f;       // of the smooth part, along its slope
    float breadth = 0.0f;    // its area over its perimeter
    float chord = 0.0f;      // its mean length over all directions: π · breadth, as if convex
    float across = 0.0f;     // of the body: geometric mean of its two smaller sizes
    std::uint32_t body = 0;  // into ObjectBodies::body
};

/// A body's upright bounding box with the smallest plan area.
struct BodyBox {
    Eigen::Vector2d middle, along;  // east, north [m]; unit
    double half_length, half_width;
    double bottom, top;  // heights in the frame of the facets
};

struct ObjectBodies {
    std::size_t first = 0;       // facet that `size` begins with
    std::vector<PartSize> size;  // (facet − first)
    std::vector<BodyBox> body;
};

/// first  first facet of objects; those before it are ground
ObjectBodies object_parts(const FacetSet& facets, std::size_t first);

}  // namespace diurna
