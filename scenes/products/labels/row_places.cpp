#include "scenes/products/labels/row_places.hpp"

#include <cmath>

#include "render/view/pixel_rays.hpp"
#include "render/view/place_in_picture.hpp"

namespace diurna {

namespace {

/// [s] after the picture's instant at which the row is read that a body falls on, by halving: as
/// the rows go on it may come towards them, faster than they do, too. 0 where it is behind the
/// camera.
///
/// - at: where it is at such a time
template <class At>
double when_read(const Observer& observer, const PixelRays& eye, const At& at) {
    double low = 0.0, high = observer.height;  // rows
    while (high - low > 1.0 / 16.0) {
        const double middle = 0.5 * (low + high);
        const auto place = place_in_picture(observer, eye, at(middle * observer.row_time));
        if (!place) return 0.0;
        (place->y() > middle ? low : high) = middle;
    }
    return std::floor(0.5 * (low + high)) * observer.row_time;
}

}  // namespace

RowPlaces row_places(const Prepared& prepared, const Sequence& sequence, std::size_t frame) {
    const Instant instant = sequence.frame[frame];
    const Observer observer = sequence.at(frame);
    const MoverPoses& poses = prepared.movement.poses_at(instant);
    const World& world = prepared.world;
    RowPlaces places{.seen = moved(world, world.facets, poses), .stands = {}, .poses = poses};
    if (!(observer.row_time > 0.0)) {
        places.stands = places.seen;
        return places;
    }
    const std::vector<Motion>& motions = prepared.movement.motions_at(instant);
    const PixelRays eye = pixel_rays(observer);
    const double last = observer.row_time * observer.height;
    const FacetSet after = moved(world, world.facets, gone_on(poses, motions, last));
    for (std::size_t v = 0; v < places.seen.vertex.size(); ++v) {
        const Eigen::Vector3d begun = places.seen.vertex[v].cast<double>();
        const Eigen::Vector3d way = (after.vertex[v].cast<double>() - begun) / last;
        if (way.isZero()) continue;
        const auto at = [&](double when) -> Eigen::Vector3d { return begun + when * way; };
        places.seen.vertex[v] = at(when_read(observer, eye, at)).cast<float>();
    }
    for (std::size_t m = 0; m < poses.size(); ++m) {
        const double when = when_read(observer, eye, [&](double seconds) -> Eigen::Vector3d {
            return gone_on(poses, motions, seconds)[m].translation();
        });
        places.poses[m] = gone_on(poses, motions, when)[m];
    }
    places.stands = moved(world, world.facets, places.poses);
    return places;
}

}  // namespace diurna
