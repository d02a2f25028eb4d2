#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/light/band_channels.hpp"
#include "render/light/lit_facets.hpp"
#include "render/light/node_optics.hpp"
#include "render/light/reused_memory.hpp"
#include "render/light/spectral_basis.hpp"

namespace diurna {

/// Weights of the least, middle and greatest height for a height of −1 to 1: a quadratic, as
/// optical depths fall off exponentially with height.
inline std::array<float, 3> height_weights(float y) {
    return {0.5f * y * (y - 1.0f), 1.0f - y * y, 0.5f * y * (y + 1.0f)};
}

/// What surfaces send to each other, in modes (spectral_basis.hpp) of all bands side by side, so
/// that one walk along a facet's neighbours serves every band. A band's modes fill whole groups of
/// four lanes, all bands together whole groups of eight; lanes to spare hold zeros.
struct LightTables {
    struct OfMaterial {
        // (cell, power, lane) cubics in temperature: ε B with what shines through, and ρ B
        std::vector<float> emitted, reflected;
        // (lane) at the three heights: ρ × mean radiance of the sky, ρ × irradiance of the sun
        std::array<std::vector<float>, 3> sky, sun;
        // (band)(mode in, lane out) multiplication by ρ
        std::vector<std::vector<float>> reflection;
    };
    TemperatureGrid grid;
    std::size_t lanes = 0;
    std::vector<std::size_t> first;  // (band + 1) its lanes are [first[b], first[b + 1])
    std::vector<std::size_t> size;   // (band) modes
    std::vector<float> black;        // (cell, power, lane) B
    std::vector<OfMaterial> material;
};

/// light  (band) at the three heights of LitFacets
LightTables light_tables(std::span<const Band> bands, std::span<const SpectralBasis> basis,
                         std::span<const std::vector<NodeOptics>> optics,
                         std::span<const std::array<Light, 3>> light, const TemperatureGrid& grid);

/// Black body at a temperature, (lane).
void black_modes(const LightTables& tables, float temperature, float* out);

/// How much of the reflected light of surroundings is followed, per band.
struct BounceOptions {
    int bounces = 2;           // 1: what surroundings reflect of each other counts as black
    float tolerance = 3e-4f;   // [K] a second bounce is left out where it changes less
    float most_change = 1e3f;  // [K] no neighbour differs by more, sunlight included
};

/// What every facet lit sends to the others, in modes.
///
/// Light of the sky, of the sun, its own heat and, with two bounces, what it reflects of its
/// neighbours; their neighbours count as black at the receiver's temperature, so that an isothermal
/// enclosure is exactly black. A facet without sources is closed likewise.
class SentLight {
 public:
    SentLight(const LitFacets& lit, const LitState& state, const LightTables& tables,
              std::span<const BounceOptions> bounces);

    /// Black body at a facet's temperature, (lane).
    void black(std::size_t lit, float* out) const {
        black_modes(tables_, state_.temperature[lit], out);
    }
    /// Light that falls on it from its surroundings: Σ F_j J_j, over a hemisphere 1 − sky view.
    void around(std::size_t lit, const float* black, float* out) const;
    /// Asks the memory for what around() will need.
    void fetch(std::size_t lit) const {
        for (std::uint32_t e = lit_.row[lit]; e < lit_.row[lit + 1]; ++e) {
            __builtin_prefetch(&sent_[std::size_t{lit_.source[e]} * tables_.lanes]);
        }
    }
    std::size_t followed() const { return followed_; }  // facets with a second bounce

 private:
    void first(std::size_t lit, float* out) const;
    void second(std::size_t lit, float* out) const;

    const LitFacets& lit_;
    const LitState& state_;
    const LightTables& tables_;
    ReusedFloats sent_;  // (lit, lane)
    std::size_t followed_ = 0;
};

}  // namespace diurna
