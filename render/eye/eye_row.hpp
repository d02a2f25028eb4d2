#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "render/light/band_light.hpp"
#include "render/light/lanes.hpp"
#include "render/light/radiosity_tables.hpp"

namespace diurna {

/// Description of a facet at the eye that does not depend on its material: a row of numbers to be
/// multiplied by a row of an EyeTable.
///
///     thermal modes   black body at its temperature
///     light modes     light that arrives from the facets around
///     sky modes       light of the sky (SkyModes)
///     3               sunlit share × cosine / π × weight of a height
///     1               one
struct EyeRow {
    std::size_t thermal = 0, light = 0, skies = 0;  // modes
    std::size_t sky() const { return thermal + light; }
    std::size_t sun() const { return sky() + skies; }
    std::size_t one() const { return sun() + 3; }
    std::size_t width() const { return rounded_up(one() + 1); }

    /// - black, arriving: in the modes of the band
    /// - sky_modes: the facet's share of each
    /// - up: weights of the three heights
    void fill(const float* black, const float* arriving, const float* sky_modes, float sunlight,
              const std::array<float, 3>& up, float* out) const {
        for (std::size_t k = 0; k < thermal; ++k) out[k] = black[k];
        for (std::size_t k = 0; k < light; ++k) out[thermal + k] = arriving[k];
        for (std::size_t k = 0; k < skies; ++k) out[sky() + k] = sky_modes[k];
        for (std::size_t h = 0; h < 3; ++h) out[sun() + h] = sunlight * up[h];
        out[one()] = 1.0f;
    }

    /// For a surface at a temperature, under half a sky and among surroundings at the same
    /// temperature, in the sun or in the shade.
    ///
    /// - band_index: of `band` in the tables
    std::vector<float> standing_for(const RadiosityTables& tables, const BandLight& band,
                                    std::size_t band_index, float temperature, bool sunny) const;

    explicit EyeRow(const BandLight& band)
        : thermal(band.basis.thermal), light(band.basis.size()), skies(band.sky.size()) {}
};

}  // namespace diurna
