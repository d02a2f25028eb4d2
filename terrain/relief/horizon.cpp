#include "terrain/relief/horizon.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "terrain/place/site.hpp"
#include "terrain/relief/tile_march.hpp"

namespace diurna {

namespace {

void march_all(const HeightField& field, const Eigen::Vector2d& east_north,
               const HorizonRequest& request, std::span<float> tangent) {
    assert(tangent.size() == field.size());
    const GridWays found(field, east_north);
    for_each_tile_row(field, [&](int row, std::size_t first, std::size_t posts) {
        march_tiles(field, found, row, request, tangent.subspan(first, posts));
    });
}

}  // namespace

void horizon(const HeightField& field, double azimuth_deg, std::span<float> tangent, double lift) {
    march_all(field, direction(azimuth_deg, 0.0).head<2>(), {.lift = lift}, tangent);
}

void horizon_near(const HeightField& field, const Eigen::Vector3d& direction, double margin,
                  std::span<float> tangent, double lift) {
    const double elevation = std::asin(std::clamp(direction.z(), -1.0, 1.0));
    const auto tan_at = [](double angle) {
        return static_cast<float>(std::tan(std::clamp(angle, 0.0, 1.55)));
    };
    const Eigen::Vector2d plan = direction.head<2>();
    march_all(
        field, plan.norm() > 1e-9 ? plan : Eigen::Vector2d(0.0, 1.0),
        {.lift = lift, .start = tan_at(elevation - margin), .stop = tan_at(elevation + margin)},
        tangent);
}

}  // namespace diurna
