#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scenes/run/stages.hpp"
#include "thermal/solve/representatives.hpp"

namespace diurna {

/// Which facets a scene's pictures need the heat of, and who stands for the others.
///
/// Solved are: facets that a picture sees, in mirrors and through panes too, with their neighbours;
/// all objects; ground whose warmth facets seen feel, or the targets in pictures; of the rest one
/// of each kind (material, slope and aspect, height, sky view) for all of its kind; and some drawn
/// by how much of them is felt, to measure what that costs.
struct NeededFacets {
    Representatives who;
    /// Facets solved and stood for, too: (probe) the facet, and the one of its kind.
    struct Probe {
        std::uint32_t facet, kind;
    };
    std::vector<Probe> probe;
    std::size_t seen = 0, coupled = 0, kinds = 0;
    /// What an error of 1 K in all that is stood for would make of a picture's apparent temperature
    /// at most [K/K]: rms over the pixels of the worst picture of the share of its surroundings
    /// that is stood for.
    double weight = 0.0;
};

/// - tolerance: [K] that pictures may be worse by, rms
/// - network: whose facets are solved in any case
NeededFacets needed_facets(const Stages& stages, std::span<const NetworkObject> network,
                           double tolerance);

/// How far probes are from those of their kind [K]: rms over probes and instants.
double probed_difference(const NeededFacets& needed, const TemperatureField& field);

}  // namespace diurna
