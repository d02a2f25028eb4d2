#include "render/rays/air_lanes.hpp"

#include <algorithm>

namespace diurna {

AirLanes::AirLanes(const Atmosphere& atmosphere, const PathExtent& extent,
                   std::span<const BandLight> bands, const ChannelLanes& lanes, double tolerance)
    : grid_(extent), lanes_(lanes.size()) {
    const PathTable path(atmosphere, extent, bands, tolerance);
    grid_ = path.grid();
    air_.assign(path.nodes() * 2 * lanes_, 0.0f);
    for (std::size_t k = 0; k < path.nodes(); ++k) {
        for (std::size_t b = 0; b < bands.size(); ++b) {
            const std::size_t channels = bands[b].channels.padded();
            float* to = &air_[k * 2 * lanes_ + lanes.first[b]];
            std::copy_n(path.transmittance(b, k), channels, to);
            std::copy_n(path.channel_radiance(b, k), channels, to + lanes_);
        }
    }
}

void AirLanes::to(float range, float height_km, float* transmittance, float* radiance) const {
    const std::size_t n = lanes_;
    std::fill_n(transmittance, n, 0.0f);
    std::fill_n(radiance, n, 0.0f);
    const Stencil across = stencil(grid_.range_place(range), grid_.ranges);
    const auto up = product_weights_of_few(grid_.height_place(height_km), grid_.heights);
    for (std::size_t i = 0; i < across.weight.size(); ++i) {
        for (std::size_t h = 0; h < grid_.heights; ++h) {
            const float weight = across.weight[i] * up[h];
            const float* t = &air_[((across.start + i) * grid_.heights + h) * 2 * n];
            const float* l = t + n;
            for (std::size_t c = 0; c < n; ++c) transmittance[c] += weight * t[c];
            for (std::size_t c = 0; c < n; ++c) radiance[c] += weight * l[c];
        }
    }
}

}  // namespace diurna
