#include "thermal/heat_flux_field.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace diurna {

void HeatFluxField::add_between(const HeatFluxField& other, Instant when) {
    assert(!other.empty());
    const auto after = std::upper_bound(other.instant.begin(), other.instant.end(), when);
    const auto last = static_cast<std::size_t>(after - other.instant.begin());
    const std::size_t a = last == 0 ? 0 : last - 1, b = std::min(last, other.instant.size() - 1);
    const double apart = seconds_between(other.instant[a], other.instant[b]);
    const double share = apart > 0.0 ? seconds_between(other.instant[a], when) / apart : 0.0;
    instant.push_back(when);
    facets = other.facets;
    for (std::size_t k = 0; k < heat_terms; ++k) {
        const float* const from = other.watts[k].data() + a * facets;
        const float* const to = other.watts[k].data() + b * facets;
        for (std::size_t f = 0; f < facets; ++f) {
            watts[k].push_back(float(std::lerp(double(from[f]), double(to[f]), share)));
        }
    }
}

}  // namespace diurna
