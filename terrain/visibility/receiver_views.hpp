#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>

#include "terrain/facets.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/view_factors.hpp"

namespace diurna {

/// A small flat receiver of light: it receives light from the scene but does not affect it.
struct Receiver {
    Eigen::Vector3d place;   // east, north, up [m]
    Eigen::Vector3d normal;  // unit
};

/// Receivers as facets of 1 cm², in their order, for the functions that take facets.
FacetSet receiver_facets(std::span<const Receiver> receivers);

struct ReceiverViewOptions {
    int rays = 4096;                // of each, 1 to 65535
    std::size_t ground_facets = 0;  // number of the scene's first facets, a height field
    std::uint64_t seed = 1;
    bool sunlight = false;  // transmittance of facets for the sun's spectrum; else thermal
};

/// Views of each receiver, as facet_views() for facets: row r of the result is receiver r, and its
/// entries are facets of the scene (copies count as their originals). Stratified, cosine-weighted:
/// the standard error of a view factor of 0.5 is about 0.65 / rays^0.75 = 0.0013 at 4096 rays
/// (view_factor_sampling.hpp).
FacetViews receiver_views(std::span<const Receiver> receivers, const FacetSet& facets,
                          const RayScene& scene, const ReceiverViewOptions& options);

}  // namespace diurna
