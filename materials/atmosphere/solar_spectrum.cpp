#include "materials/atmosphere/solar_spectrum.hpp"

#include "materials/atmosphere/band_model_tables.hpp"
#include "materials/base/interval.hpp"

namespace diurna {

double solar_above_air(double wavelength_um) {
    const BandModelTables& tables = band_model_tables();
    return tables.solar_W_m2_um[interval_of(tables.solar_edge_um, wavelength_um)];
}

}  // namespace diurna
