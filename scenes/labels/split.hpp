#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace diurna {

/// Which of `count` instants are for validation: the nearest whole number to `share` of them, drawn
/// by `seed`. All pictures of an instant are on one side, so that nothing seen in training comes
/// back at the same hour in another band.
std::vector<bool> validation_instants(std::size_t count, double share, std::uint64_t seed);

}  // namespace diurna
