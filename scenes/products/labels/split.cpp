#include "scenes/products/labels/split.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "materials/base/random.hpp"

namespace diurna {

std::vector<bool> validation_instants(std::size_t count, double share, std::uint64_t seed) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    constexpr std::uint64_t purpose = 0x5B117;  // apart from what else the seed draws
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return hashed(hashed(seed ^ purpose) + a) < hashed(hashed(seed ^ purpose) + b);
    });
    std::vector<bool> chosen(count, false);
    const auto wanted = static_cast<std::size_t>(std::lround(share * double(count)));
    for (std::size_t i = 0; i < std::min(wanted, count); ++i) chosen[order[i]] = true;
    return chosen;
}

}  // namespace diurna
