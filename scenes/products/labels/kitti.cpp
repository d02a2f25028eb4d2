#include "scenes/products/labels/kitti.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/base/units.hpp"
#include "render/view/pixel_rays.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

namespace {

/// An angle brought to −π to π.
double turned(double angle) { return std::remainder(angle, 2.0 * std::numbers::pi); }

int occlusion_level(double share) { return share <= 0.05 ? 0 : share <= 0.5 ? 1 : 2; }

std::string one_word(std::string kind) {
    std::replace(kind.begin(), kind.end(), ' ', '_');
    return kind;
}

/// The camera's frame made level: rows are right, straight down, ahead.
Eigen::Matrix3d level_frame(const Observer& observer) {
    const double azimuth = radians(observer.azimuth_deg);
    Eigen::Matrix3d level;
    level << std::cos(azimuth), -std::sin(azimuth), 0.0,  //
        0.0, 0.0, -1.0,                                   //
        std::sin(azimuth), std::cos(azimuth), 0.0;
    return level;
}

}  // namespace

std::string kitti_text(const LabelBook& book, const LabelledPicture& picture,
                       const Observer& observer) {
    const Eigen::Matrix3d level = level_frame(observer);
    std::string text;
    for (const Label& label : picture.labels) {
        const Labelled& object = book.objects[std::size_t(label.mask.object)];
        const ObjectMask& mask = label.mask;
        const WholeObject& whole = label.whole;
        const Eigen::Vector3d bottom = level * (whole.middle - observer.position -
                                                Eigen::Vector3d(0.0, 0.0, 0.5 * whole.height));
        const Eigen::Vector3d front = level * direction(whole.heading_deg, 0.0);
        const double rotation = std::atan2(-front.z(), front.x());
        text += fmt::format(
            "{} {:.2f} {} {:.4f} {:.2f} {:.2f} {:.2f} {:.2f} {:.3f} {:.3f} {:.3f} {:.3f} {:.3f} "
            "{:.3f} {:.4f}\n",
            object.group ? "DontCare" : one_word(object.kind), whole.truncation(),
            occlusion_level(whole.occlusion(double(mask.pixels))),
            turned(rotation - std::atan2(bottom.x(), bottom.z())), double(mask.left),
            double(mask.top), double(mask.left + mask.width - 1),
            double(mask.top + mask.height - 1), whole.height, whole.width, whole.length, bottom.x(),
            bottom.y(), bottom.z(), rotation);
    }
    return text;
}

std::string kitti_calibration(const Observer& observer) {
    if (observer.projection != Projection::pinhole) return "";
    const PixelRays eye = pixel_rays(observer);
    Eigen::Matrix3d camera, intrinsics;
    camera << eye.right.transpose(), eye.down.transpose(), eye.axis.transpose();
    const double focal =
        0.5 * observer.width / std::tan(0.5 * radians(observer.horizontal_fov_deg));
    intrinsics << focal, 0.0, 0.5 * observer.width - 0.5,  //
        0.0, focal, 0.5 * observer.height - 0.5,           //
        0.0, 0.0, 1.0;
    const Eigen::Matrix3d m = intrinsics * camera * level_frame(observer).transpose();
    std::string text;
    for (int eye_of_rig = 0; eye_of_rig < 4; ++eye_of_rig) {
        text += fmt::format("P{}:", eye_of_rig);
        for (int row = 0; row < 3; ++row) {
            text += fmt::format(" {:.12e} {:.12e} {:.12e} {:.12e}", m(row, 0), m(row, 1), m(row, 2),
                                0.0);
        }
        text += "\n";
    }
    return text +
           "R0_rect: 1 0 0 0 1 0 0 0 1\n"
           "Tr_velo_to_cam: 0 -1 0 0 0 0 -1 0 1 0 0 0\n"
           "Tr_imu_to_velo: 1 0 0 0 0 1 0 0 0 0 1 0\n";
}

}  // namespace diurna
