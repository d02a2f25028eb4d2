#include "scenes/job/plan/seen_pixels.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

/// Where a direction falls in the picture, in widths of it from its middle, and how large a pixel
/// is there.
struct Spot {
    bool inside = false;
    double pixel = 1.0;  // [sr], or [m²] of an orthographic picture
};

Spot spot_of(const Observer& observer, const Eigen::Vector3d& to) {
    const double tall = double(observer.height) / observer.width;
    const double columns = double(observer.width) * observer.width;
    if (observer.projection == Projection::orthographic) {
        const double wide = observer.picture_width;
        return {std::abs(to.x()) <= 0.5 * wide && std::abs(to.z()) <= 0.5 * wide * tall,
                wide * wide / columns};
    }
    const double across = radians(observer.horizontal_fov_deg);
    if (observer.projection == Projection::pinhole) {
        const double half = std::tan(0.5 * across);
        if (!(to.y() > 0.0)) return {};
        const double x = std::abs(to.x()) / to.y(), z = std::abs(to.z()) / to.y();
        const double slant = to.y() / to.norm();  // cosine of the angle from the axis
        return {x <= half && z <= half * tall, 4.0 * half * half / columns * slant * slant * slant};
    }
    const double angle = std::atan2(std::hypot(to.x(), to.z()), to.y());
    return {angle <= 0.5 * across, across * across / columns};
}

double pixels_of(const PosedCamera& camera, const FacetSet& facets, std::size_t f) {
    return camera.pixels_of(facets.centroid[f].cast<double>(), facets.normal[f].cast<double>(),
                            double{facets.area[f]});
}

}  // namespace

PosedCamera::PosedCamera(const Observer& observer)
    : observer_(observer), axes_(attitude_of(observer).toRotationMatrix().transpose()) {}

double PosedCamera::pixels_of(const Eigen::Vector3d& centroid, const Eigen::Vector3d& normal,
                              double area) const {
    const Eigen::Vector3d line = centroid - observer_.position;
    const bool parallel = observer_.projection == Projection::orthographic;
    const Eigen::Vector3d along =
        parallel ? Eigen::Vector3d(axes_.row(1).transpose()) : line.normalized();
    const double facing = -along.dot(normal);
    if (!(facing > 0.0)) return 0.0;
    const Spot spot = spot_of(observer_, axes_ * line);
    if (!spot.inside) return 0.0;
    const double apparent = area * facing;
    return (parallel ? apparent : apparent / line.squaredNorm()) / spot.pixel;
}

double seen_pixels(const Observer& observer, const FacetSet& facets,
                   const std::function<bool(MaterialId)>& counts) {
    const PosedCamera camera(observer);
    double pixels = 0.0;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (counts(facets.material[f])) pixels += pixels_of(camera, facets, f);
    }
    return std::min(pixels, double(observer.width) * observer.height);
}

double seen_facets(std::span<const Observer> poses, const FacetSet& facets) {
    const std::vector<PosedCamera> cameras(poses.begin(), poses.end());
    const std::size_t apart = 1 + facets.size() * poses.size() / most_looked_at;
    double seen = 0.0;
    for (std::size_t f = 0; f < facets.size(); f += apart) {
        double pixels = 0.0;
        for (const PosedCamera& camera : cameras) pixels += pixels_of(camera, facets, f);
        seen += 1.0 - std::exp(-pixels);
    }
    return seen * double(apart);
}

}  // namespace diurna
