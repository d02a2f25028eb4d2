#include "thermal/solve/block_profile.hpp"

#include <algorithm>
#include <cmath>

namespace diurna {

double DepthProfile::at(double metres) const {
    const auto next = std::upper_bound(depth.begin(), depth.end(), metres);
    if (next == depth.begin()) return kelvin.front();
    if (next == depth.end()) return kelvin.back();
    const auto i = static_cast<std::size_t>(next - depth.begin());
    const double share = (metres - depth[i - 1]) / (depth[i] - depth[i - 1]);
    return std::lerp(kelvin[i - 1], kelvin[i], share);
}

DepthProfile profile_at_start(const Kind& kind, const Block& block, std::size_t lane) {
    const std::size_t states = block.start.size() / block.stride;
    const auto state = [&](std::size_t m) { return block.start[m * block.stride + lane]; };
    if (!kind.modes) {
        DepthProfile profile{kind.column.grid.depth, {}};
        for (std::size_t i = 0; i < states; ++i) {
            profile.kelvin.push_back(kind.column.reference + state(i));
        }
        return profile;
    }
    const ReducedColumn& column = kind.modes->reduced;
    DepthProfile profile{column.depth, {}};
    for (Eigen::Index i = 0; i < column.profile.rows(); ++i) {
        double theta = column.excess[i];
        for (std::size_t m = 0; m < states; ++m) {
            theta += column.profile(i, Eigen::Index(m)) * state(m);
        }
        profile.kelvin.push_back(column.reference + theta);
    }
    return profile;
}

}  // namespace diurna
