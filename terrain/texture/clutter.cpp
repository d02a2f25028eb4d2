#include "terrain/texture/clutter.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/base/random.hpp"

namespace diurna {

namespace {

// The kernel's standard deviation in cells: the variance between nodes then differs by 4e-3 from
// that at nodes, which is taken out where the weights are summed.
constexpr double smooth_cells = 0.8;
constexpr int reach = 3;  // cells; beyond them the kernel is below 1e-3
constexpr std::size_t deviates = 4096;

/// Deviate whose cumulative probability is p, by bisection on erfc.
double normal_quantile(double p) {
    double low = -9.0, high = 9.0;
    for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        (0.5 * std::erfc(-middle / std::numbers::sqrt2) < p ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

/// Equally likely deviates of mean 0 and variance 1.
const std::array<float, deviates>& deviate_table() {
    static const std::array<float, deviates> table = [] {
        std::array<double, deviates> exact;
        double square = 0.0;
        for (std::size_t i = 0; i < deviates; ++i) {
            exact[i] = normal_quantile((double(i) + 0.5) / double(deviates));
            square += exact[i] * exact[i];
        }
        std::array<float, deviates> scaled;
        for (std::size_t i = 0; i < deviates; ++i) {
            scaled[i] = static_cast<float>(exact[i] / std::sqrt(square / double(deviates)));
        }
        return scaled;
    }();
    return table;
}

constexpr std::size_t lanes = 8;  // of vector code: six nodes and two of no weight

using Weights = std::array<float, lanes>;

/// Weights of the six nodes around a place between two of them, of square sum 1.
Weights exact_weights(double part) {
    std::array<double, 2 * reach> w;
    double square = 0.0;
    for (int k = 0; k < 2 * reach; ++k) {
        const double d = part + (reach - 1 - k);
        w[std::size_t(k)] = std::exp(-0.5 * d * d / (smooth_cells * smooth_cells));
        square += w[std::size_t(k)] * w[std::size_t(k)];
    }
    Weights all{};
    for (std::size_t k = 0; k < w.size(); ++k) {
        all[k] = static_cast<float>(w[k] / std::sqrt(square));
    }
    return all;
}

/// The same, straight between places of a table: within 1e-6.
constexpr std::size_t weight_places = 512;
const Weights* weight_table() {
    static const std::vector<Weights> table = [] {
        std::vector<Weights> all;
        for (std::size_t i = 0; i <= weight_places; ++i) {
            all.push_back(exact_weights(double(i) / double(weight_places)));
        }
        return all;
    }();
    return table.data();
}
inline Weights weights(const Weights* table, double part) {
    const double at = part * double(weight_places);
    const auto place = std::min(static_cast<std::size_t>(at), weight_places - 1);
    const auto beyond = static_cast<float>(at - double(place));
    const Weights &here = table[place], &next = table[place + 1];
    Weights w;
#pragma omp simd
    for (std::size_t k = 0; k < lanes; ++k) w[k] = here[k] + beyond * (next[k] - here[k]);
    return w;
}

/// The tables, read once.
struct Tables {
    const float* deviate = deviate_table().data();
    const Weights* weight = weight_table();
};

/// White noise on a lattice of unit cells, smoothed.
double smooth_noise(const Tables& tables, std::uint64_t seed, double x, double y) {
    const float* table = tables.deviate;
    const double left = std::floor(x), low = std::floor(y);
    const Weights wx = weights(tables.weight, x - left), wy = weights(tables.weight, y - low);
    const auto column = static_cast<std::uint32_t>(static_cast<std::int64_t>(left) - reach + 1);
    const auto row = static_cast<std::uint32_t>(static_cast<std::int64_t>(low) - reach + 1);
    const auto from_column = static_cast<std::uint32_t>(seed);
    const auto from_row = static_cast<std::uint32_t>(seed >> 32);
    alignas(32) Weights down{};
    for (std::uint32_t j = 0; j < 2 * reach; ++j) {
        const std::uint32_t line = spread_bits(row + j + from_row) + from_column;
        const float weight = wy[j];
#pragma omp simd
        for (std::uint32_t i = 0; i < lanes; ++i) {
            const std::uint32_t hash = spread_bits((column + i) * golden_step32 + line);
            down[i] += weight * table[hash >> 20];
        }
    }
    float sum = 0.0f;
    for (std::size_t i = 0; i < 2 * reach; ++i) sum += wx[i] * down[i];
    return double{sum};
}

}  // namespace

std::vector<ClutterOctave> clutter_octaves(const ClutterSpec& spec) {
    if (spec.covariance == Covariance::gaussian) return {{spec.length, 1.0}};
    constexpr int coarsest = -2, finest = 4;
    std::array<double, finest - coarsest + 1> weight;
    double sum = 0.0;
    for (int i = coarsest; i <= finest; ++i) {
        const double t = std::pow(4.0, i);
        double& w = weight[std::size_t(i - coarsest)];
        w = std::exp(-0.25 / t) / std::sqrt(t);
        if (i == finest) w *= 2.0;  // what all finer octaves would have
        sum += w;
    }
    std::vector<ClutterOctave> octaves;
    for (int i = coarsest; i <= finest; ++i) {
        octaves.push_back(
            {spec.length * std::pow(2.0, -i), weight[std::size_t(i - coarsest)] / sum});
    }
    return octaves;
}

Clutter::Clutter(const ClutterSpec& spec) : length_(spec.length) {
    for (const ClutterOctave& octave : clutter_octaves(spec)) {
        const std::uint64_t seed = hashed(spec.seed + golden_step * octave_.size());
        octave_.push_back({octave.length, std::sqrt(octave.variance), seed});
    }
}

double Clutter::at(double x, double y, double spacing) const {
    const Tables tables;
    double sum = 0.0;
    for (const Octave& octave : octave_) {
        // An aperture as wide as a square of that side, of variance a² = side²/12 each way, leaves
        // 1 / (1 + 4 a²/l²) of the variance.
        const double ratio = spacing / octave.length;
        const double kept = 1.0 / std::sqrt(1.0 + ratio * ratio / 3.0);
        if (kept < 0.1) continue;
        const double cells = 2.0 * smooth_cells / octave.length;
        sum += kept * octave.amplitude * smooth_noise(tables, octave.seed, x * cells, y * cells);
    }
    return sum;
}

}  // namespace diurna
