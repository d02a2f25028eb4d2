#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace diurna {

/// Which of `count` instants are for validation: the nearest integer to `share` of them, drawn with
/// `seed`. All pictures of an instant are on one side, so that no training scene appears in
/// validation in another band.
std::vector<bool> validation_instants(std::size_t count, double share, std::uint64_t seed);

}  // namespace diurna
