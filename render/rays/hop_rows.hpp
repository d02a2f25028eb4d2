#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/light/radiance_terms.hpp"
#include "render/rays/hop_tables.hpp"

namespace diurna {

/// How the light of a pixel's hops is summed: all in one, by what it counts as, or by what each
/// hop sends.
enum class SumOfHops { whole, by_term, by_hop };

/// What is known of the hops of one pixel while their light is summed, in rows of lanes
/// (hop_tables.hpp). Its memory is kept from pixel to pixel.
struct HopRows {
    HopRows(const HopTables& tables, SumOfHops how) : lanes(tables.lanes.size()), apart(how) {}

    /// Of a hop by itself: its terms, then what it mirrors at large (LobeLight).
    static constexpr std::size_t mirrored = term_count, rows_of_hop = term_count + 1;

    std::size_t lanes;
    SumOfHops apart;
    std::span<const Hop> list;            // of the pixel
    std::size_t first = 0;                // hop of the list among all
    std::vector<float> passed, radiance;  // (hop, lane) past the hops before; of the air up to it
    std::vector<float> transmittance;     // (hop, origin, lane) of that air
    std::vector<Term> as;                 // (hop) what its light counts as; path: as what it is
    std::vector<double> sum;   // (term, lane) what has been found; by hop (hop, row, lane)
    std::vector<double> sent;  // by hop: (hop, term, lane) as it leaves facet or plume

    /// Begins the k-th pixel of the hops.
    void begin(const HopTables& tables, std::size_t k) {
        list = tables.hops.of(k);
        first = tables.hops.row[k];
        passed.resize(list.size() * lanes);
        transmittance.resize(list.size() * origin_count * lanes);
        radiance.resize(list.size() * lanes);
        as.assign(list.size(), Term::path);
        const bool by_hop = apart == SumOfHops::by_hop;
        sum.assign((by_hop                        ? list.size() * rows_of_hop
                    : apart == SumOfHops::by_term ? term_count
                                                  : 1) *
                       lanes,
                   0.0);
        sent.assign(by_hop ? list.size() * term_count * lanes : 0, 0.0);
    }

    static bool starts(const Hop& hop) { return hop.before < 0; }
    static std::size_t before(const Hop& hop) { return static_cast<std::size_t>(hop.before); }
    float* passed_to(std::size_t i) { return &passed[i * lanes]; }
    const float* passed_to(std::size_t i) const { return &passed[i * lanes]; }
    const float* transmittance_to(std::size_t i, Origin origin) const {
        return &transmittance[(i * origin_count + static_cast<std::size_t>(origin)) * lanes];
    }
    /// Where light of a hop that is a term of its own is summed.
    double* row(std::size_t i, Term own) {
        if (apart == SumOfHops::by_hop) return row_of_hop(i, static_cast<std::size_t>(own));
        const Term t = as[i] == Term::path ? own : as[i];
        return &sum[apart == SumOfHops::by_term ? static_cast<std::size_t>(t) * lanes : 0];
    }
    /// The same of what a rough mirror shows at large.
    double* mirrored_row(std::size_t i, Term own) {
        return apart == SumOfHops::by_hop ? row_of_hop(i, mirrored) : row(i, own);
    }
    double* row_of_hop(std::size_t i, std::size_t row) {
        return &sum[(i * rows_of_hop + row) * lanes];
    }
    /// Where light of a hop is summed as it leaves it; null: it is not.
    double* leaving(std::size_t i, Term own) {
        if (apart != SumOfHops::by_hop) return nullptr;
        return &sent[(i * term_count + static_cast<std::size_t>(own)) * lanes];
    }
};

}  // namespace diurna
