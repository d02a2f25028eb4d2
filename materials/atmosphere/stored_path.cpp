#include "materials/atmosphere/stored_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

StoredPath stored(const PathSpectrum& path, BinRange bins, double fallback) {
    StoredPath kept;
    for (std::size_t b = 0; b < bins.size(); ++b) {
        const double tau = std::clamp(path.transmittance[b], 0.0, 1.0);
        kept.depth.push_back(-std::log(std::max(tau, 1e-30)));
        double temperature = fallback;
        if (1.0 - tau > 1e-10 && path.radiance[b] > 0.0) {
            temperature = planck_temperature(bin_middles_um()[bins.first + b],
                                             path.radiance[b] / (1.0 - tau));
        }
        kept.temperature.push_back(temperature);
    }
    return kept;
}

PathSpectrum restored(const StoredPath& path, BinRange bins, std::span<const double> node_um) {
    PathSpectrum spectrum;
    for (const double um : node_um) {
        const std::size_t bin = bin_of(um);
        if (bin < bins.first || bin >= bins.last) {
            throw InputError("atmosphere table",
                             fmt::format("{:g} um is outside its wavelengths", um));
        }
        const double depth = std::max(0.0, path.depth[bin - bins.first]);
        spectrum.transmittance.push_back(std::exp(-depth));
        spectrum.radiance.push_back(-std::expm1(-depth) *
                                    planck(um, path.temperature[bin - bins.first]));
    }
    return spectrum;
}

}  // namespace diurna
