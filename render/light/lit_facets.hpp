#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/light/directional_sky.hpp"
#include "render/light/radiance_input.hpp"

namespace diurna {

/// What light that surfaces reflect of each other can come to in a band.
struct ReflectionBounds {
    float surrounded = 0.0f;  // the greatest 1 − sky view of a facet seen that has sources
    float strongest = 0.0f;  // the greatest reflectance × (1 − sky view) of a lit facet, below 1
};

/// Of what a surface sends, the share that has to reach a facet seen for its surroundings to
/// matter.
inline constexpr float least_reach = 1e-5f;
/// Of light between surfaces: as many as count.
inline constexpr int all_bounces = 1000;

/// The facets a picture depends on (those seen, those that shine on them, those that shine on these
/// in turn, and so on while it matters) and who shines on whom: all that stays the same while
/// nothing moves.
struct LitFacets {
    std::vector<FacetId> facet;           // ascending
    std::vector<std::uint32_t> target;    // (facet handed in) index above
    std::vector<std::uint32_t> row;       // (lit + 1) light that arrives: [row[i], row[i + 1])
    std::vector<std::uint32_t> source;    // index of a lit facet
    std::vector<float> factor;            // of each source; a row adds up to 1 − sky view
    std::vector<MaterialId> material;     // (lit)
    std::vector<float> sky_view;          // (lit)
    std::vector<std::uint8_t> is_source;  // (lit) of some row
    /// (lit) The most of a difference in what a facet sends that comes to a difference in what one
    /// seen sends, along the best way of reflections: products of the greatest reflectance in any
    /// band × (1 − sky view). 0 if it is the source of none.
    std::vector<float> reach;
    std::vector<float> returned;           // (lit) that greatest reflectance × (1 − sky view)
    std::vector<float> height;             // (lit) for height_weights()
    std::array<double, 3> height_km{};     // least, middle, most; with an edge within: least and
                                           // most below it, the middle of those above
    std::vector<bool> material_used;       // (material)
    std::vector<ReflectionBounds> bounds;  // (band)
};
/// - seen: of a view's targets, in their order
/// - bands: that pictures are to be made in
LitFacets lit_facets(const RadianceInput& input, std::span<const FacetId> seen,
                     std::span<const Band> bands);

/// Weights of the least, middle and greatest height for a height of −1 to 1: a quadratic, as
/// optical depths fall off exponentially with height. Where light jumps in between
/// (RadianceInput::light_edge_km): 4 to 5 straight from the first height to the second, 8 the
/// third.
inline constexpr float straight_height = 4.0f, height_above_edge = 8.0f;
inline std::array<float, 3> height_weights(float y) {
    if (y >= height_above_edge) return {0.0f, 0.0f, 1.0f};
    if (y >= straight_height) return {straight_height + 1.0f - y, y - straight_height, 0.0f};
    return {0.5f * y * (y - 1.0f), 1.0f - y * y, 0.5f * y * (y + 1.0f)};
}

/// Range of the temperatures of the facets lit [K].
struct TemperatureExtent {
    float coldest = 300.0f, hottest = 300.0f;
    float middle() const { return 0.5f * (coldest + hottest); }
};

/// What changes from frame to frame, per facet lit.
struct LitState {
    std::vector<float> temperature;           // [K]
    std::vector<float> sunlight;              // sunlit share × cosine / π [sr⁻¹]
    std::vector<UnevenView> uneven;           // of the sky, about the sun
    std::vector<NarrowView> narrow;           // of those of which it counts
    std::vector<std::uint32_t> narrow_place;  // (lit) in `narrow`, from 1 on; 0: it has none
    TemperatureExtent extent;

    /// Empty: it does not count.
    std::span<const float> narrow_of(std::size_t lit) const {
        if (narrow_place.empty() || narrow_place[lit] == 0) return {};
        return narrow[narrow_place[lit] - 1];
    }
};
/// Throws InputError if a temperature is not finite or outside 1 to 5000 K.
///
/// - bands: that pictures are made in
LitState lit_state(const RadianceInput& input, const LitFacets& lit, std::span<const Band> bands);

}  // namespace diurna
