#include "render/rays/air_lanes.hpp"

#include <algorithm>

namespace diurna {

namespace {

constexpr std::size_t rows = origin_count + 1;

}  // namespace

AirLanes::AirLanes(const PathTable& path, std::span<const BandLight> bands,
                   const ChannelLanes& lanes)
    : grid_(path.grid()), lanes_(lanes.size()) {
    air_.assign(path.nodes() * rows * lanes_, 0.0f);
    for (std::size_t k = 0; k < path.nodes(); ++k) {
        for (std::size_t b = 0; b < bands.size(); ++b) {
            const std::size_t channels = bands[b].channels.padded();
            float* to = &air_[k * rows * lanes_ + lanes.first[b]];
            for (const Origin origin : all_origins) {
                std::copy_n(path.transmittance(b, k, origin), channels, to);
                to += lanes_;
            }
            std::copy_n(path.channel_radiance(b, k), channels, to);
        }
    }
}

void AirLanes::to(float range, float height_km, float* transmittance, float* radiance) const {
    const std::size_t n = lanes_, through = origin_count * n;
    std::fill_n(transmittance, through, 0.0f);
    std::fill_n(radiance, n, 0.0f);
    const Stencil across = stencil(grid_.range_place(range), grid_.ranges);
    const auto up = product_weights_of_few(grid_.height_place(height_km), grid_.heights);
    for (std::size_t i = 0; i < across.weight.size(); ++i) {
        for (std::size_t h = 0; h < grid_.heights; ++h) {
            const float weight = across.weight[i] * up[h];
            const float* t = &air_[((across.start + i) * grid_.heights + h) * rows * n];
            const float* l = t + through;
            for (std::size_t c = 0; c < through; ++c) transmittance[c] += weight * t[c];
            for (std::size_t c = 0; c < n; ++c) radiance[c] += weight * l[c];
        }
    }
}

}  // namespace diurna
