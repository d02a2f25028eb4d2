#include "terrain/ground/footprint.hpp"

#include <fmt/format.h>

#include <string>

#include "materials/base/error.hpp"

namespace diurna {

Ring ring_on(const Dem& dem, const Footprint& footprint, std::size_t number) {
    const auto refuse = [&](const std::string& problem) {
        return InputError(fmt::format("footprint {}", number + 1), problem);
    };
    if (footprint.ring.size() < 3) {
        throw refuse(fmt::format("found {} corners, expected at least 3", footprint.ring.size()));
    }
    for (const auto& p : footprint.ring) {
        if (!p.allFinite()) throw refuse("a corner is not a finite number");
    }
    constexpr double least_edge = 0.01;  // [m]
    if (!(footprint.largest_edge >= least_edge)) {
        throw refuse(fmt::format("found a largest edge of {} m, expected at least {} m",
                                 footprint.largest_edge, least_edge));
    }
    Ring ring = clipped(footprint.ring, dem.columns, dem.rows);
    if (ring.size() < 3) throw refuse("is entirely outside the elevation data");
    return ring;
}

}  // namespace diurna
