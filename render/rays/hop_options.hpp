#pragma once

#include "render/light/lit_facets.hpp"

namespace diurna {

/// How the light of hops is worked out.
struct HopOptions {
    int bounces = all_bounces;  // of light between surfaces (bounces.hpp)
    double tolerance = 1e-3;    // [K] of the tables, in apparent temperature
    bool by_term = true;        // the terms of a facet's radiance one by one
};

}  // namespace diurna
