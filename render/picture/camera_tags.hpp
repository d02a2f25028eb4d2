#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>

namespace diurna {

/// Camera data of an OpenEXR picture in OpenEXR's standard attributes (ImfStandardAttributes.h),
/// for use by other programs. Matrices are for column vectors here, p' = M p.
struct CameraTags {
    /// worldToCamera: from east, north, up [m] of the site to the camera's right, up, forward [m]
    /// (left-handed, as in OpenEXR).
    Eigen::Matrix4d world_to_camera = Eigen::Matrix4d::Identity();
    /// worldToNDC, after division by w: x to the right and y down, 0 to 1 from the picture's upper
    /// left corner to its lower right one. Of pinhole and orthographic cameras.
    std::optional<Eigen::Matrix4d> world_to_ndc{};
    std::string cap_date{};     // capDate: "2026:07:15 05:00:00" on the scene's clock
    double utc_offset = 0.0;    // utcOffset [s]: UTC = capDate + it
    double longitude = 0.0;     // [°] east
    double latitude = 0.0;      // [°] north
    double altitude = 0.0;      // [m] above the sea
    double exposure = 0.0;      // expTime [s]
    double focus = 0.0;         // focus [m]; infinite: sharp at all distances
    double window_width = 0.0;  // screenWindowWidth: of the picture at distance 1; 0: not written
};

}  // namespace diurna
