#pragma once

#include <cstddef>
#include <vector>

#include "render/rays/rough_mirror.hpp"
#include "render/rays/secondary_rows.hpp"
#include "render/rays/secondary_tables.hpp"

namespace diurna {

/// Adds what rough mirrors show at large (rough_mirror.hpp) to the light of a pixel's secondary
/// rays, and takes from what rays off them meet what is shown of it already.
class LobeLight {
 public:
    LobeLight(const SecondaryTables& tables, const RoughMirrors& rough);

    bool has(const SecondaryRay& secondary) const { return rough_.has(secondary); }
    void begin(const SecondaryRows& rows);
    /// What a rough mirror shows of the background and, by their mean, of the facets around.
    void add(std::size_t mirror, SecondaryRows& rows);
    /// Takes away what the sum over the lobe has for what a ray off a rough mirror meets.
    void take_expected(std::size_t i, SecondaryRows& rows);
    /// Of the light that a rough mirror sends on, the share of the ray to a secondary ray, (lane):
    /// past the secondary rays before.
    void pass(std::size_t i, SecondaryRows& rows) const;

 private:
    const float* row(std::size_t i, RoughMirrors::Row row) const {
        return &lobe_[(i * RoughMirrors::row_count + row) * tables_.lanes.size()];
    }
    float open_above(std::size_t mirror, const SecondaryRows& rows) const;
    void add_background(std::size_t mirror, const float* light, SecondaryRows& rows) const;
    void add_around(std::size_t mirror, SecondaryRows& rows) const;

    const SecondaryTables& tables_;
    const RoughMirrors& rough_;
    std::vector<float> lobe_;                        // (secondary ray, RoughMirrors::Row, lane)
    std::vector<float> background_, share_, whole_;  // (lane)
};

}  // namespace diurna
