#include "render/light/radiosity.hpp"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "render/light/lanes.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_lanes = 1024, ahead = 12;

/// Of the quadratic over three heights, eight lanes from k on.
Lane at_height(const std::array<std::vector<float>, 3>& heights, const std::array<float, 3>& up,
               std::size_t k) {
    return up[0] * load(&heights[0][k]) + up[1] * load(&heights[1][k]) +
           up[2] * load(&heights[2][k]);
}

}  // namespace

Radiosity::Radiosity(const LitFacets& lit, const LitState& state, const RadiosityTables& tables,
                     std::span<const BounceOptions> bounces)
    : lit_(lit), state_(state), tables_(tables), radiosity_(lit.facet.size() * tables.lanes) {
    if (tables.lanes > most_lanes) throw InputError("render", "too many bands at a time");
    for_each_block(lit.facet.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (lit_.is_source[i]) first_bounce(i, &radiosity_[i * tables_.lanes]);
        }
    });
    follow_second_bounces(bounces);
}

void Radiosity::follow_second_bounces(std::span<const BounceOptions> bounces) {
    const std::size_t n = lit_.facet.size(), lanes = tables_.lanes;
    std::vector<std::pair<const float*, float>> least;  // (band followed) bound and what to follow
    for (std::size_t b = 0; b < bounces.size(); ++b) {
        if (bounces[b].bounces < 2) continue;
        least.emplace_back(lit_.bounds[b].twice.data(),
                           bounces[b].tolerance / bounces[b].most_change);
    }
    if (least.empty()) return;
    const auto follow = [&](std::size_t i) {
        return std::any_of(least.begin(), least.end(),
                           [&](const auto& band) { return band.first[i] > band.second; });
    };
    // All are worked out before any is replaced, so that none is followed twice.
    constexpr std::size_t grain = 4096;
    struct Block {
        std::vector<std::uint32_t> place;
        std::vector<float> radiosity;
    };
    std::vector<Block> blocks((n + grain - 1) / grain);
    for_each_block(n, grain, [&](std::size_t begin, std::size_t end) {
        Block& block = blocks[begin / grain];
        for (std::size_t i = begin; i < end; ++i) {
            if (follow(i)) block.place.push_back(static_cast<std::uint32_t>(i));
        }
        block.radiosity.resize(block.place.size() * lanes);
        for (std::size_t k = 0; k < block.place.size(); ++k) {
            if (k + ahead < block.place.size()) fetch(block.place[k + ahead]);
            second_bounce(block.place[k], &block.radiosity[k * lanes]);
        }
    });
    for_each_index(
        blocks.size(),
        [&](std::size_t k) {
            const Block& block = blocks[k];
            for (std::size_t j = 0; j < block.place.size(); ++j) {
                std::copy_n(&block.radiosity[j * lanes], lanes,
                            &radiosity_[block.place[j] * lanes]);
            }
        },
        1);
    for (const Block& block : blocks) followed_ += block.place.size();
}

/// Own heat, sky and sun; black surroundings. Eight lanes at a time stay in registers.
void Radiosity::first_bounce(std::size_t i, float* out) const {
    const std::size_t n = tables_.lanes;
    const auto& material = tables_.material[index(lit_.material[i])];
    float t = 0.0f;
    const std::size_t cell = tables_.grid.cell(state_.temperature[i], t) * 4 * n;
    const float *emitted = &material.emitted[cell], *reflected = &material.reflected[cell];
    const std::array<float, 3> up = height_weights(lit_.height[i]);
    const float open = lit_.sky_view[i], sunlight = state_.sunlight[i];
    for (std::size_t k = 0; k < n; k += lane_count) {
        Lane all = cubic(emitted + k, n, t) + (1.0f - open) * cubic(reflected + k, n, t);
        all += open * at_height(material.sky, up, k);
        if (sunlight > 0.0f) all += sunlight * at_height(material.sun, up, k);
        Eigen::Map<Lane>(out + k) = all;
    }
}

/// What it was, plus ρ times the light that arrives less that of the black surroundings it was
/// closed with.
void Radiosity::second_bounce(std::size_t i, float* out) const {
    const std::size_t n = tables_.lanes;
    alignas(32) std::array<float, most_lanes> own, light;
    black_modes(tables_, state_.temperature[i], own.data());
    arriving(i, own.data(), light.data());
    const float rest = 1.0f - lit_.sky_view[i];
    for (std::size_t k = 0; k < n; ++k) light[k] -= rest * own[k];
    std::copy_n(&radiosity_[i * n], n, out);
    const auto& material = tables_.material[index(lit_.material[i])];
    for (std::size_t b = 0; b < tables_.size.size(); ++b) {
        const std::size_t first = tables_.first[b], width = tables_.first[b + 1] - first;
        const float* matrix = material.reflection[b].data();
        for (std::size_t in = 0; in < tables_.size[b]; ++in, matrix += width) {
            const float x = light[first + in];
            float* to = out + first;
#pragma omp simd
            for (std::size_t k = 0; k < width; ++k) to[k] += x * matrix[k];
        }
    }
}

void Radiosity::arriving(std::size_t i, const float* black, float* out) const {
    const std::size_t n = tables_.lanes;
    const std::uint32_t begin = lit_.row[i], end = lit_.row[i + 1];
    for (std::size_t k = 0; k < n; k += lane_count) {
        Lane sum = Lane::Zero();
        if (begin == end) sum = (1.0f - lit_.sky_view[i]) * load(black + k);
        for (std::uint32_t e = begin; e < end; ++e) {
            sum += lit_.factor[e] * load(&radiosity_[std::size_t{lit_.source[e]} * n + k]);
        }
        Eigen::Map<Lane>(out + k) = sum;
    }
}

}  // namespace diurna
