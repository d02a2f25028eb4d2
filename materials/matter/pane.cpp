#include "materials/matter/pane.hpp"

#include <algorithm>
#include <cmath>

namespace diurna {

PaneOptics pane_optics(double cosine, std::complex<double> index, double inside) {
    const double c = std::clamp(cosine, 0.0, 1.0);
    const std::complex<double> below = std::sqrt(index * index - (1.0 - c * c));
    const std::complex<double> square = index * index;
    const double way = 1.0 / std::max(1e-6, (below / index).real());
    const double left = inside > 0.0 ? std::pow(inside, way) : 0.0;
    PaneOptics mean{0.0, 0.0};
    for (const std::complex<double> amplitude :
         {(c - below) / (c + below), (square * c - below) / (square * c + below)}) {
        const double face = std::norm(amplitude), entering = 1.0 - face;
        const double again = 1.0 - face * face * left * left;
        const double through = again > 1e-12 ? entering * entering * left / again : 0.0;
        mean.transmittance += 0.5 * through;
        mean.reflectance += 0.5 * (face + face * left * through);
    }
    return mean;
}

double inside_of_pane(double transmittance, std::complex<double> index) {
    if (!(transmittance > 0.0)) return 0.0;
    const double face = std::norm((1.0 - index) / (1.0 + index)), entering = 1.0 - face;
    // T F² a² + (1 − F)² a − T = 0.
    const double half = 0.5 * entering * entering, square = transmittance * face * face;
    return std::min(1.0, transmittance / (half + std::sqrt(half * half + square * transmittance)));
}

}  // namespace diurna
