#pragma once

#include <functional>
#include <span>
#include <vector>

#include "render/eye/eye_row.hpp"
#include "render/eye/eye_table.hpp"
#include "render/light/scene_light.hpp"
#include "render/view/view.hpp"

namespace diurna {

/// Eye tables in parallel, on one grid: one column per band, or one for each term of each band,
/// consecutive for each band.
class EyeTables {
 public:
    struct Options {
        bool by_term = false;
        double tolerance = 1e-3;  // [K] of apparent temperature, of linear interpolation
    };
    /// - path: of the bands of `light`
    EyeTables(const PathTable& path, const SceneLight& light, const Options& options);

    std::size_t columns() const { return tables_.size(); }
    std::size_t columns_of_band() const { return tables_.size() / rows_.size(); }
    const EyeGrid& grid() const { return grid_; }

    /// Radiance at the eye of every target of a view, (target, column).
    void look(const View& view, const SceneLight& light, std::span<AtEye> out) const;
    /// Contribution of the whole sun on some targets of a view, (target chosen, column).
    void look_at_sun(const View& view, const SceneLight& light,
                     std::span<const std::uint32_t> targets, std::span<AtEye> out) const;
    /// Additional emission of targets that are warmer by given amounts.
    ///
    /// - warmer: (target chosen) [K]; targets may be chosen several times
    void look_at_warmth(const View& view, const SceneLight& light,
                        std::span<const std::uint32_t> targets, std::span<const float> warmer,
                        std::span<AtEye> out) const;

 private:
    void look(const View& view, const SceneLight& light, std::size_t begin, std::size_t end,
              std::span<AtEye> out) const;

    /// - fill: (band, target chosen, row of zeros) writes the input
    using Fill = std::function<void(std::size_t b, std::size_t k, float* row)>;
    void look_at(const View& view, const SceneLight& light, std::span<const std::uint32_t> targets,
                 const Fill& fill, std::span<AtEye> out) const;

    std::vector<EyeRow> rows_;      // (band)
    std::vector<EyeTable> tables_;  // (column)
    EyeGrid grid_;
};

}  // namespace diurna
