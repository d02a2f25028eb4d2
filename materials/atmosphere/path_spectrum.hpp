#pragma once

#include <vector>

namespace diurna {

/// Transmittance and thermal radiance of a path at some wavelengths: nodes of a band, or middles of
/// bins.
struct PathSpectrum {
    std::vector<double> transmittance;  // 0 to 1
    std::vector<double> radiance;       // [W m⁻² sr⁻¹ µm⁻¹]
};

}  // namespace diurna
