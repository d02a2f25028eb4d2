#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/light/radiance_terms.hpp"
#include "render/rays/secondary_tables.hpp"

namespace diurna {

/// How the light of a pixel's secondary rays is summed: in total, by term, or separately for each
/// secondary ray.
enum class SumOfSecondaryRays { whole, by_term, by_secondary };

/// Working data for the light of one pixel's secondary rays, in rows of lanes
/// (secondary_tables.hpp). Memory is reused from pixel to pixel.
struct SecondaryRows {
    SecondaryRows(const SecondaryTables& tables, SumOfSecondaryRays how)
        : lanes(tables.lanes.size()), apart(how) {}

    /// Of a single secondary ray: its terms, then its lobe integral (LobeLight).
    static constexpr std::size_t mirrored = term_count, rows_of_secondary = term_count + 1;

    std::size_t lanes;
    SumOfSecondaryRays apart;
    std::span<const SecondaryRay> list;  // of the pixel
    std::size_t first = 0;               // index among all of the list's first secondary ray
    std::vector<float> passed,
        radiance;  // (secondary ray, lane) attenuated by earlier ones; of the air up to it
    std::vector<float> transmittance;  // (secondary ray, origin, lane) of that air
    std::vector<Term> as;              // (secondary ray) term of its light; path: its own terms
    std::vector<double> sum;  // (term, lane) result; by secondary ray (secondary ray, row, lane)
    std::vector<double>
        sent;  // by secondary ray: (secondary ray, term, lane) leaving facet or plume

    /// Begins the k-th pixel of the secondary rays.
    void begin(const SecondaryTables& tables, std::size_t k) {
        list = tables.secondary_rays.of(k);
        first = tables.secondary_rays.row[k];
        passed.resize(list.size() * lanes);
        transmittance.resize(list.size() * origin_count * lanes);
        radiance.resize(list.size() * lanes);
        as.assign(list.size(), Term::path);
        const bool by_secondary = apart == SumOfSecondaryRays::by_secondary;
        sum.assign((by_secondary                           ? list.size() * rows_of_secondary
                    : apart == SumOfSecondaryRays::by_term ? term_count
                                                           : 1) *
                       lanes,
                   0.0);
        sent.assign(by_secondary ? list.size() * term_count * lanes : 0, 0.0);
    }

    static bool starts(const SecondaryRay& secondary) { return secondary.before < 0; }
    static std::size_t before(const SecondaryRay& secondary) {
        return static_cast<std::size_t>(secondary.before);
    }
    float* passed_to(std::size_t i) { return &passed[i * lanes]; }
    const float* passed_to(std::size_t i) const { return &passed[i * lanes]; }
    const float* transmittance_to(std::size_t i, Origin origin) const {
        return &transmittance[(i * origin_count + static_cast<std::size_t>(origin)) * lanes];
    }
    /// Destination for a secondary ray's light of a term.
    double* row(std::size_t i, Term own) {
        if (apart == SumOfSecondaryRays::by_secondary)
            return row_of_secondary(i, static_cast<std::size_t>(own));
        const Term t = as[i] == Term::path ? own : as[i];
        return &sum[apart == SumOfSecondaryRays::by_term ? static_cast<std::size_t>(t) * lanes : 0];
    }
    /// The same for a rough mirror's lobe integral.
    double* mirrored_row(std::size_t i, Term own) {
        return apart == SumOfSecondaryRays::by_secondary ? row_of_secondary(i, mirrored)
                                                         : row(i, own);
    }
    double* row_of_secondary(std::size_t i, std::size_t row) {
        return &sum[(i * rows_of_secondary + row) * lanes];
    }
    /// Destination for a secondary ray's light as it leaves it; null: not needed.
    double* leaving(std::size_t i, Term own) {
        if (apart != SumOfSecondaryRays::by_secondary) return nullptr;
        return &sent[(i * term_count + static_cast<std::size_t>(own)) * lanes];
    }
};

}  // namespace diurna
