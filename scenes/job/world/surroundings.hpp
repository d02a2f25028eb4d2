#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/stance.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/visibility/ray_scene.hpp"

/// Estimated difference between the temperatures of two copies of an object due to their
/// surroundings.
namespace diurna {

/// Surroundings of an object at probes spread evenly over its surface.
struct Surroundings {
    double heading_deg = 0.0;
    Eigen::Matrix3d to_level = Eigen::Matrix3d::Identity();  // removes its pitch and roll
    float wind = 1.0f;                                       // share of it (wind.hpp)
    std::vector<std::uint8_t> beam{};    // (instant, probe) sunlit share, of 255
    std::vector<std::uint8_t> around{};  // (probe, ray) 0: sky; else its material's kind
};

/// Sun positions of a span and probes of an object's facets, to compare its
/// copies.
///
/// The estimate: at each half hour of up to three days (the first, the middle, the last) with the
/// sun up, and at each probe, the difference in absorption of
/// - a clear day's beam, 1353 W/m² 0.7^(m^0.678) with the air mass m of Kasten & Young (1989)
///   (Meinel & Meinel 1976, Applied Solar Energy, ch. 2), by the probe's own normal and share;
/// - surroundings: 24 rays, cosine-weighted; for those that meet sky at one place and not at the
///   other 150 W/m² (a clear sky's deficit and its diffuse light), for those that meet materials of
///   different kinds 100 W/m² (15 K at 6.5 W/m²K);
/// divided by 8.3 W/m²K, a surface's film and longwave in still air (ASHRAE Handbook, Fundamentals,
/// ch. 26: vertical, emittance 0.9); plus 13 K times the difference of the shares of wind (a sheet
/// 20 K above the air, with 10 of its 15 W/m²K due to wind). Heat storage and conduction would
/// reduce it.
class SurroundingsSampler {
 public:
    static constexpr std::size_t probes = 96, rays = 24;
    static constexpr double furthest_heading_deg = 5.0;  // of copies that may be compared

    /// - first, count: of the world's facets, the object at its first place; holds a reference to
    ///   the
    ///   world
    /// - stance: at that place
    SurroundingsSampler(const World& world, const Scene& scene, std::size_t first,
                        std::size_t count, const Stance& stance);

    /// For a copy.
    ///
    /// - pose: from the first place to its own
    Surroundings at(const RayScene& scene, const Eigen::Isometry3d& pose, const Stance& stance,
                    float wind) const;

    struct Apart {
        double mean = 0.0;   // [K] over the surface at the worst instant
        double worst = 0.0;  // [K] at a probe
    };
    /// The estimate; `mean` is infinite if it exceeds `most` or the headings differ too
    /// much.
    Apart apart(const Surroundings& a, const Surroundings& b, double most) const;

 private:
    struct Probe {
        std::size_t facet;
        double u, v;             // on it
        Eigen::Vector3d normal;  // in the first place
        double absorptance;
    };
    struct Sun {
        Eigen::Vector3d to;  // unit
        double beam;         // [W/m²] across it
    };
    const World& world_;
    std::vector<Probe> probe_;
    std::vector<Sun> sun_;
    std::vector<std::uint8_t> kind_;      // (material) from 1
    std::vector<Eigen::Vector3d> north_;  // (probe) normals with the object level, heading north
};

}  // namespace diurna
