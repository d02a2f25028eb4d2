#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/light/directional_sky.hpp"
#include "render/light/radiance_input.hpp"

namespace diurna {

/// Upper bounds on interreflections in a band.
struct ReflectionBounds {
    float surrounded = 0.0f;  // largest 1 − sky view of a visible facet with sources
    float strongest = 0.0f;   // largest reflectance × (1 − sky view) of a lit facet, below 1
};

/// Share of a surface's radiosity that must reach a visible facet for the surface's surroundings to
/// be included.
inline constexpr float least_reach = 1e-5f;
/// Interreflections: all that are significant.
inline constexpr int all_bounces = 1000;

/// The facets on which a picture depends (visible ones, those that illuminate them, those that
/// illuminate these, and so on while significant) and their view factors: everything that is
/// constant while nothing moves.
struct LitFacets {
    std::vector<SurfaceId> facet;         // ascending
    std::vector<std::uint32_t> target;    // (input facet) index above
    std::vector<std::uint32_t> row;       // (lit + 1) light that arrives: [row[i], row[i + 1])
    std::vector<std::uint32_t> source;    // index of a lit facet
    std::vector<float> factor;            // of each source; a row adds up to 1 − sky view
    std::vector<MaterialId> material;     // (lit)
    std::vector<float> sky_view;          // (lit)
    std::vector<std::uint8_t> is_source;  // (lit) of some row
    /// (lit) Largest factor from a change of a facet's radiosity to a change of a visible facet's,
    /// over all paths of reflections: products of the largest reflectance in any band × (1 − sky
    /// view). 0 if it illuminates none.
    std::vector<float> reach;
    std::vector<float> returned;           // (lit) that greatest reflectance × (1 − sky view)
    std::vector<float> height;             // (lit) for height_weights()
    std::array<double, 3> height_km{};     // least, middle, most; with an edge within: least and
                                           // most below it, the middle of those above
    std::vector<bool> material_used;       // (material)
    std::vector<ReflectionBounds> bounds;  // (band)
};
/// - seen: of a view's targets, in their order
/// - bands: of the pictures
LitFacets lit_facets(const RadianceInput& input, std::span<const SurfaceId> seen,
                     std::span<const Band> bands);

/// Weights of the least, middle and greatest height for a height of −1 to 1: a quadratic, as
/// optical depths fall off exponentially with height. If light has a step in between
/// (RadianceInput::light_edge_km): 4 to 5 straight from the first height to the second, 8 the
/// third.
inline constexpr float straight_height = 4.0f, height_above_edge = 8.0f;
inline std::array<float, 3> height_weights(float y) {
    if (y >= height_above_edge) return {0.0f, 0.0f, 1.0f};
    if (y >= straight_height) return {straight_height + 1.0f - y, y - straight_height, 0.0f};
    return {0.5f * y * (y - 1.0f), 1.0f - y * y, 0.5f * y * (y + 1.0f)};
}

/// Range of the temperatures of the lit facets [K].
struct TemperatureExtent {
    float coldest = 300.0f, hottest = 300.0f;
    float middle() const { return 0.5f * (coldest + hottest); }
};

/// Values per lit facet that change from frame to frame.
struct LitState {
    std::vector<float> temperature;           // [K]
    std::vector<float> sunlight;              // sunlit share × cosine / π [sr⁻¹]
    std::vector<UnevenView> uneven;           // of the sky, relative to the sun
    std::vector<NarrowView> narrow;           // for facets that need it
    std::vector<std::uint32_t> narrow_place;  // (lit) index in `narrow`, from 1 on; 0: none
    TemperatureExtent extent;

    /// Empty: not needed.
    std::span<const float> narrow_of(std::size_t lit) const {
        if (narrow_place.empty() || narrow_place[lit] == 0) return {};
        return narrow[narrow_place[lit] - 1];
    }
};
/// Throws InputError if a temperature is not finite or outside 1 to 5000 K.
///
/// - bands: of the pictures
LitState lit_state(const RadianceInput& input, const LitFacets& lit, std::span<const Band> bands);

}  // namespace diurna
