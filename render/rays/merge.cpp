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

/// Whether a secondary ray is another sight of `mean`.
bool alike(const SecondaryRay& mean, const SecondaryRay& secondary, const PlumeScene& plumes) {
    if (mean.kind != secondary.kind || mean.what != secondary.what || mean.way != secondary.way ||
        mean.before != secondary.before || mean.closed != secondary.closed) {
        return false;
    }
    const float turned = (secondary.direction - mean.direction).norm();
    if (secondary.way == SecondaryRay::Way::mirrored &&
        !same_way(mean.direction, secondary.direction))
        return false;
    if (secondary.kind == SecondaryRay::Kind::plume) {
        const double apart = std::abs(double{secondary.chord} - double{mean.chord});
        return apart * plumes.greatest_absorption(secondary.what) <= most_depth;
    }
    if (secondary.kind == SecondaryRay::Kind::facet) {
        if (secondary.way != SecondaryRay::Way::mirrored && turned > most_seen) return false;
        return std::abs(secondary.range - mean.range) <= most_deep * mean.range;
    }
    return turned <= most_turn;
}

void merge(const SecondaryRay& secondary, SecondaryRay& mean) {
    const float total = mean.weight + secondary.weight, t = secondary.weight / total;
    mean.range += t * (secondary.range - mean.range);
    mean.height += t * (secondary.height - mean.height);
    mean.cosine += t * (secondary.cosine - mean.cosine);
    mean.chord += t * (secondary.chord - mean.chord);
    mean.direction = (mean.direction + t * (secondary.direction - mean.direction)).normalized();
    mean.weight = total;
}

}  // namespace

void add_sample(std::span<const SecondaryRay> sample, const PlumeScene& plumes,
                std::vector<SecondaryRay>& pixel) {
    std::vector<std::int32_t> place(sample.size());
    for (std::size_t i = 0; i < sample.size(); ++i) {
        SecondaryRay secondary = sample[i];
        if (secondary.before >= 0)
            secondary.before = place[static_cast<std::size_t>(secondary.before)];
        const auto same = std::find_if(pixel.begin(), pixel.end(), [&](const SecondaryRay& mean) {
            return alike(mean, secondary, plumes);
        });
        place[i] = static_cast<std::int32_t>(same - pixel.begin());
        if (same == pixel.end()) {
            pixel.push_back(secondary);
        } else {
            merge(secondary, *same);
        }
    }
}

}  // namespace diurna
