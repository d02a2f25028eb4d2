#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/texture/surface_id.hpp"

namespace diurna {

/// Planes through the temperatures of the facets around corners, by least squares weighted by
/// 1/distance²: what of them depends on the facets alone. One fit serves all facets at a corner
/// that have the same neighbours there.
struct CornerFits {
    CornerFits() = default;
    /// - chosen: facets whose temperatures within are wanted
    CornerFits(const FacetSet& facets, std::span<const SurfaceId> chosen);

    std::vector<SurfaceId> chosen;
    std::vector<SurfaceId> around;                  // these and all that touch them, ascending
    std::vector<std::array<std::uint32_t, 3>> fit;  // (around, corner) number of a fit
    std::vector<std::uint32_t> place;               // (chosen) index in `around`
    std::vector<std::uint8_t> of_chosen;            // (fit) at a corner of a chosen facet

    std::vector<std::uint32_t> row;      // (fit + 1) its facets: [row[c], row[c + 1])
    std::vector<std::uint32_t> other;    // a facet of the scene
    std::vector<double> weight;          // of its temperature [m⁻²]
    std::vector<Eigen::Vector2d> off;    // of its centroid from the corner [m], in the fit's plane
    std::vector<Eigen::Vector2d> lever;  // (fit) value = (Σ w T − lever · Σ w T off) / left
    std::vector<double> left;            // (fit) [m⁻²]; 0: nearly in a line, value Σ w T / Σ w
    std::vector<double> weights;         // (fit) Σ w; 0: no plane

    std::size_t size() const { return row.size() - 1; }
};

/// The fit of some facets at a corner: `left` 0 where they are nearly in a line.
struct CornerPlane {
    Eigen::Matrix<double, 2, 3> axes = Eigen::Matrix<double, 2, 3>::Zero();
    Eigen::Vector2d lever = Eigen::Vector2d::Zero();
    double left = 0.0, weights = 0.0;
};
/// - others: the facets around `corner`, all smoothly joined to a facet of `object`
CornerPlane corner_plane(const FacetSet& facets, std::uint32_t corner, ObjectId object,
                         std::span<const std::uint32_t> others);

/// Two unit vectors in which places on a surface are measured: east and north on ground, across the
/// normal n on objects and cliffs, without a jump as it turns (Duff et al. 2017, Journal of
/// Computer Graphics Techniques 6(1), listing 3).
Eigen::Matrix<double, 2, 3> surface_axes(const Eigen::Vector3d& n, ObjectId object);

}  // namespace diurna
