#include "materials/matter/net_optics.hpp"

#include <algorithm>

namespace diurna {

void open_up(double cover, Material& strips) {
    if (strips.transmittance.empty()) {
        strips.transmittance = flat_spectrum(1.0 - cover);
    } else {
        for (double& value : strips.transmittance.value) value = 1.0 - cover + cover * value;
    }
    for (double& value : strips.reflectance.value) value *= cover;
    strips.cover = cover;
}

void take_strips(Material& net) {
    const double cover = net.cover;
    net.cover = 1.0;
    if (cover == 1.0 || cover == 0.0) return;
    constexpr double rounding = 1e-12;
    double most = 0.0;
    for (double& value : net.transmittance.value) {
        value = std::max(0.0, (value - (1.0 - cover)) / cover);
        most = std::max(most, value);
    }
    if (most < rounding) net.transmittance = {};
    for (double& value : net.reflectance.value) value /= cover;
}

}  // namespace diurna
