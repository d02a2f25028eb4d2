#include "render/eye/facet_rows.hpp"

#include <array>

namespace diurna {

FacetRows::FacetRows(const SceneLight& light)
    : light_(light),
      layout_(light.band.begin(), light.band.end()),
      black_(light.tables.lanes),
      arriving_(light.tables.lanes) {}

void FacetRows::fill(std::uint32_t lit, std::span<float* const> out) {
    const RadiosityTables& tables = light_.tables;
    black_modes(tables, light_.state.temperature[lit], black_.data());
    light_.radiosity.arriving(lit, black_.data(), arriving_.data());
    const std::array<float, 3> up = height_weights(light_.lit.height[lit]);
    std::array<float, SkyModes::most> sky;
    for (std::size_t b = 0; b < layout_.size(); ++b) {
        light_.band[b].sky.of(light_.lit.sky_view[lit], light_.state.uneven[lit],
                              light_.state.narrow_of(lit), up, sky.data());
        layout_[b].fill(&black_[tables.first[b]], &arriving_[tables.first[b]], sky.data(),
                        light_.state.sunlight[lit], up, out[b]);
    }
}

}  // namespace diurna
