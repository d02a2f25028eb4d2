#include "thermal/field_difference.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace diurna {

FieldDifference difference_of(const TemperatureField& a, const TemperatureField& b) {
    FieldDifference found;
    for (std::size_t i = 0; i < a.kelvin.size(); ++i) {
        const double apart = std::abs(double{a.kelvin[i]} - double{b.kelvin[i]});
        found.rms += apart * apart;
        found.worst = std::max(found.worst, apart);
    }
    found.rms = std::sqrt(found.rms / std::max(1.0, double(a.kelvin.size())));
    return found;
}

}  // namespace diurna
