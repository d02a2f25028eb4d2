#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "materials/matter/material.hpp"
#include "materials/radiation/band.hpp"
#include "render/light/band_channels.hpp"

namespace diurna {

/// The channels of several bands side by side: those of band b are lanes [first[b], first[b + 1]),
/// zeros to spare included.
struct Lanes {
    std::vector<std::size_t> first;  // (band + 1)
    std::size_t size() const { return first.back(); }
};
Lanes lanes_of(std::span<const Channels> channels);

/// Optics of one material in lanes over the cosine of the angle to the normal: mirrored, diffuse
/// and transmitted share, weighted inside a channel by a black body. Linear between 128 nodes that
/// are equal in the root of the cosine and so crowd at grazing angles.
class AngleTable {
 public:
    AngleTable() = default;
    /// temperature  [K] of that black body
    AngleTable(const Material& material, std::span<const Band> bands,
               std::span<const Channels> channels, const Lanes& lanes, double temperature);

    struct Place {
        const float *low, *high;
        float t;
        std::size_t lanes;
        float mirrored(std::size_t c) const { return low[c] + t * (high[c] - low[c]); }
        float diffuse(std::size_t c) const { return mirrored(lanes + c); }
        float transmittance(std::size_t c) const { return mirrored(2 * lanes + c); }
    };
    Place at(double cosine) const;
    /// Diffuse share (lane) averaged over the hemisphere, ∫ 2 cosθ d cosθ.
    float mean_diffuse(std::size_t lane) const { return hemisphere_[lane]; }
    /// Of the mirrored lobe; negative: there is none.
    double roughness() const { return roughness_; }

 private:
    static constexpr std::size_t nodes = 128, parts = 3;
    static double cosine_at(std::size_t node);
    std::size_t lanes_ = 0;
    double roughness_ = -1.0;
    std::vector<float> values_;  // (node, part, lane)
    std::vector<float> hemisphere_;
};

}  // namespace diurna
