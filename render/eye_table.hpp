#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "render/node_optics.hpp"
#include "render/path_table.hpp"
#include "render/spectral_basis.hpp"

namespace diurna {

/// Where a few targets lie on the grid of a PathTable: weights of its nodes and their slopes by
/// range and height [1/m], one array per node so that they are worked out in vector code.
struct GridPlaces {
    static constexpr std::size_t most = 64;
    std::array<std::uint32_t, most> start;  // first of four ranges
    alignas(64) std::array<std::array<float, most>, 4> range, range_slope;
    alignas(64) std::array<std::array<float, most>, 5> height, height_slope;
};
class PathGrid {
 public:
    PathGrid(const PathTable& path, double ground_height_km);
    /// range [m], its cube root, and height [m] of up to `most` targets
    void place(std::span<const float> range, std::span<const float> range_root,
               std::span<const float> height, GridPlaces& out) const;

 private:
    float root_low_, places_per_root_;      // [m^⅓], [m^-⅓]
    float height_low_, places_per_height_;  // [m], [1/m]
    std::size_t ranges_, heights_;
};

/// What describes a facet at the eye, whatever its material: a row of numbers to be multiplied with
/// a row of an EyeTable.
///
///     thermal modes   black body at its temperature
///     light modes     light of its surroundings
///     3               sky view × weight of a height of LitFacets
///     3               sunlit share × cosine / π × weight of a height
///     1               one
struct EyeRow {
    std::size_t thermal = 4, light = 4;  // whole groups of four
    std::size_t sky() const { return thermal + light; }
    std::size_t sun() const { return sky() + 3; }
    std::size_t one() const { return sun() + 3; }
    std::size_t width() const { return (one() + 8) / 8 * 8; }  // whole registers

    /// black, around  in the modes of the band; up: weights of the three heights
    void fill(const float* black, const float* around, float sky_view, float sunlight,
              const std::array<float, 3>& up, float* out) const {
        for (std::size_t k = 0; k < thermal; ++k) out[k] = black[k];
        for (std::size_t k = 0; k < light; ++k) out[thermal + k] = around[k];
        for (std::size_t h = 0; h < 3; ++h) {
            out[sky() + h] = sky_view * up[h];
            out[sun() + h] = sunlight * up[h];
        }
        out[one()] = 1.0f;
    }

    explicit EyeRow(const SpectralBasis& basis)
        : thermal((basis.thermal + 3) / 4 * 4), light((basis.size() + 3) / 4 * 4) {}
};

/// Radiance at the eye of a target, and how it changes with range [1/m] and height [1/m].
struct AtEye {
    float value = 0.0f, by_range = 0.0f, by_height = 0.0f;
};

/// Which terms of the signature equation a table holds.
using TermSet = std::array<bool, term_count>;
inline constexpr TermSet all_terms = {true, true, true, true, true, true};

/// The signature equation of a band as one dot product a target: what each number of an EyeRow is
/// worth at the eye, per material and node of the grid of ranges and heights. Surface, air and
/// response are multiplied at the band's nodes, where they belong together.
class EyeTable {
 public:
    /// light  at the three heights of LitFacets
    EyeTable(const PathTable& path, std::size_t band_index, const Band& band,
             const Channels& channels, const SpectralBasis& basis,
             std::span<const NodeOptics> optics, const std::array<Light, 3>& light,
             const TermSet& terms = all_terms);

    /// row  EyeRow of the target's facet
    AtEye operator()(MaterialId material, const GridPlaces& places, std::size_t k,
                     const float* row) const;

 private:
    template <std::size_t Heights>
    AtEye at(const float* table, const GridPlaces& places, std::size_t k, const float* row) const;

    std::size_t width_, heights_;
    std::vector<std::vector<float>> table_;  // (material)(range, height, number)
};

}  // namespace diurna
