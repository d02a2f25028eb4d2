#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "render/eye/eye_grid.hpp"
#include "render/light/radiance_terms.hpp"

namespace diurna {

/// Row and material of each of a few targets.
struct TargetRows {
    std::array<std::uint32_t, GridPlaces::most> slot;
    std::array<MaterialId, GridPlaces::most> material;
};

/// Radiance at the eye of a target, and how it changes with range [1/m] and height [1/m].
struct AtEye {
    float value = 0.0f, by_range = 0.0f, by_height = 0.0f;
};

/// The radiance at the eye in a band as one dot product per target: the contribution of each number
/// of an EyeRow at the eye, per material and position in range and height. Surface, air and
/// response are multiplied at the band's nodes.
class EyeTable {
 public:
    /// At the nodes of a PathTable.
    ///
    /// - band_index: of `band` in the PathTable
    /// - terms: the terms included
    EyeTable(const PathTable& path, std::size_t band_index, const BandLight& band,
             const TermSet& terms = all_terms);

    /// Radiance of a row at those nodes, for each material: (range, height).
    std::vector<Eigen::MatrixXd> radiance_of(std::span<const float> row) const;
    /// Interpolates the table to a finer grid.
    void refine(const EyeGrid& grid);

    /// Radiance at the eye of a few targets, `stride` apart; only after refine().
    ///
    /// - rows: (slot, number) EyeRows of their facets
    void look(const GridPlaces& places, const TargetRows& facets, const float* rows,
              std::size_t count, std::size_t stride, AtEye* out) const;

 private:
    std::size_t width_, ranges_, heights_;
    float per_height_ = 0.0f;
    std::vector<std::vector<float>> table_;  // (material)(range, height, number)
};

/// Contributions of the numbers of an EyeRow to the radiance leaving a surface of such optics,
/// without the air: (number).
std::vector<double> worth_on_leaving(const BandLight& band, const NodeOptics& optics,
                                     const TermSet& terms);

}  // namespace diurna
