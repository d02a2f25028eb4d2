#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "terrain/relief/height_field.hpp"
#include "terrain/visibility/object_boxes.hpp"
#include "terrain/visibility/raised_relief.hpp"
#include "terrain/visibility/relief_points.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"

namespace diurna {

/// Sun and sky on facets of which the first are on a relief that is also available as a grid: for
/// these by the march over the grid (relief/horizon.hpp), which is exact and ten times faster than
/// rays; for shadow edges, objects, and ground that objects may shade, by rays.
///
/// A ground facet evaluates the horizon at points spread evenly over it (relief_points.hpp). If all
/// posts around them agree that the sun's whole disc is visible, or hidden, that is the result;
/// else rays decide, as they do where an object may be in the way (object_boxes.hpp). A facet of
/// more than two cells smooths the relief: at each of its points the grid's own normal and horizon
/// are used, so that it receives the mean light of the fine relief.
class ReliefVisibility {
 public:
    /// Holds references to `facets`, `rays` and `relief`. The first `ground_facets` are on the
    /// relief, within its tolerance.
    ///
    /// - finer: (ground facet) 1 if the mesh is finer than the relief (on a detail of the
    ///   raster):
    ///   always by rays; empty: none
    ReliefVisibility(const FacetSet& facets, const RayScene& rays, const HeightField& relief,
                     std::size_t ground_facets, std::span<const std::uint8_t> finer = {});

    /// Like `sun_fraction` of sun_fraction.hpp. For a facet of more than two cells it is the mean
    /// over its points of visible disc × cosine of incidence, divided by the cosine on the facet
    /// itself: the product of both is the beam received by the fine relief, so it may exceed one.
    /// It is zero if the facet itself faces away from the sun. Returns the number of facets decided
    /// by rays.
    ///
    /// - known: (facet) 1: keeps its value; empty: none
    std::size_t sun_fraction(const Eigen::Vector3d& direction, std::span<float> fraction,
                             const SunFractionOptions& options = {},
                             std::span<const std::uint8_t> known = {}) const;

    /// Like `facet_views` of view_factor_sampling.hpp: view factors by rays; on the ground the
    /// sky's share by the march (32 azimuths), and the rows scaled to the remainder. Where objects
    /// may hide more than 0.001 of the sky from the ground, more rays are used.
    FacetViews facet_views(const FacetViewOptions& options = {}) const;

 private:
    /// Tangents of the horizon, (post).
    struct Horizons {
        std::vector<float> relief, raised;  // `raised` is empty without objects
    };
    struct Span {
        float low, high;
    };
    /// Sky seen from ground facets, times the number of azimuths; `below_objects`: above `raised`.
    struct MarchedSky {
        std::vector<float> seen, below_objects;
        std::vector<std::uint8_t> rise;  // (ground facet, azimuth) highest horizon, objects
                                         // included, in steps of 1/64 of the tangent, rounded up
    };

    Horizons horizons_near(const Eigen::Vector3d& direction) const;
    Span around(std::size_t facet, const std::vector<float>& tangent) const;
    bool objects_matter(std::size_t facet, const Horizons& horizons) const;
    MarchedSky marched_sky() const;
    /// Above which ground facets see open sky, by facet of a selection.
    std::vector<OpenAbove> skylines(std::span<const std::uint32_t> chosen) const;
    bool sees_objects(const MarchedSky& marched, std::size_t facet) const;

    const FacetSet& facets_;
    const RayScene& rays_;
    const HeightField& relief_;
    ReliefPoints points_;
    std::optional<RaisedRelief> raised_;
    ObjectBoxes objects_;
    std::vector<std::uint8_t> always_;  // (facet) always by rays
    std::vector<std::uint8_t> beside_;  // (ground facet) near objects; empty: no objects
};

}  // namespace diurna
