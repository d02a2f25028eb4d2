#pragma once

#include <string>
#include <vector>

#include "scenes/charts/facet_groups.hpp"
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
    double tenth = 0.0;        // [K] at the warmest instant 10 % of the area is colder
    double ninetieth = 0.0;    // [K] and 10 % warmer
    std::size_t coldest() const;
    std::size_t warmest() const;  // the first instant with the maximum mean
};

/// One curve for each group with at least one facet.
std::vector<DiurnalCurve> diurnal_curves(const TemperatureField& field, const FacetSet& facets,
                                         const std::vector<FacetGroup>& groups);

/// Area-weighted mean over a group of (facet) values at one instant. Its facets are summed in
/// order: bitwise reproducible.
double area_mean(const FacetGroup& group, const std::vector<float>& area,
                 std::span<const float> value);

/// Instants at which the mean of `a` crosses that of `b`, linear between stored instants: zero
/// contrast (thermal crossover).
std::vector<Instant> crossovers(const std::vector<Instant>& instants, const DiurnalCurve& a,
                                const DiurnalCurve& b);

}  // namespace diurna
