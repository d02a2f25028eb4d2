#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>

#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// Bundles of sixteen coherent rays, the samples of a pixel each, side by side so that whole rows
/// of pixels can be prepared, traced and read in turn. From 0 to infinity, all sixteen lanes in
/// use. For one thread.
class RayBundles {
 public:
    static constexpr std::size_t lanes = 16;
    /// Room for this many bundles; holds a reference to the scene.
    RayBundles(const RayScene& scene, std::size_t most);
    ~RayBundles();
    RayBundles(const RayBundles&) = delete;
    RayBundles& operator=(const RayBundles&) = delete;

    // (bundle, lane) To be written: origins of the rays [m], and their unit directions.
    float *origin_x, *origin_y, *origin_z;
    float *direction_x, *direction_y, *direction_z;
    float* time;  // in scenes with motion (FacetMotion), 0 to 1; initially 0.5
    void set_origin(const Eigen::Vector3f& origin);  // of all of them

    /// The nearest facet of each ray of the first `bundles` bundles.
    void closest(std::size_t bundles);
    const std::uint32_t* facet;  // (bundle, lane) its number (copies.hpp); index(no_facet): nothing
                                 // was hit
    const float* range;  // (bundle, lane) [m]; recomputed in double at grazing incidence (below
                         // 3°) and on copies, within 2e-5 of it elsewhere

 private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace diurna
