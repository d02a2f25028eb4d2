#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scenes/job/run/stages.hpp"
#include "thermal/solve/representatives.hpp"

namespace diurna {

/// Facets that are solved for a scene's pictures, and the representatives of the others.
///
/// Solved are: facets visible in a picture, also in mirrors and through panes, with their
/// neighbours; all objects; ground that is thermally coupled to visible facets, or to the targets
/// in pictures; of the rest one representative of each kind (material, slope and aspect, height,
/// sky view); and a random sample, weighted by coupling, to measure the error.
struct NeededFacets {
    Representatives who;
    /// Facets solved although they have a representative: (probe) facet,
    /// representative.
    struct Probe {
        std::uint32_t facet, kind;
        double facets = 1.0;  // that it was drawn from: 1 / its probability
    };
    std::vector<Probe> probe;
    std::size_t seen = 0, coupled = 0, kinds = 0;
    /// Upper bound on the error of a picture's apparent temperature for an error of 1 K in all
    /// represented facets [K/K]: rms over the pixels of the worst picture of the represented share
    /// of their surroundings.
    double weight = 0.0;
};

/// - tolerance: [K] allowed rms error of pictures
/// - network: its facets are always solved
NeededFacets needed_facets(const Stages& stages, std::span<const NetworkObject> network,
                           double tolerance);

/// Difference of probes from their representatives [K]: rms over probes and instants.
double probed_difference(const NeededFacets& needed, const TemperatureField& field);

/// The same as an estimate for all facets that have a representative, coupled or not.
double represented_difference(const NeededFacets& needed, const TemperatureField& field);

/// NeededFacets::weight of other pictures and other solved facets.
///
/// - share: (facet) largest share of any of these pictures that it fills
///   (scenes/job/run/picture_shares.hpp)
/// - solved: (facet) 1 if its temperature is its own
double represented_weight(const Stages& stages, std::span<const NetworkObject> network,
                          const std::vector<float>& share, const std::vector<std::uint8_t>& solved);

}  // namespace diurna
