#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "render/eye/eye_grid.hpp"
#include "render/light/radiance_terms.hpp"

namespace diurna {

/// Which row and which material belong to each of a few targets.
struct TargetRows {
    std::array<std::uint32_t, GridPlaces::most> slot;
    std::array<MaterialId, GridPlaces::most> material;
};

/// Radiance at the eye of a target, and how it changes with range [1/m] and height [1/m].
struct AtEye {
    float value = 0.0f, by_range = 0.0f, by_height = 0.0f;
};

/// The radiance at the eye in a band as one dot product a target: what each number of an EyeRow is
/// worth at the eye, per material and place in range and height. Surface, air and response are
/// multiplied at the band's nodes, where they belong together.
class EyeTable {
 public:
    /// At the nodes of a PathTable.
    ///
    /// - band_index: of `band` in the PathTable
    /// - terms: that are in it
    EyeTable(const PathTable& path, std::size_t band_index, const BandLight& band,
             const TermSet& terms = all_terms);

    /// Radiance at those nodes of a row, for each material: (range, height).
    std::vector<Eigen::MatrixXd> radiance_of(std::span<const float> row) const;
    /// Carries the table over to a finer grid.
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

/// What the numbers of an EyeRow are worth where light leaves a surface of such optics, before the
/// air: (number).
std::vector<double> worth_on_leaving(const BandLight& band, const NodeOptics& optics,
                                     const TermSet& terms);

}  // namespace diurna
