#include "render/eye/eye_row.hpp"

#include <numbers>

namespace diurna {

std::vector<float> EyeRow::standing_for(const RadiosityTables& tables, std::size_t band,
                                        float temperature, bool sunny) const {
    std::vector<float> black(tables.lanes), row(width(), 0.0f);
    black_modes(tables, temperature, black.data());
    std::vector<float> arriving = black;
    for (float& x : arriving) x *= 0.5f;
    fill(&black[tables.first[band]], &arriving[tables.first[band]], 0.5f,
         sunny ? 0.5f / std::numbers::pi_v<float> : 0.0f, {0.0f, 1.0f, 0.0f}, row.data());
    return row;
}

}  // namespace diurna
