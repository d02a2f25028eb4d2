#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/rays/lobe_light.hpp"
#include "render/rays/rough_mirror.hpp"
#include "render/rays/secondary_rows.hpp"
#include "render/rays/secondary_tables.hpp"

namespace diurna {

/// Sums the light of the secondary rays' pixels one after another (secondary_light.hpp). For one
/// thread.
class SecondarySum {
 public:
    SecondarySum(const SecondaryTables& tables, const RoughMirrors& rough,
                 SumOfSecondaryRays apart);

    /// Computes the light of the secondary rays of the k-th pixel; see rows().
    void look(std::size_t k);
    /// Adds the k-th pixel of the secondary rays to its position in the planes: (band, term) or
    /// (band).
    void add(std::size_t k, std::span<std::vector<float>> planes);
    const SecondaryRows& rows() const { return rows_; }

 private:
    float height_km(const SecondaryRay& secondary) const {
        return static_cast<float>(tables_.input.above_sea_km(double{secondary.height}));
    }
    void add_secondary(std::size_t i);
    bool is_in_lobe(const SecondaryRay& secondary) const;
    void pass(std::size_t i);
    void add_scattered_path(std::size_t i, std::size_t b);
    void add_air(std::size_t i);
    void add_own(std::size_t i, const SentRow& own, const float* light);
    void add_plume(std::size_t i);
    void add_facet(std::size_t i);

    const SecondaryTables& tables_;
    LobeLight lobes_;
    SecondaryRows rows_;
    std::size_t lanes_, bands_;
    std::vector<float> scattered_;  // (secondary ray, band)
    std::vector<float> filter_;     // (origin, lane)
    std::vector<float> own_;        // (sent row, lane)
};

}  // namespace diurna
