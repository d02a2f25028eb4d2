#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "terrain/facets.hpp"

namespace diurna {

/// What a facet belongs to: the even part of its object's surface around it (neighbours over common
/// edges, turned by less than 20 degrees from one to the next), and the body whose vertices hang
/// together. Sizes as the wind meets them [m].
struct PartSize {
    float rise = 0.0f;       // of the even part, up its slope
    float breadth = 0.0f;    // its area over its perimeter
    float chord = 0.0f;      // its mean length along all directions: π · breadth, as if convex
    float across = 0.0f;     // of the body: the geometric mean of its two lesser sizes
    std::uint32_t body = 0;  // into ObjectBodies::body
};

/// A body as the upright box about it with the least plan.
struct BodyBox {
    Eigen::Vector2d middle, along;  // east, north [m]; unit
    double half_length, half_width;
    double bottom, top;  // up, in the frame of the facets
};

struct ObjectBodies {
    std::size_t first = 0;       // facet that `size` begins with
    std::vector<PartSize> size;  // (facet − first)
    std::vector<BodyBox> body;
};

/// first  of the facets of objects; those before it are ground
ObjectBodies object_parts(const FacetSet& facets, std::size_t first);

}  // namespace diurna
