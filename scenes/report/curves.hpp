#pragma once

#include <string>
#include <vector>

#include "materials/matter/library.hpp"
#include "terrain/facets.hpp"
#include "terrain/place/instant.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// Surface temperature of one material through the day, over all its facets by area.
struct DiurnalCurve {
    std::string material;
    std::size_t facets = 0;
    double area = 0.0;              // [m²]
    std::vector<double> mean;       // (instant) [K]
    std::vector<double> tenth;      // (instant) [K] a tenth of the area is colder
    std::vector<double> ninetieth;  // (instant) [K] a tenth of the area is warmer
};

/// One curve for each material that has facets, by name; the levels of its textures count with it.
std::vector<DiurnalCurve> diurnal_curves(const TemperatureField& field, const FacetSet& facets,
                                         const MaterialLibrary& materials);

/// Instants at which the mean of `a` crosses that of `b`, linear between kept instants: where the
/// contrast of the two vanishes (thermal crossover).
std::vector<Instant> crossovers(const std::vector<Instant>& instants, const DiurnalCurve& a,
                                const DiurnalCurve& b);

}  // namespace diurna
