#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "scenes/job/plan/check_work.hpp"
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
    Eigen::Vector3f eye;     // [m] of the observer
    float pixels = 0.0f;     // of one of its pictures, for each point drawn in it
};

struct CheckPoints {
    std::vector<CheckPoint> point;
    /// (patch) First for each point one of 5 cm, or a tenth of its facet, on ground with the normal
    /// of the smooth surface that the mesh describes (terrain/relief/smooth_normals.hpp); then for
    /// each its whole facet again: the first give the error of facets, the others the part of it
    /// due to the facets' number of rays.
    FacetSet patch;
    std::vector<std::uint32_t> like;  // (patch) its facet
    std::size_t skipped = 0;          // on panes, nets, sheets, targets, copies, movers

    static constexpr int rays = check_rays;                // to sky and surroundings
    static constexpr int sun_samples = check_sun_samples;  // to the sun's disc
};

/// Draws points evenly over the pictures of every observer with a band beyond 3 µm, the same number
/// in each: over its frames, and over the part of its picture with facets. None where no observer
/// has such a band. The same for the same seed.
///
/// - network: targets, whose facets exchange heat by conduction, so points on them are skipped
/// - count: for all pictures, at most
CheckPoints check_points(const Stages& stages, std::span<const NetworkObject> network, int count);

/// The patches with their view factors at a stage, by CheckPoints::rays rays each.
BesideFacets patches_at(const CheckPoints& points, const Prepared& prepared);

/// The sunlit share of the patches at some instants of a stage, and the times of shadows' edges.
SunExposure sun_at(const CheckPoints& points, const Prepared& prepared,
                   const std::vector<Instant>& instants);

}  // namespace diurna
