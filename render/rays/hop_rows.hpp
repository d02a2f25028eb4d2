#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/light/radiance_terms.hpp"
#include "render/rays/hop_tables.hpp"

namespace diurna {

/// What is known of the hops of one pixel while their light is summed, in rows of lanes
/// (hop_tables.hpp). Its memory is kept from pixel to pixel.
struct HopRows {
    HopRows(const HopTables& tables, bool terms_apart)
        : lanes(tables.lanes.size()), by_term(terms_apart) {}

    std::size_t lanes;
    bool by_term;                         // a sum for each term, or one for all
    std::span<const Hop> list;            // of the pixel
    std::size_t first = 0;                // hop of the list among all
    std::vector<float> passed, radiance;  // (hop, lane) past the hops before; of the air up to it
    std::vector<float> transmittance;     // (hop, origin, lane) of that air
    std::vector<Term> as;                 // (hop) what its light counts as; path: as what it is
    std::vector<double> sum;              // (term, lane) what has been found

    /// Begins the k-th pixel of the hops.
    void begin(const HopTables& tables, std::size_t k) {
        list = tables.hops.of(k);
        first = tables.hops.row[k];
        passed.resize(list.size() * lanes);
        transmittance.resize(list.size() * origin_count * lanes);
        radiance.resize(list.size() * lanes);
        as.assign(list.size(), Term::path);
        sum.assign((by_term ? term_count : 1) * lanes, 0.0);
    }

    static bool starts(const Hop& hop) { return hop.before < 0; }
    static std::size_t before(const Hop& hop) { return static_cast<std::size_t>(hop.before); }
    float* passed_to(std::size_t i) { return &passed[i * lanes]; }
    const float* transmittance_to(std::size_t i, Origin origin) const {
        return &transmittance[(i * origin_count + static_cast<std::size_t>(origin)) * lanes];
    }
    /// Where light of a hop that is a term of its own is summed.
    double* row(std::size_t i, Term own) {
        const Term t = as[i] == Term::path ? own : as[i];
        return &sum[by_term ? static_cast<std::size_t>(t) * lanes : 0];
    }
};

}  // namespace diurna
