#pragma once

#include <string>
#include <vector>

#include "scenes/report/facet_groups.hpp"
#include "terrain/facets.hpp"
#include "terrain/place/instant.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// Surface temperature of a group of facets through the day, over all of them by area.
struct DiurnalCurve {
    std::string name;
    std::size_t facets = 0;
    double area = 0.0;         // [m²]
    std::vector<double> mean;  // (instant) [K]
    double tenth = 0.0;        // [K] at the warmest instant a tenth of the area is colder,
    double ninetieth = 0.0;    // [K] and a tenth warmer
    std::size_t coldest() const;
    std::size_t warmest() const;  // the first instant of the greatest mean
};

/// One curve for each group, of one facet at least.
std::vector<DiurnalCurve> diurnal_curves(const TemperatureField& field, const FacetSet& facets,
                                         const std::vector<FacetGroup>& groups);

/// Mean over the areas of a group of what (facet) has, one instant. Its facets one after the other:
/// the same to the bit whatever else is done.
double area_mean(const FacetGroup& group, const std::vector<float>& area,
                 std::span<const float> value);

/// Instants at which the mean of `a` crosses that of `b`, linear between kept instants: where the
/// contrast of the two vanishes (thermal crossover).
std::vector<Instant> crossovers(const std::vector<Instant>& instants, const DiurnalCurve& a,
                                const DiurnalCurve& b);

}  // namespace diurna
