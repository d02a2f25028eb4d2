#pragma once

#include <cstddef>
#include <vector>

#include "render/rays/hop_rows.hpp"
#include "render/rays/hop_tables.hpp"
#include "render/rays/rough_mirror.hpp"

namespace diurna {

/// Adds what rough mirrors show at large (rough_mirror.hpp) to the light of a pixel's hops, and
/// takes from what rays off them meet what is shown of it already.
class LobeLight {
 public:
    LobeLight(const HopTables& tables, const RoughMirrors& rough);

    bool has(const Hop& hop) const { return rough_.has(hop); }
    void begin(const HopRows& rows);
    /// What a rough mirror shows of the background and, by their mean, of the facets around.
    void add(std::size_t mirror, HopRows& rows);
    /// Takes away what the sum over the lobe has for what a ray off a rough mirror meets.
    void take_expected(std::size_t i, HopRows& rows);
    /// Of the light that a rough mirror sends on, the share of the ray to a hop, (lane): past the
    /// hops before.
    void pass(std::size_t i, HopRows& rows) const;

 private:
    const float* row(std::size_t i, RoughMirrors::Row row) const {
        return &lobe_[(i * RoughMirrors::row_count + row) * tables_.lanes.size()];
    }
    float open_above(std::size_t mirror, const HopRows& rows) const;
    void add_background(std::size_t mirror, const float* light, HopRows& rows) const;
    void add_around(std::size_t mirror, HopRows& rows) const;

    const HopTables& tables_;
    const RoughMirrors& rough_;
    std::vector<float> lobe_;                        // (hop, RoughMirrors::Row, lane)
    std::vector<float> background_, share_, whole_;  // (lane)
};

}  // namespace diurna
