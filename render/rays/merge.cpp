#include "render/rays/merge.hpp"

#include <algorithm>
#include <cmath>

namespace diurna {

namespace {

constexpr double most_depth = 0.01;  // of optical depth, from the mean chord
constexpr float most_deep = 0.06f;   // of the mean range
constexpr float most_turn = 2e-3f;   // [rad] of sky, from the mean direction
// [rad] the same of what mirrors' rays meet: up and down by the sky at their height, aside by more
constexpr float most_rise = 3e-2f, most_rise_of_height = 0.2f, most_aside = 0.15f;
constexpr float most_seen = 6e-3f;  // [rad] of facets, whose lobes turn with it

/// Whether what a mirror's ray meets lies as the mean of others, on the same side of the horizon.
bool same_way(const Eigen::Vector3f& mean, const Eigen::Vector3f& ray) {
    const float rise = std::abs(ray.z() - mean.z());
    return rise <= most_rise + most_rise_of_height * std::abs(mean.z()) &&
           (ray - mean).head<2>().norm() <= most_aside && (ray.z() < 0.0f) == (mean.z() < 0.0f);
}

/// Whether a hop is another sight of `mean`.
bool alike(const Hop& mean, const Hop& hop, const PlumeScene& plumes) {
    if (mean.kind != hop.kind || mean.what != hop.what || mean.way != hop.way ||
        mean.before != hop.before || mean.closed != hop.closed) {
        return false;
    }
    const float turned = (hop.direction - mean.direction).norm();
    if (hop.way == Hop::Way::mirrored && !same_way(mean.direction, hop.direction)) return false;
    if (hop.kind == Hop::Kind::plume) {
        const double apart = std::abs(double{hop.chord} - double{mean.chord});
        return apart * plumes.greatest_absorption(hop.what) <= most_depth;
    }
    if (hop.kind == Hop::Kind::facet) {
        if (hop.way != Hop::Way::mirrored && turned > most_seen) return false;
        return std::abs(hop.range - mean.range) <= most_deep * mean.range;
    }
    return turned <= most_turn;
}

void merge(const Hop& hop, Hop& mean) {
    const float total = mean.weight + hop.weight, t = hop.weight / total;
    mean.range += t * (hop.range - mean.range);
    mean.height += t * (hop.height - mean.height);
    mean.cosine += t * (hop.cosine - mean.cosine);
    mean.chord += t * (hop.chord - mean.chord);
    mean.direction = (mean.direction + t * (hop.direction - mean.direction)).normalized();
    mean.weight = total;
}

}  // namespace

void add_sample(std::span<const Hop> sample, const PlumeScene& plumes, std::vector<Hop>& pixel) {
    std::vector<std::int32_t> place(sample.size());
    for (std::size_t i = 0; i < sample.size(); ++i) {
        Hop hop = sample[i];
        if (hop.before >= 0) hop.before = place[static_cast<std::size_t>(hop.before)];
        const auto same = std::find_if(pixel.begin(), pixel.end(),
                                       [&](const Hop& mean) { return alike(mean, hop, plumes); });
        place[i] = static_cast<std::int32_t>(same - pixel.begin());
        if (same == pixel.end()) {
            pixel.push_back(hop);
        } else {
            merge(hop, *same);
        }
    }
}

}  // namespace diurna
