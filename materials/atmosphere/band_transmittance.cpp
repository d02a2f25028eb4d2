#include "materials/atmosphere/band_transmittance.hpp"

#include "materials/atmosphere/medium.hpp"

namespace diurna {

std::vector<double> transmittance(const BandModel& model, const SightLine& line, BinRange bins) {
    const Medium medium(model, bins);
    Amounts amounts = medium.none();
    for (std::size_t i = 0; i < line.size(); ++i) medium.add(line, i, amounts);
    medium.spread(amounts);
    std::vector<double> result(bins.size(), 1.0);
    if (line.size() > 0) medium.transmittances(amounts, result);
    return result;
}

}  // namespace diurna
