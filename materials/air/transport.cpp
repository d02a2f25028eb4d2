#include "materials/air/transport.hpp"

#include <cmath>

namespace diurna {

double air_viscosity(double t) { return 1.458e-6 * t * std::sqrt(t) / (t + 110.4); }

double air_conductivity(double t) {
    return 2.64638e-3 * t * std::sqrt(t) / (t + 245.4 * std::pow(10.0, -12.0 / t));
}

}  // namespace diurna
