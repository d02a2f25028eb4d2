#include "terrain/place/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr double least_distance = 0.01;  // [m] nearer than that is one place

/// Between which two seconds, and how far between them.
struct Between {
    std::size_t first;
    double share;
};
Between between(const std::vector<double>& seconds, double at) {
    const double within = std::clamp(at, seconds.front(), seconds.back());
    const auto after = std::upper_bound(seconds.begin() + 1, seconds.end() - 1, within);
    const auto first = static_cast<std::size_t>(after - seconds.begin()) - 1;
    return {first, (within - seconds[first]) / (seconds[first + 1] - seconds[first])};
}

bool rests_after(const Trajectory& way, std::size_t i, double metres) {
    const Eigen::Vector3d step = way.place[i + 1] - way.place[i];
    return std::hypot(metres * step.x(), metres * step.y(), step.z()) <= least_distance;
}

/// Velocity at a place of the curve: that of the parabola through it and its neighbours (Bessel's
/// tangents), none where it rests before or after.
Eigen::Vector3d tangent(const Trajectory& way, std::size_t i) {
    if ((i > 0 && rests_after(way, i - 1, 1.0)) ||
        (i + 1 < way.place.size() && rests_after(way, i, 1.0))) {
        return Eigen::Vector3d::Zero();
    }
    const auto step = [&](std::size_t k) { return way.seconds[k + 1] - way.seconds[k]; };
    const auto secant = [&](std::size_t k) -> Eigen::Vector3d {
        return (way.place[k + 1] - way.place[k]) / step(k);
    };
    const std::size_t last = way.place.size() - 1;
    const std::size_t middle = std::clamp<std::size_t>(i, 1, last - 1);
    const Eigen::Vector3d before = secant(middle - 1), after = secant(middle);
    const Eigen::Vector3d here =
        (step(middle) * before + step(middle - 1) * after) / (step(middle) + step(middle - 1));
    return i == 0 ? 2.0 * before - here : i == last ? 2.0 * after - here : here;
}

/// Hermite's cubic between two places.
Eigen::Vector3d curve(const Trajectory& way, const Between& at) {
    const double t = at.share, rest = 1.0 - t;
    const double step = way.seconds[at.first + 1] - way.seconds[at.first];
    return rest * rest * (1.0 + 2.0 * t) * way.place[at.first] +
           t * t * (1.0 + 2.0 * rest) * way.place[at.first + 1] +
           step * t * rest * (rest * tangent(way, at.first) - t * tangent(way, at.first + 1));
}

}  // namespace

Eigen::Vector3d place_at(const Trajectory& way, double seconds) {
    const Between at = between(way.seconds, seconds);
    if (way.smooth) return curve(way, at);
    const auto [first, share] = at;
    return (1.0 - share) * way.place[first] + share * way.place[first + 1];
}

Eigen::Quaterniond attitude_at(const Trajectory& way, double seconds) {
    const auto [first, share] = between(way.seconds, seconds);
    return way.attitude[first].slerp(share, way.attitude[first + 1]);
}

Eigen::Quaterniond attitude(double heading_deg, double pitch_deg, double roll_deg) {
    using Eigen::AngleAxisd, Eigen::Vector3d;
    return Eigen::Quaterniond(AngleAxisd(-radians(heading_deg), Vector3d::UnitZ()) *
                              AngleAxisd(radians(pitch_deg), Vector3d::UnitX()) *
                              AngleAxisd(radians(roll_deg), Vector3d::UnitY()));
}

Eigen::Quaterniond attitude_along(const Eigen::Vector3d& velocity) {
    const double level = std::hypot(velocity.x(), velocity.y());
    if (!(velocity.norm() > 0.0)) return Eigen::Quaterniond::Identity();
    const double heading = level > 0.0 ? std::atan2(velocity.x(), velocity.y()) : 0.0;
    return attitude(degrees(heading), degrees(std::atan2(velocity.z(), level)), 0.0);
}

std::vector<Rest> rests(const Trajectory& way, double metres) {
    constexpr double ever = std::numeric_limits<double>::infinity();
    std::vector<Rest> all{{-ever, way.begin()}};
    for (std::size_t i = 1; i < way.seconds.size(); ++i) {
        if (!rests_after(way, i - 1, metres)) continue;
        if (all.back().until == way.seconds[i - 1]) {
            all.back().until = way.seconds[i];
        } else {
            all.push_back({way.seconds[i - 1], way.seconds[i]});
        }
    }
    if (all.back().until == way.end()) {
        all.back().until = ever;
    } else {
        all.push_back({way.end(), ever});
    }
    return all;
}

std::vector<double> seconds_at_speed(const std::vector<Eigen::Vector3d>& place, double speed) {
    std::vector<double> seconds{0.0};
    for (std::size_t i = 1; i < place.size(); ++i) {
        seconds.push_back(seconds.back() + (place[i] - place[i - 1]).norm() / speed);
    }
    return seconds;
}

Trajectory smooth_at_speed(const std::vector<Eigen::Vector3d>& place, double speed) {
    constexpr int parts = 16, finer = 32;  // of a leg; of a part
    const Trajectory curved{
        .seconds = seconds_at_speed(place, 1.0), .place = place, .attitude = {}, .smooth = true};
    Trajectory even{.seconds = {0.0}, .place = {place.front()}, .attitude = {}, .smooth = true};
    for (std::size_t i = 1; i < place.size(); ++i) {
        const double from = curved.seconds[i - 1], step = curved.seconds[i] - from;
        std::vector<Eigen::Vector3d> at;
        std::vector<double> gone{0.0};
        for (int k = 0; k <= parts * finer; ++k) {
            at.push_back(place_at(curved, from + step * k / (parts * finer)));
            if (k > 0)
                gone.push_back(gone.back() + (at[std::size_t(k)] - at[std::size_t(k) - 1]).norm());
        }
        const double begun = even.seconds.back();
        for (int part = 1; part <= parts; ++part) {
            const double along = gone.back() * part / parts;
            const Between there = between(gone, along);
            even.place.push_back((1.0 - there.share) * at[there.first] +
                                 there.share * at[there.first + 1]);
            even.seconds.push_back(begun + along / speed);
        }
        even.place.back() = place[i];
    }
    return even;
}

}  // namespace diurna
