#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "materials/matter/material.hpp"
#include "render/rays/channel_lanes.hpp"

namespace diurna {

/// Optics of one material in lanes over the cosine of the angle to the normal: mirrored, diffuse
/// and transmitted share, weighted inside a channel by a black body. Linear between 128 nodes,
/// equally spaced in the root of the cosine, so denser at grazing angles.
class AngleTable {
 public:
    AngleTable() = default;
    /// - temperature: [K] of that black body
    AngleTable(const Material& material, std::span<const BandLight> bands,
               const ChannelLanes& lanes, double temperature);

    struct Place {
        const float *low, *high;
        float t;
        std::size_t lanes;
        float mirrored(std::size_t c) const { return low[c] + t * (high[c] - low[c]); }
        float diffuse(std::size_t c) const { return mirrored(lanes + c); }
        float transmittance(std::size_t c) const { return mirrored(2 * lanes + c); }
        /// Reflectance of one microfacet of a rough surface.
        float facing(std::size_t c) const { return mirrored(3 * lanes + c); }
    };
    Place at(double cosine) const;
    /// Diffuse share (lane) averaged over the hemisphere, ∫ 2 cosθ d cosθ.
    float mean_diffuse(std::size_t lane) const { return hemisphere_[lane]; }
    /// Of the mirrored lobe; negative: no lobe.
    double roughness() const { return roughness_; }

 private:
    static constexpr std::size_t nodes = 128, parts = 4;
    /// Reflectance of the material's interface at the nodes and at the laboratory's angle.
    struct Interface {
        std::vector<double> at_node, smooth;
        double normal = 0.0;
    };
    static double root_at(std::size_t node) { return double(node) / double(nodes - 1); }
    static double cosine_at(std::size_t node) { return root_at(node) * root_at(node); }
    Interface interface_of(const Material& material, double wavelength_um) const;
    void fill(const Material& material, const BandLight& band, std::span<const double> shape,
              std::size_t channel, std::size_t lane, const Interface& interface);
    void average(std::size_t lane);

    std::size_t lanes_ = 0;
    double roughness_ = -1.0;
    std::vector<float> values_;  // (node, part, lane)
    std::vector<float> hemisphere_;
    std::vector<std::vector<double>> shares_;  // (node, and the laboratory's angle) facing_shares()
};

}  // namespace diurna
