#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "terrain/relief/height_field.hpp"
#include "terrain/visibility/raised_relief.hpp"
#include "terrain/visibility/relief_points.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"

namespace diurna {

/// Sun and sky on facets of which the first lie on a relief that is also known as a grid: these by
/// the march over the grid (relief/horizon.hpp), which is exact and ten times faster than rays;
/// shadow edges, objects, and ground that objects may shade, by rays.
///
/// A ground facet asks for the horizon at points spread evenly over it (relief_points.hpp). Where
/// all posts round them agree that the sun's whole disc is up, or down, that is so; else rays
/// decide. A facet of more than two cells has smoothed the relief away: at each of its points the
/// grid's own normal and horizon count, so that it carries the mean light of the fine relief.
class ReliefVisibility {
 public:
    /// `facets`, `rays` and `relief` are kept by reference. The first `ground_facets` lie on the
    /// relief, within its tolerance.
    ///
    /// - finer: (ground facet) 1 where the mesh shows more than the relief, a detail of the raster:
    ///   always by rays; empty: none does
    ReliefVisibility(const FacetSet& facets, const RayScene& rays, const HeightField& relief,
                     std::size_t ground_facets, std::span<const std::uint8_t> finer = {});

    /// Like `sun_fraction` of sun_fraction.hpp. For a facet of more than two cells it is the mean
    /// over its points of seen disc × cosine of incidence, over the cosine on the facet itself: its
    /// product with that is the beam that the fine relief takes in, and it may exceed one. Where
    /// the facet itself is turned away from the sun it is zero. Returns the number of facets that
    /// rays had to decide.
    ///
    /// - known: (facet) 1: keeps what it has; empty: none does
    std::size_t sun_fraction(const Eigen::Vector3d& direction, std::span<float> fraction,
                             const SunFractionOptions& options = {},
                             std::span<const std::uint8_t> known = {}) const;

    /// Like `facet_views` of view_factor_sampling.hpp: view factors by rays; on the ground the
    /// sky's share by the march (32 azimuths), and the rows scaled to what it leaves. Where objects
    /// may hide more than 0.001 of the sky from the ground, by more rays.
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
    };

    Horizons horizons_near(const Eigen::Vector3d& direction) const;
    Span around(std::size_t facet, const std::vector<float>& tangent) const;
    bool objects_matter(std::size_t facet, const Horizons& horizons) const;
    MarchedSky marched_sky() const;
    bool sees_objects(const MarchedSky& marched, std::size_t facet) const;

    const FacetSet& facets_;
    const RayScene& rays_;
    const HeightField& relief_;
    ReliefPoints points_;
    std::optional<RaisedRelief> raised_;
    std::vector<std::uint8_t> always_;  // (facet) always by rays
    std::vector<std::uint8_t> beside_;  // (ground facet) among objects; empty: there are none
};

}  // namespace diurna
