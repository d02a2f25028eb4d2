#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "materials/band.hpp"
#include "materials/material.hpp"
#include "render/band_table.hpp"

namespace diurna {

/// Optics of one material in channels over the cosine of the angle, linear between nodes that
/// crowd at grazing angles.
class AngleTable {
 public:
    AngleTable() = default;
    AngleTable(const Material& material, const Band& band, const Channels& channels,
               double temperature);
    /// mirrored, diffuse, transmittance at a channel.
    struct Place {
        const float *low, *high;
        float t;
        std::size_t padded;
        float mirrored(std::size_t c) const { return low[c] + t * (high[c] - low[c]); }
        float diffuse(std::size_t c) const { return mirrored(padded + c); }
        float transmittance(std::size_t c) const { return mirrored(2 * padded + c); }
    };
    Place at(double cosine_of) const {
        const double u = std::sqrt(std::clamp(cosine_of, 0.0, 1.0)) * double(nodes - 1);
        const std::size_t k = std::min(nodes - 2, static_cast<std::size_t>(u));
        const float* low = &values_[k * parts * padded_];
        return {low, low + parts * padded_, static_cast<float>(u - double(k)), padded_};
    }
    float mean_diffuse(std::size_t c) const { return hemisphere_[c]; }
    double roughness = -1.0;  // of the mirrored lobe; negative: none

 private:
    static constexpr std::size_t nodes = 128, parts = 3;
    static double cosine(std::size_t k) {
        const double u = double(k) / double(nodes - 1);
        return u * u;
    }
    std::size_t padded_ = 0;
    std::vector<float> values_;  // (node, part, channel)
    std::vector<float> hemisphere_;
};

}  // namespace diurna
