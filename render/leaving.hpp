#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "render/mode_table.hpp"
#include "render/radiance.hpp"

namespace diurna {

/// The facets a picture depends on (those seen, those that shine on them, and those that shine on
/// these in turn) and who shines on whom: all that stays the same while nothing moves.
struct LitFacets {
    static constexpr std::uint32_t absent = 0xFFFFFFFFu;
    std::vector<FacetId> facet;         // ascending
    std::vector<std::uint32_t> place;   // (facet of the scene) index above, or absent
    std::vector<std::uint32_t> row;     // (lit + 1) light received: [row[i], row[i + 1])
    std::vector<std::uint32_t> source;  // index of a lit facet
    std::vector<float> factor;          // of each source; a row adds up to 1 − sky view
    std::vector<std::uint8_t> shining;  // (lit) shines on a facet that is seen
    std::vector<float> height;          // (lit) −1 to 1 from the lowest to the highest
    std::array<double, 3> height_km{};  // least, middle, most of them
    std::vector<bool> material_used;    // (material)
};
LitFacets lit_facets(const RadianceInput& input, std::span<const FacetId> seen);

/// Range of the temperatures of the facets lit [K].
struct TemperatureExtent {
    float coldest = 300.0f, hottest = 300.0f;
};
/// Throws InputError if one is not finite or outside 1 to 5000 K.
TemperatureExtent temperature_extent(const RadianceInput& input, const LitFacets& lit);

/// Reflected light of one band: reflectance × light per material and height.
struct ReflectedLight {
    std::vector<std::array<std::vector<float>, 3>> sun, sky;  // (material)(height)(channel)
};
ReflectedLight reflected_light(const Band& band, const Channels& channels,
                               const MaterialLibrary& materials, const std::vector<bool>& used,
                               std::span<const Light, 3> light);
ReflectedLight in_modes(const ReflectedLight& light, const ModeBasis& basis);

/// Floats without a value yet, from memory that earlier frames have used and given back: what the
/// system would have to hand out and clear anew costs more than to fill it.
class Scratch {
 public:
    explicit Scratch(std::size_t size);
    ~Scratch();
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;
    float& operator[](std::size_t i) { return memory_[i]; }
    const float& operator[](std::size_t i) const { return memory_[i]; }

 private:
    std::unique_ptr<float[]> memory_;
    std::size_t size_;
};

/// How much of the reflected light of surroundings is followed.
struct BounceOptions {
    int bounces = 2;  // 1: what surroundings reflect of each other counts as black
    /// [K] of apparent temperature at the scene's cold end. A neighbour's second bounce is left out
    /// where it changes no facet seen by more, as told by the temperatures around it and by
    /// `sunlight`; what all neighbours of a facet leave out together is no more than this.
    float tolerance = 3e-4f;
    float sunlight = 0.0f;     // [K] of a white surface in the sun, over the slope at the cold end
    float skylight = 0.0f;     // [K] of scattered sunlight from a whole open sky, likewise
    float most_change = 1e3f;  // [K] no neighbour differs by more, sunlight included
};

/// leaving_radiance() in modes, for many facets at a time.
///
/// With two bounces, what a neighbour reflects of its own neighbours is followed; those neighbours'
/// neighbours count as black at their temperature. `left` bounds the rest.
class Leaving {
 public:
    Leaving(const RadianceInput& input, const LitFacets& lit, const ModeTable& table,
            const ReflectedLight& light, std::span<const float> reflectance,
            const BounceOptions& options);

    /// Coefficients of what leaves a facet that is seen: the sum of all terms.
    void total(FacetId facet, float* out) const;
    /// The terms one by one, (term, mode) padded.
    void terms(FacetId facet, float* out) const;
    std::size_t padded() const { return table_.padded(); }
    std::size_t followed() const { return second_.size(); }  // facets with a second bounce

 private:
    void first(std::size_t i, float* sum) const;
    void around(std::size_t i, float* out) const;

    const RadianceInput& input_;
    const LitFacets& lit_;
    const ModeTable& table_;
    const ReflectedLight& light_;
    std::vector<float> sent_;             // (lit, mode) what each lit facet sends
    std::vector<std::uint8_t> followed_;  // (lit) `sent_` holds its second bounce
    std::vector<std::uint32_t> second_;   // lit facets whose second bounce is followed, ascending
};

}  // namespace diurna
