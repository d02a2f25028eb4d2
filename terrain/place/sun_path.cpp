#include "terrain/place/sun_path.hpp"

namespace diurna {

namespace {

constexpr std::chrono::milliseconds spacing{600'000};

}  // namespace

const Eigen::Vector3d& SunPath::knot(long long index) {
    Knot& knot = knots_[static_cast<std::size_t>(index & 7)];
    if (!knot.filled || knot.index != index) {
        const SunPosition sun = sun_position(site_, Instant{} + index * spacing);
        knot = {index, true, sun.distance_au * sun_direction(sun)};
    }
    return knot.place;
}

SunPosition SunPath::at(Instant instant) {
    const auto since = instant.time_since_epoch();
    const long long before = since.count() >= 0
                                 ? since / spacing
                                 : -1 - (-since - std::chrono::milliseconds(1)) / spacing;
    const double x = std::chrono::duration<double>(since - before * spacing) /
                     std::chrono::duration<double>(spacing);
    // Lagrange through −1, 0, 1, 2.
    const Eigen::Vector3d place = -x * (x - 1.0) * (x - 2.0) / 6.0 * knot(before - 1) +
                                  (x + 1.0) * (x - 1.0) * (x - 2.0) / 2.0 * knot(before) -
                                  (x + 1.0) * x * (x - 2.0) / 2.0 * knot(before + 1) +
                                  (x + 1.0) * x * (x - 1.0) / 6.0 * knot(before + 2);
    return sun_at(place);
}

}  // namespace diurna
