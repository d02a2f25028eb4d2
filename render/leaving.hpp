#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/band_table.hpp"
#include "render/radiance.hpp"

namespace diurna {

/// The facets a picture depends on, those seen and those that shine on them, with what shading
/// needs of each.
struct LitFacets {
    struct State {
        MaterialId material{};
        float temperature = 0.0f;  // [K]
        float sunlight = 0.0f;     // f cosθ / π
        float sky_view = 0.0f;
        std::array<float, 3> height_weight{};  // of the three heights light is known at
    };
    static constexpr std::uint32_t absent = 0xFFFFFFFFu;
    std::vector<FacetId> facet;            // ascending
    std::vector<State> state;              // of each
    std::vector<std::uint32_t> place;      // (facet of the scene) index above, or absent
    std::vector<bool> material_used;       // (material)
    std::array<double, 3> height_km{};     // least, middle, most of them
    float coldest = 0.0f, hottest = 0.0f;  // [K]
};
/// Throws InputError if a temperature among them is not finite or outside 1 to 5000 K.
LitFacets lit_facets(const RadianceInput& input, std::span<const FacetId> seen);

/// Reflected light of one band: reflectance × light per material, height and channel.
struct ReflectedLight {
    std::vector<std::array<std::vector<float>, 3>> sun, sky;  // (material)(height)(channel)
};
ReflectedLight reflected_light(const Band& band, const Channels& channels,
                               const MaterialLibrary& materials, const std::vector<bool>& used,
                               std::span<const Light, 3> light);

/// leaving_radiance() in channels and from tables, for many facets at a time.
class Leaving {
 public:
    Leaving(const RadianceInput& input, const LitFacets& lit, const SurfaceTable& table,
            const ReflectedLight& light);

    /// Σ weight × radiance leaving each of `seen` [W m⁻² sr⁻¹], (facet, channel) padded: the sum
    /// of all terms, or one of them.
    void total(std::span<const FacetId> seen, std::vector<float>& out) const;
    void term(Term term, std::span<const FacetId> seen, std::vector<float>& out) const;

 private:
    void around(FacetId facet, float* out, float* black) const;
    template <class Combine>
    void each(std::span<const FacetId> seen, std::vector<float>& out, const Combine& combine) const;

    const RadianceInput& input_;
    const LitFacets& lit_;
    const SurfaceTable& table_;
    const ReflectedLight& light_;
    std::vector<float> sent_;  // (lit facet, channel) J of radiance.hpp
};

}  // namespace diurna
