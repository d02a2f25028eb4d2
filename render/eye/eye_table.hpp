#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "render/light/interreflection.hpp"
#include "render/light/node_optics.hpp"
#include "render/light/spectral_basis.hpp"
#include "render/path/path_table.hpp"

namespace diurna {

/// A grid over range^⅓ and height so fine that its cells may be taken as straight: that of a
/// PathTable, subdivided.
struct EyeGrid {
    std::size_t ranges = 2, heights = 2;
    float root_low = 0.0f, per_root = 0.0f;      // [m^⅓], cells per m^⅓
    float height_low = 0.0f, per_height = 0.0f;  // [m], cells per m
    double error = 0.0;  // of straight cells [K] of apparent temperature, as told by `worth`
};
/// worth      (band)(range, height of the path table) radiance at the eye of surfaces that stand
///            for the scene's
/// tolerance  [K]
EyeGrid eye_grid(const PathTable& path, double ground_height_km, std::span<const Band> bands,
                 std::span<const std::vector<Eigen::MatrixXd>> worth, double tolerance);

/// Where a few targets lie on it, one array per number so that they are worked out in vector code.
struct GridPlaces {
    static constexpr std::size_t most = 64;
    std::array<std::uint32_t, most> start;  // node of the cell's beginning
    std::array<float, most> range, height;  // place in the cell, 0 to 1
    std::array<float, most> per_metre;      // cells per metre of range
};
/// range [m], its cube root, and height [m] of up to `most` targets
void find_places(const EyeGrid& grid, std::span<const float> range,
                 std::span<const float> range_root, std::span<const float> height, GridPlaces& out);

/// What describes a facet at the eye, whatever its material: a row of numbers to be multiplied with
/// a row of an EyeTable.
///
///     thermal modes   black body at its temperature
///     light modes     light of its surroundings
///     3               sky view × weight of a height of LitFacets
///     3               sunlit share × cosine / π × weight of a height
///     1               one
struct EyeRow {
    std::size_t thermal = 0, light = 0;  // modes
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

    /// Of a surface at a temperature, under half a sky and among surroundings as warm, in the sun
    /// or in the shade.
    std::vector<float> standing_for(const LightTables& tables, std::size_t band, float temperature,
                                    bool sunny) const;

    explicit EyeRow(const SpectralBasis& basis) : thermal(basis.thermal), light(basis.size()) {}
};

/// Which row and which material belong to each of a few targets.
struct TargetRows {
    std::array<std::uint32_t, GridPlaces::most> slot;
    std::array<MaterialId, GridPlaces::most> material;
};

/// Radiance at the eye of a target, and how it changes with range [1/m] and height [1/m].
struct AtEye {
    float value = 0.0f, by_range = 0.0f, by_height = 0.0f;
};

/// Which terms of the signature equation a table holds.
using TermSet = std::array<bool, term_count>;
inline constexpr TermSet all_terms = {true, true, true, true, true, true};

/// The signature equation of a band as one dot product a target: what each number of an EyeRow is
/// worth at the eye, per material and place in range and height. Surface, air and response are
/// multiplied at the band's nodes, where they belong together.
class EyeTable {
 public:
    /// At the nodes of a PathTable.
    ///
    /// light  at the three heights of LitFacets
    EyeTable(const PathTable& path, std::size_t band_index, const Band& band,
             const Channels& channels, const SpectralBasis& basis,
             std::span<const NodeOptics> optics, const std::array<Light, 3>& light,
             const TermSet& terms = all_terms);

    /// Radiance at those nodes of a row, for each material: (range, height).
    std::vector<Eigen::MatrixXd> worth(std::span<const float> row) const;
    /// Carries the table over to a finer grid.
    void refine(const EyeGrid& grid);

    /// Radiance at the eye of a few targets, `stride` apart; only after refine().
    ///
    /// rows  (slot, number) EyeRows of their facets
    void look(const GridPlaces& places, const TargetRows& facets, const float* rows,
              std::size_t count, std::size_t stride, AtEye* out) const;

 private:
    std::size_t width_, ranges_, heights_;
    float per_height_ = 0.0f;
    std::vector<std::vector<float>> table_;  // (material)(range, height, number)
};

}  // namespace diurna
