#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>

#include "render/view/observer.hpp"
#include "render/view/pixel_rays.hpp"
#include "terrain/facets.hpp"

/// From points of the scene to positions in a picture: the inverse of pixel_rays.hpp.
namespace diurna {

/// Position of a point, column and row in pixels from the picture's upper left corner, whether or
/// not it is hidden; it may be outside the picture. For a moving camera: as seen in its row, in the
/// middle of that row's exposure.
///
/// - point: east, north, up [m]
/// - returns nothing for points behind a pinhole or an orthographic camera (less than 1 cm in
///   front), and for the direction straight behind a fisheye
std::optional<Eigen::Vector2d> place_in_picture(const Observer& observer, const PixelRays& eye,
                                                const Eigen::Vector3d& point);

/// The smallest axis-aligned box in a picture around given points or triangles [pixels], which may
/// extend beyond the picture's edges.
struct PictureBox {
    double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;
};

/// Around triangles projected completely, even if hidden. The part behind a camera is cut off, and
/// of a pinhole, whose picture has no end, what is more than 80 degrees to the side of its axis or
/// above or below it (in pictures whose corner is beyond 70.6 degrees: twice as far out as that
/// corner): the ground beneath a level camera would be a box without end. Exact for projections
/// that keep lines straight (pinhole, orthographic) and cameras at rest; for the others around the
/// corners, and for triangles across a panorama's seam behind it over the whole width. Nothing if
/// none is in front.
///
/// - facet: indices of the triangles
std::optional<PictureBox> projected_box(const Observer& observer, const FacetSet& facets,
                                        std::span<const std::uint32_t> facet);

}  // namespace diurna
