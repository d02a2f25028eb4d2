#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "scenes/job/run/stages.hpp"
#include "thermal/solve/network_object.hpp"
#include "thermal/solve/representatives.hpp"
#include "thermal/solve/solve_input.hpp"

/// Points in pictures that are solved in addition to facets: the difference is the error due to
/// facets' size, and to their limited number of rays (scenes/job/run/check_error.hpp).
namespace diurna {

struct CheckPoint {
    SurfaceId surface;       // of World::surfaces(), that of the point
    std::uint32_t observer;  // of the scene's, in whose picture it is
    Eigen::Vector3f place;   // [m]
};

struct CheckPoints {
    std::vector<CheckPoint> point;
    /// (patch) First for each point one of 5 cm, or a tenth of its facet, on ground with the normal
    /// of the smooth surface that the mesh describes (terrain/relief/smooth_normals.hpp); then for
    /// each its whole facet again. Their view factors use `rays` rays: the first patches give the
    /// error of facets, the others the part of it due to the facets' number of rays.
    BesideFacets beside;
    std::size_t skipped = 0;  // points on panes, nets, sheets, targets, copies

    static constexpr int rays = 4096;       // to sky and surroundings
    static constexpr int sun_samples = 64;  // to the sun's disc
};

/// Draws points evenly over the pictures of every observer, the same number in each: over its
/// frames, and over the part of its picture with facets. The same for the same seed.
///
/// - network: targets, whose facets exchange heat by conduction, so points on them are skipped
/// - count: for all pictures, at most
CheckPoints check_points(const Stages& stages, std::span<const NetworkObject> network, int count);

/// The sunlit share of the points at some instants, and the times of shadows' edges.
SunExposure sun_at(const CheckPoints& points, const Prepared& prepared,
                   const std::vector<Instant>& instants);

}  // namespace diurna
