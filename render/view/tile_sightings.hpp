#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/view/view.hpp"

namespace diurna {

/// A sample's weight in a pixel, so that fractions of samples are integers.
inline constexpr std::uint32_t one_sample = 1u << 16;

/// Samples of a pixel that hit one facet.
struct SampleGroup {
    std::uint32_t facet = 0;           // its number (terrain/visibility/copies.hpp)
    std::uint32_t parts = 0;           // of one_sample
    double range = 0.0, height = 0.0;  // [m] sums over samples
};

/// Sorts the sixteen samples of a bundle by facet, in the order in which each is first seen.
///
/// facet    (lane) index(no_facet): no hit
/// range    (lane) [m]; height (lane) [m]
/// used     number of lanes that count: the first ones
/// group    room for sixteen
/// returns  number of groups; their sums are taken in a fixed order
std::size_t group_samples(const std::uint32_t* facet, const float* range, const float* height,
                          std::size_t used, SampleGroup* group);

/// Merges `more` groups after the first `size` into these if they have the same facet. Returns the
/// new number.
std::size_t merge_groups(SampleGroup* groups, std::size_t size, std::size_t more);

/// Sightings and targets of one tile's pixels, as in View, with targets counted from the tile's
/// first.
struct TileSightings {
    std::vector<Sighting> sighting;
    std::vector<std::uint32_t> end;  // (pixel of the tile) of its sightings
    std::vector<std::uint32_t> met;  // (target) numbers of surfaces and of copies' facets
    std::vector<float> range, height;
};

/// Collects a tile's sightings pixel by pixel and numbers its targets. One for each thread.
class TileGatherer {
 public:
    TileGatherer();
    void start_tile();
    /// The groups of a pixel; `share`: of a sample in it. Pixels come in ascending order in the
    /// tile; skipped ones see nothing.
    void add_pixel(std::size_t place, std::span<const SampleGroup> groups, float share);
    TileSightings finish_tile(std::size_t pixels);

 private:
    struct Seen {
        std::uint32_t facet = 0;
        float near = 1e30f, far = 0.0f, low = 1e30f, high = -1e30f;
        double samples = 0.0, range = 0.0, height = 0.0;  // sums
        bool narrow() const { return far <= near * (1.0f + 1.0f / 128.0f) && high - low <= 16.0f; }
    };
    std::uint32_t place_of(std::uint32_t facet);
    void grow();
    void split_deep();

    std::vector<std::uint32_t> slot_;  // hash table: index into seen_ + 1, or 0
    int shift_ = 20;                   // of a hash to a slot
    std::vector<Seen> seen_;
    std::vector<float> samples_;  // (sighting)
    TileSightings tile_;
};

}  // namespace diurna
