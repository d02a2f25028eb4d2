#include "render/instrument/draws.hpp"

#include <cmath>
#include <numbers>

#include "materials/base/random.hpp"

namespace diurna {

namespace {

constexpr std::uint64_t octaves = 12;

std::uint64_t mixed(std::uint64_t seed, Draw purpose, std::uint64_t place, std::uint64_t frame) {
    const std::uint64_t stream = hashed(seed + second_step * static_cast<std::uint64_t>(purpose));
    return hashed(hashed(stream ^ hashed(frame)) + golden_step * place);
}

double open_unit(std::uint64_t bits) { return unit_interval(bits) + 0x1p-54; }

}  // namespace

double uniform(std::uint64_t seed, Draw purpose, std::uint64_t place, std::uint64_t frame) {
    return open_unit(mixed(seed, purpose, place, frame));
}

double normal(std::uint64_t seed, Draw purpose, std::uint64_t place, std::uint64_t frame) {
    const std::uint64_t bits = mixed(seed, purpose, place, frame);
    const double angle = 2.0 * std::numbers::pi * unit_interval(hashed(bits));
    return std::sqrt(-2.0 * std::log(open_unit(bits))) * std::cos(angle);
}

double counted(double mean, std::uint64_t seed, std::uint64_t place, std::uint64_t frame) {
    if (mean <= 0.0) return 0.0;
    if (mean > 50.0) return mean + std::sqrt(mean) * normal(seed, Draw::shot, place, frame);
    const double drawn = uniform(seed, Draw::shot, place, frame);
    double share = std::exp(-mean), sum = share, count = 0.0;
    while (sum < drawn && count < 200.0) {
        count += 1.0;
        share *= mean / count;
        sum += share;
    }
    return count;
}

double flicker(std::uint64_t seed, std::uint64_t place, std::uint64_t frame) {
    double sum = 0.0;
    for (std::uint64_t octave = 0; octave < octaves; ++octave) {
        // Pixels do not jump together.
        const std::uint64_t phase = hashed(place + golden_step * octave) >> 40;
        sum += normal(seed, Draw::flicker, place * octaves + octave, (frame + phase) >> octave);
    }
    return sum / std::sqrt(double(octaves));
}

}  // namespace diurna
