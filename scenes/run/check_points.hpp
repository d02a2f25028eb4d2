#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "scenes/run/stages.hpp"
#include "thermal/solve/network_object.hpp"
#include "thermal/solve/representatives.hpp"
#include "thermal/solve/solve_input.hpp"

/// Places in pictures whose heat is solved beside that of facets: what facets' size, and the few
/// rays each has, leave is the difference (scenes/run/check_error.hpp).
namespace diurna {

struct CheckPoint {
    std::uint32_t surface;   // of World::surfaces(), the one that the place is part of
    std::uint32_t observer;  // of the scene's, in whose picture it is
    Eigen::Vector3f place;   // [m]
};

struct CheckPoints {
    std::vector<CheckPoint> point;
    /// (patch) First of each point one of 5 cm, or a tenth of its facet; then of each its whole
    /// facet once more. What they see is found by `rays` rays: the first tell what facets leave,
    /// the others how much of it is by the rays that facets have.
    BesideFacets beside;
    std::size_t skipped = 0;  // of the places drawn: on panes, nets, sheets, targets, copies

    static constexpr int rays = 4096;       // to sky and surroundings
    static constexpr int sun_samples = 64;  // to the sun's disc
};

/// Draws places evenly over the pictures of every observer, as many in each: along its frames, and
/// over its picture where that shows a facet. The same for the same seed.
///
/// - network: targets, whose facets carry heat to each other, so that a place has none of its own
/// - count: of all pictures, at most
CheckPoints check_points(const Stages& stages, std::span<const NetworkObject> network, int count);

/// The share of the sun that reaches them at some instants, and when shadows' edges pass.
SunExposure sun_at(const CheckPoints& points, const Prepared& prepared,
                   const std::vector<Instant>& instants);

}  // namespace diurna
