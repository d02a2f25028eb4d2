#pragma once

#include <algorithm>
#include <functional>
#include <span>
#include <vector>

#include "materials/radiation/band.hpp"
#include "materials/radiation/planck.hpp"
#include "render/light/origin.hpp"

namespace diurna {

// Spectra given at the nodes of a band.

/// B(T) [W m⁻² sr⁻¹ µm⁻¹].
inline std::vector<double> black_body(const Band& band, double temperature) {
    std::vector<double> b(band.node_um.size());
    for (std::size_t n = 0; n < b.size(); ++n) b[n] = planck(band.node_um[n], temperature);
    return b;
}

/// Their product, node by node.
inline std::vector<double> times(std::span<const double> a, std::span<const double> b) {
    std::vector<double> out(a.size());
    std::transform(a.begin(), a.end(), b.begin(), out.begin(), std::multiplies<>());
    return out;
}
inline LightByOrigin times(std::span<const double> a, const LightByOrigin& light) {
    LightByOrigin out;
    for (std::size_t origin = 0; origin < origin_count; ++origin) {
        if (!light[origin].empty()) out[origin] = times(a, light[origin]);
    }
    return out;
}

}  // namespace diurna
