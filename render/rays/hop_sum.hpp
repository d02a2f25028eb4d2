#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "render/rays/hop_rows.hpp"
#include "render/rays/hop_tables.hpp"
#include "render/rays/lobe_light.hpp"
#include "render/rays/rough_mirror.hpp"

namespace diurna {

/// Sums the light of one pixel of the hops after another (hop_light.hpp). For one thread.
class HopSum {
 public:
    HopSum(const HopTables& tables, const RoughMirrors& rough, SumOfHops apart);

    /// Finds what the hops of the k-th pixel send; see rows().
    void look(std::size_t k);
    /// Adds the k-th pixel of the hops to its place in the planes: (band, term) or (band).
    void add(std::size_t k, std::span<std::vector<float>> planes);
    const HopRows& rows() const { return rows_; }

 private:
    float height_km(const Hop& hop) const {
        return static_cast<float>(tables_.input.above_sea_km(double{hop.height}));
    }
    void add_hop(std::size_t i);
    bool is_in_lobe(const Hop& hop) const;
    void pass(std::size_t i);
    void add_scattered_path(std::size_t i, std::size_t b);
    void add_air(std::size_t i);
    void add_own(std::size_t i, const SentRow& own, const float* light);
    void add_plume(std::size_t i);
    void add_facet(std::size_t i);

    const HopTables& tables_;
    LobeLight lobes_;
    HopRows rows_;
    std::size_t lanes_, bands_;
    std::vector<float> scattered_;  // (hop, band)
    std::vector<float> filter_;     // (origin, lane)
    std::vector<float> own_;        // (sent row, lane)
};

}  // namespace diurna
