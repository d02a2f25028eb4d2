#pragma once

#include <cstddef>
#include <vector>

#include "render/rays/rough_mirror.hpp"
#include "render/rays/secondary_rows.hpp"
#include "render/rays/secondary_tables.hpp"

namespace diurna {

/// Adds the lobe integrals of rough mirrors (rough_mirror.hpp) to the light of a pixel's secondary
/// rays, and subtracts the part already included from the hits of their reflected rays.
class LobeLight {
 public:
    LobeLight(const SecondaryTables& tables, const RoughMirrors& rough);

    bool has(const SecondaryRay& secondary) const { return rough_.has(secondary); }
    void begin(const SecondaryRows& rows);
    /// Lobe integral of a rough mirror: background and mean of the surrounding facets.
    void add(std::size_t mirror, SecondaryRows& rows);
    /// Subtracts the lobe integral's value from a hit of a ray reflected by a rough mirror.
    void take_expected(std::size_t i, SecondaryRows& rows);
    /// Share of the light reflected by a rough mirror that belongs to the ray to a secondary ray,
    /// (lane): with the attenuation by earlier secondary rays.
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
