#include "render/rays/pixel_shares.hpp"

#include <cmath>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

/// The same azimuth, at another angle from the zenith.
Eigen::Vector3f at_zenith(const Eigen::Vector3d& direction, double zenith_deg) {
    const double level = direction.head<2>().norm();
    if (!(level > 0.0)) return direction.cast<float>();
    const Eigen::Vector2d azimuth = direction.head<2>() / level;
    const double sine = std::sin(radians(zenith_deg));
    return Eigen::Vector3d(sine * azimuth.x(), sine * azimuth.y(), std::cos(radians(zenith_deg)))
        .cast<float>();
}

}  // namespace

PixelShares pixel_shares(const View& view, std::size_t pixel, const SecondaryScene& scene,
                         const PixelRays& eye) {
    PixelShares shares;
    const auto width = static_cast<std::size_t>(view.width);
    const Eigen::Vector3d towards =
        eye.towards(double(pixel % width) + 0.5, double(pixel / width) + 0.5);
    for (std::uint32_t k = view.row[pixel]; k < view.row[pixel + 1]; ++k) {
        const Sighting& sighting = view.sighting[k];
        const SurfaceId surface = view.surface[sighting.target];
        if (scene.needs_rays(surface)) {
            shares.followed += sighting.weight;
            continue;
        }
        const Eigen::Vector3d normal = scene.rays.copies().turned(
            view.copy_of(sighting.target), scene.facets.normal[index(surface)].cast<double>());
        SecondaryRay plain{.kind = SecondaryRay::Kind::facet, .what = number(surface)};
        plain.weight = sighting.weight;
        plain.range = view.range_of(sighting);
        plain.height = view.height_of(sighting);
        plain.cosine = static_cast<float>(std::abs(normal.dot(towards)));
        plain.direction = towards.cast<float>();
        shares.plain.push_back(plain);
    }
    if (view.sky[pixel] > 0.0f) {
        SecondaryRay sky{.kind = SecondaryRay::Kind::sky};
        sky.weight = view.sky[pixel];
        sky.direction = at_zenith(towards, double{view.sky_zenith_deg[pixel]});
        sky.height = static_cast<float>(view.observer_height);
        shares.plain.push_back(sky);
    }
    return shares;
}

}  // namespace diurna
