#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "render/view/observer.hpp"
#include "render/view/pixel_rays.hpp"
#include "terrain/facets.hpp"

/// From places of the scene to places in a picture: the way back of pixel_rays.hpp.
namespace diurna {

/// Where a point appears, column and row in pixels from the picture's upper left corner, whether or
/// not anything hides it; it may lie outside the picture. Of a camera that moves: as the row that
/// sees it finds it, in the middle of its exposure.
///
/// - point: east, north, up [m]
/// - returns nothing for what a pinhole or an orthographic camera has behind it (less than 1 cm in
///   front), and for the direction straight behind a fisheye
std::optional<Eigen::Vector2d> place_in_picture(const Observer& observer, const PixelRays& eye,
                                                const Eigen::Vector3d& point);

/// The smallest upright box in a picture around all that is asked for [pixels], which may reach
/// beyond the picture's edges.
struct PictureBox {
    double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
};

/// Around triangles projected whole, whatever stands before them; what a pinhole has behind it is
/// cut off. Exact for projections that keep lines straight (pinhole, orthographic) and cameras that
/// stand still; of the others it is around the corners, and of what crosses a panorama's seam
/// straight behind all the way round. Nothing if none is in front.
///
/// - facet: indices of the triangles
std::optional<PictureBox> projected_box(const Observer& observer, const FacetSet& facets,
                                        std::span<const std::uint32_t> facet);

}  // namespace diurna
