#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "terrain/relief/height_field.hpp"
#include "terrain/visibility/facet_views.hpp"

namespace diurna {

/// Sun and sky on facets of which the first lie on a relief that is also known as a grid: these by
/// the march over the grid (`height_field`), which is exact and ten times faster than rays; shadow
/// edges, objects, and ground that objects may shade, by rays (`visibility`).
///
/// A ground facet asks for the horizon at points spread evenly over it: one for a facet much
/// smaller than a cell, about six a cell for a larger one, 64 at most. Where all posts round them
/// agree that the sun's whole disc is up, or down, that is so; else rays decide. A facet of more
/// than two cells has smoothed the relief away: at each of its points the grid's own normal and
/// horizon count, so that it carries the mean light of the fine relief.
class ReliefVisibility {
 public:
    /// `facets`, `rays` and `relief` are kept by reference. The first `ground_facets` lie on the
    /// relief, within its tolerance.
    ReliefVisibility(const FacetSet& facets, const RayScene& rays, const HeightField& relief,
                     std::size_t ground_facets);

    /// Like `sun_fraction` of visibility.hpp. For a facet of more than two cells it is the mean
    /// over its points of seen disc × cosine of incidence, over the cosine on the facet itself: its
    /// product with that is the beam that the fine relief takes in, and it may exceed one. Where
    /// the facet itself is turned away from the sun it is zero. returns the number of facets that
    /// rays had to decide.
    std::size_t sun_fraction(const Eigen::Vector3d& direction, std::span<float> fraction,
                             const SunFractionOptions& options = {}) const;

    /// Like `sky_view` of visibility.hpp: exchange by rays; on the ground the sky's share by the
    /// march (32 azimuths), and the rows scaled to what it leaves.
    FacetViews facet_views(const FacetViewOptions& options = {}) const;

 private:
    struct Point {
        std::uint32_t post;  // the cell's first, row · columns + column
        float u, v;          // place in the cell, 0 to 1
    };
    struct Tangents {
        std::vector<float> relief, raised;  // (post)
    };

    float at(const Point& p, const std::vector<float>& tangent) const;
    Eigen::Vector3f grid_normal(const Point& p) const;
    struct Span {
        float low, high;
    };

    Span around(std::size_t facet, const std::vector<float>& tangent) const;
    bool objects_matter(std::size_t facet, const Tangents& tangents) const;
    Tangents tangents_near(const Eigen::Vector3d& direction) const;
    void add_points(std::size_t facet, const std::array<Eigen::Vector2d, 3>& corner);
    void raise_objects();

    const FacetSet& facets_;
    const RayScene& rays_;
    const HeightField& relief_;
    std::size_t ground_facets_;
    std::vector<std::uint32_t> first_point_;  // (ground facet) size + 1
    std::vector<Point> point_;
    std::vector<std::uint8_t> coarse_;   // (ground facet) more than two cells
    std::vector<std::uint8_t> always_;   // (facet) always by rays
    std::optional<HeightField> raised_;  // the relief with all objects filled up to their tops
};

}  // namespace diurna
