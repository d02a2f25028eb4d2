#include "render/view/observer.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "terrain/place/site.hpp"
#include "terrain/place/trajectory.hpp"

namespace diurna {

void check_observer(const Observer& observer) {
    std::vector<Mistake> mistakes;
    const std::string where = "observer " + observer.name;
    const auto within = [&](const char* what, double value, double least, double most) {
        if (!(value >= least && value <= most)) {
            mistakes.push_back(
                {where, fmt::format("{} is {:g}, expected {:g} to {:g}", what, value, least, most),
                 ""});
        }
    };
    for (int axis = 0; axis < 3; ++axis) {
        within("a coordinate of the position [m]", observer.position[axis], -1e5, 1e5);
    }
    within("azimuth_deg", observer.azimuth_deg, -360.0, 360.0);
    within("elevation_deg", observer.elevation_deg, -90.0, 90.0);
    within("roll_deg", observer.roll_deg, -360.0, 360.0);
    if (observer.projection == Projection::orthographic) {
        within("picture_width_m", observer.picture_width, 1e-3, 2e5);
    } else {
        within("horizontal_fov_deg", observer.horizontal_fov_deg, 1e-3,
               observer.projection == Projection::pinhole ? 170.0 : 360.0);
    }
    for (int axis = 0; axis < 3; ++axis) {
        within("velocity [m/s]", observer.velocity[axis], -1e4, 1e4);
        within("turning [rad/s]", observer.turning[axis], -100.0, 100.0);
    }
    within("row_time [s]", observer.row_time, 0.0, 60.0);
    within("exposure [s]", observer.exposure, 0.0, 60.0);
    within("width", observer.width, 1, 16384);
    within("height", observer.height, 1, 16384);
    if (!mistakes.empty()) throw InputError(std::move(mistakes));
}

namespace {

/// Where a hit is, in words: the ground, or an object's name.
std::string thing_hit(const Hit& hit, const FacetSet& facets, const RayScene& scene,
                      std::size_t ground_facets, std::span<const std::string> names) {
    const auto object = static_cast<unsigned>(
        hit.copy == no_copy ? facets.object[index(hit.facet)] : scene.copies()[hit.copy].object);
    if (object == 0 || index(hit.facet) < ground_facets) return "";
    return object < names.size() ? "\"" + names[object] + "\"" : fmt::format("object {}", object);
}

/// Refuses an eye in a surface, of which no ray can say on which side it is: within a millimetre,
/// or what floats tell apart there. One of three rays through it, each along an axis, meets the
/// surface at least as steeply as 35 degrees.
void check_not_in_surface(const Observer& observer, const FacetSet& facets, const RayScene& scene,
                          std::size_t ground_facets, std::span<const std::string> names) {
    const float near =
        std::max(1e-3f, 1e-6f * static_cast<float>(observer.position.cwiseAbs().maxCoeff()));
    constexpr std::array<std::array<float, 3>, 3> along = {
        {{1.0f, 1.3e-3f, 0.7e-3f}, {-0.9e-3f, 1.0f, 1.1e-3f}, {0.6e-3f, -1.7e-3f, 1.0f}}};
    std::array<Ray, 3> rays;
    std::array<Hit, 3> hits;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        rays[i].direction = Eigen::Vector3f(along[i][0], along[i][1], along[i][2]).normalized();
        rays[i].origin = observer.position.cast<float>() - 2.0f * near * rays[i].direction;
        rays[i].far = 4.0f * near;
    }
    scene.closest(rays, hits);
    for (const Hit& hit : hits) {
        if (hit.facet == no_facet || std::abs(hit.range - 2.0f * near) > near) continue;
        const std::string thing = thing_hit(hit, facets, scene, ground_facets, names);
        throw InputError(
            "observer " + observer.name,
            fmt::format("the camera is in a surface of {}, expected at least {:.2g} m from it",
                        thing.empty() ? "the ground" : thing, near),
            "move its position, or the object");
    }
}

}  // namespace

void check_observer(const Observer& observer, const FacetSet& facets, const RayScene& scene,
                    std::size_t ground_facets, std::span<const std::string> names) {
    check_observer(observer);
    check_not_in_surface(observer, facets, scene, ground_facets, names);
    // A ray along a mesh edge could be counted to either side: three, nearly vertical, decide by
    // majority.
    constexpr std::array<std::array<float, 2>, 3> tilt = {
        {{1.3e-4f, 0.7e-4f}, {-0.9e-4f, 1.1e-4f}, {0.2e-4f, -1.7e-4f}}};
    std::array<Ray, 3> rays;
    std::array<Hit, 3> hits;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        rays[i].origin = observer.position.cast<float>();
        rays[i].direction = Eigen::Vector3f(tilt[i][0], tilt[i][1], 1.0f).normalized();
    }
    scene.closest(rays, hits);
    int behind = 0;
    Hit nearest;
    for (const Hit& hit : hits) {
        if (hit.facet != no_facet && facets.normal[index(hit.facet)].z() > 0.0f) {
            ++behind;
            nearest = hit;
        }
    }
    if (behind < 2) return;
    const std::string name = thing_hit(nearest, facets, scene, ground_facets, names);
    throw InputError(
        "observer " + observer.name,
        name.empty()
            ? fmt::format("the camera is {:.1f} m below the terrain", nearest.range)
            : fmt::format("the camera is inside {}, {:.1f} m below its top", name, nearest.range),
        "raise its position");
}

Eigen::Quaterniond attitude_of(const Observer& observer) {
    return attitude(observer.azimuth_deg, observer.elevation_deg, observer.roll_deg);
}

Observer turned_to(Observer observer, const Eigen::Quaterniond& attitude) {
    const Eigen::Matrix3d axes = attitude.normalized().toRotationMatrix();
    const Eigen::Vector3d right = axes.col(0), forward = axes.col(1), up = axes.col(2);
    const double level = std::hypot(forward.x(), forward.y());
    observer.elevation_deg = degrees(std::atan2(forward.z(), level));
    if (level > 1e-9) {
        const double azimuth = std::atan2(forward.x(), forward.y());
        const Eigen::Vector3d level_right(std::cos(azimuth), -std::sin(azimuth), 0.0);
        observer.azimuth_deg = degrees(azimuth);
        observer.roll_deg =
            degrees(std::atan2(right.dot(forward.cross(level_right)), right.dot(level_right)));
    } else {
        const Eigen::Vector3d ahead = forward.z() < 0.0 ? up : Eigen::Vector3d(-up);
        observer.azimuth_deg = degrees(std::atan2(ahead.x(), ahead.y()));
        observer.roll_deg = 0.0;
    }
    if (observer.azimuth_deg < 0.0) observer.azimuth_deg += 360.0;
    return observer;
}

Observer looking_at(Observer observer, const Eigen::Vector3d& target) {
    const Eigen::Vector3d line = target - observer.position;
    const double level = std::hypot(line.x(), line.y());
    if (line.norm() == 0.0) {
        throw InputError("observer " + observer.name, "looks at its own place");
    }
    observer.azimuth_deg = level > 0.0 ? degrees(std::atan2(line.x(), line.y())) : 0.0;
    if (observer.azimuth_deg < 0.0) observer.azimuth_deg += 360.0;
    observer.elevation_deg = degrees(std::atan2(line.z(), level));
    return observer;
}

double field_of_view_deg(int width, double pitch_um, double focal_length_mm) {
    return 2.0 * degrees(std::atan(0.5 * width * pitch_um * 1e-3 / focal_length_mm));
}

}  // namespace diurna
