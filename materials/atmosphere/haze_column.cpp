#include "materials/atmosphere/haze_column.hpp"

#include <array>

#include "materials/atmosphere/bins.hpp"
#include "materials/atmosphere/medium.hpp"

namespace diurna {

double aerosol_depth(const BandModel& model, double wavelength_um) {
    if (model.aerosol == "none") return 0.0;
    BandModel dry = model;
    dry.rain_mm_h = 0.0;
    const Medium medium(dry, bins_of(std::array{wavelength_um}));
    const SightLine up = sight_line(dry.ground_km, 0.0);
    Amounts met = medium.none();
    for (std::size_t i = 0; i < up.size(); ++i) medium.add(up, i, met);
    medium.spread(met);
    return met.aerosol.empty() ? 0.0 : met.aerosol.front();
}

}  // namespace diurna
