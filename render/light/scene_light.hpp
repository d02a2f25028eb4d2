#pragma once

#include <span>
#include <vector>

#include "render/light/band_light.hpp"
#include "render/light/bounces.hpp"
#include "render/light/lit_facets.hpp"
#include "render/light/radiosity.hpp"

namespace diurna {

/// All light of a scene at an instant, in several bands: incident on the lit facets, and exchanged
/// between them.
struct SceneLight {
    /// - input, lit: must outlive it; `lit` of these bands
    /// - bounces: maximum number of interreflections
    /// - tolerance: [K] of apparent temperature
    SceneLight(const RadianceInput& input, const LitFacets& lit, std::span<const Band> bands,
               int bounces, double tolerance);
    SceneLight(const SceneLight&) = delete;  // its parts refer to each other

    const RadianceInput& input;
    const LitFacets& lit;
    LitState state;
    std::vector<BandLight> band;
    std::vector<BounceOptions> bounces;  // (band)
    RadiosityTables tables;
    Radiosity radiosity;
};

}  // namespace diurna
