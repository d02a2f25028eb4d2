#include "render/eye/eye_row.hpp"

#include <numbers>

namespace diurna {

std::vector<float> EyeRow::standing_for(const RadiosityTables& tables, const BandLight& band,
                                        std::size_t band_index, float temperature,
                                        bool sunny) const {
    std::vector<float> black(tables.lanes), row(width(), 0.0f);
    black_modes(tables, temperature, black.data());
    std::vector<float> arriving = black;
    for (float& x : arriving) x *= 0.5f;
    constexpr std::array<float, 3> up = {0.0f, 1.0f, 0.0f};
    std::array<float, SkyModes::most> sky;
    band.sky.of(0.5f, {}, {}, up, sky.data());
    const std::size_t first = tables.first[band_index];
    fill(&black[first], &arriving[first], sky.data(),
         sunny ? 0.5f / std::numbers::pi_v<float> : 0.0f, up, row.data());
    return row;
}

}  // namespace diurna
