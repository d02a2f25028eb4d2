#include "scenes/studies/elementary_effects.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "materials/base/random.hpp"

namespace diurna {

namespace {

struct Moments {
    double mean, deviation;
};

/// Of a sample; its deviation is NaN where one value alone cannot tell it.
Moments moments(const std::vector<double>& sample) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (sample.empty()) return {nan, nan};
    const double n = double(sample.size());
    const double mean = std::accumulate(sample.begin(), sample.end(), 0.0) / n;
    double squares = 0.0;
    for (const double value : sample) squares += (value - mean) * (value - mean);
    return {mean, sample.size() > 1 ? std::sqrt(squares / (n - 1.0)) : nan};
}

}  // namespace

MorrisDesign morris_design(std::size_t inputs, std::size_t trajectories, int levels,
                           std::uint64_t seed) {
    const double spaces = double(levels - 1);
    MorrisDesign design{
        .inputs = inputs, .trajectories = trajectories, .step = 0.5 * double(levels) / spaces};
    for (std::size_t t = 0; t < trajectories; ++t) {
        RandomStream draw{hashed(hashed(seed) + t * second_step)};
        std::vector<int> level(inputs);
        for (int& one : level) one = std::min(levels - 1, int(draw() * levels));
        std::vector<std::size_t> order(inputs);
        std::iota(order.begin(), order.end(), std::size_t{0});
        for (std::size_t i = inputs; i > 1; --i) {
            std::swap(order[i - 1], order[std::min(i - 1, std::size_t(draw() * double(i)))]);
        }
        for (std::size_t k = 0; k <= inputs; ++k) {
            if (k > 0) {
                int& moved = level[order[k - 1]];
                moved += moved < levels / 2 ? levels / 2 : -levels / 2;
            }
            std::vector<double> point(inputs);
            for (std::size_t i = 0; i < inputs; ++i) point[i] = level[i] / spaces;
            design.point.push_back(std::move(point));
        }
        design.changed.insert(design.changed.end(), order.begin(), order.end());
    }
    return design;
}

std::vector<ElementaryEffect> elementary_effects(const MorrisDesign& design,
                                                 const std::vector<double>& result) {
    std::vector<std::vector<double>> effect(design.inputs);
    for (std::size_t t = 0; t < design.trajectories; ++t) {
        for (std::size_t k = 0; k < design.inputs; ++k) {
            const std::size_t input = design.changed[t * design.inputs + k];
            const std::size_t before = t * (design.inputs + 1) + k;
            const double way = design.point[before + 1][input] - design.point[before][input];
            const double found = (result[before + 1] - result[before]) / way;
            if (std::isfinite(found)) effect[input].push_back(found);
        }
    }
    std::vector<ElementaryEffect> found;
    for (std::vector<double>& sample : effect) {
        const Moments plain = moments(sample);
        for (double& value : sample) value = std::abs(value);
        const Moments sizes = moments(sample);
        found.push_back({.mean = plain.mean,
                         .mean_size = sizes.mean,
                         .deviation = plain.deviation,
                         .size_error = sizes.deviation / std::sqrt(double(sample.size())),
                         .count = sample.size()});
    }
    return found;
}

}  // namespace diurna
