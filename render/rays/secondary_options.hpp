#pragma once

#include "render/light/lit_facets.hpp"

namespace diurna {

class PathTable;

/// How the light of secondary rays is computed.
struct SecondaryOptions {
    int bounces = all_bounces;  // of light between surfaces (bounces.hpp)
    double tolerance = 1e-3;    // [K] of the tables, in apparent temperature
    bool by_term = true;        // the terms of a facet's radiance separately
    /// Of the whole picture: used if it covers the secondary rays.
    const PathTable* path = nullptr;
};

}  // namespace diurna
