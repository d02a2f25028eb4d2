#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "render/view/seen_alone.hpp"
#include "scenes/products/labels/labelled.hpp"
#include "terrain/visibility/copies.hpp"

namespace diurna {

/// An object without occlusion, and its position relative to the camera.
struct WholeObject {
    PictureBox box;  // around it (projected_box); may extend beyond the picture
    SeenAlone alone;
    /// The upright box around it along its heading: middle [m] east, north, up; its length along
    /// the heading, its width across and its height [m].
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    double length = 0.0, width = 0.0, height = 0.0;
    double heading_deg = 0.0;
    double range = 0.0;  // [m] from the camera to that middle
    /// The camera's direction from that middle: 0 in front of the object, 90 on its right-hand
    /// side, −180 to 180; above the horizontal, on slopes too.
    double aspect_azimuth_deg = 0.0, aspect_elevation_deg = 0.0;

    /// Share of its pixels outside the picture's edges, as far as its box reaches, 0 to 1.
    double truncation() const;
    /// Share of its pixels in the picture that are hidden, if `seen` are visible, 0 to 1.
    double occlusion(double seen) const;
};

/// By ObjectId; objects of which some part is in front of the camera.
///
/// - facets: as recorded by the camera's rows
/// - stands: the same at the time when their middle is recorded: used for boxes along the heading,
///   ranges and aspects
std::map<int, WholeObject> whole_objects(const FacetSet& facets, const FacetSet& stands,
                                         const Copies& copies, const std::vector<Labelled>& objects,
                                         const Observer& observer);

}  // namespace diurna
