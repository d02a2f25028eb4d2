#include "render/detection/ranges.hpp"

#include <cmath>

namespace diurna {

double farthest_range(const std::function<double(double)>& falling, double wanted, double from,
                      double to) {
    if (!(falling(from) >= wanted)) return 0.0;
    if (falling(to) >= wanted) return to;
    for (int i = 0; i < 60; ++i) {
        const double middle = std::sqrt(from * to);
        (falling(middle) >= wanted ? from : to) = middle;
    }
    return from;
}

}  // namespace diurna
