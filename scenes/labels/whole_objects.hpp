#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "render/view/seen_alone.hpp"
#include "scenes/labels/labelled.hpp"
#include "terrain/visibility/copies.hpp"

namespace diurna {

/// An object as it would be seen if nothing stood before it, and how it stands to the camera.
struct WholeObject {
    PictureBox box;  // around its corners (projected_box); may reach beyond the picture
    SeenAlone alone;
    /// The upright box around it that faces as it does: middle [m] east, north, up; its length
    /// along the heading, its width across and its height [m].
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    double length = 0.0, width = 0.0, height = 0.0;
    double heading_deg = 0.0;
    double range = 0.0;  // [m] from the camera to that middle
    /// The camera's direction in the object's frame: 0 before its front, 90 on its right-hand side,
    /// −180 to 180; above its level.
    double aspect_azimuth_deg = 0.0, aspect_elevation_deg = 0.0;

    /// Of its pixels, what lies beyond the picture's edges, 0 to 1.
    double truncation() const;
    /// Of its pixels in the picture, what is hidden if `seen` are to be seen, 0 to 1.
    double occlusion(double seen) const;
};

/// By ObjectId; those of which something lies in front of the camera.
///
/// - facets: as the camera's rows find them
/// - stands: the same as they stand when their middle is read: of these are boxes that face as they
///   do, ranges and aspects
std::map<int, WholeObject> whole_objects(const FacetSet& facets, const FacetSet& stands,
                                         const Copies& copies, const std::vector<Labelled>& objects,
                                         const Observer& observer);

}  // namespace diurna
