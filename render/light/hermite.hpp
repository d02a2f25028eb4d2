#pragma once

#include <array>

namespace diurna {

/// Coefficients, by rising power, of the cubic through values and slopes at 0 and 1; of numbers or
/// of whole arrays of them.
template <class Value>
std::array<Value, 4> hermite_cubic(const Value& v0, const Value& s0, const Value& v1,
                                   const Value& s1) {
    return {v0, s0, 3.0 * (v1 - v0) - 2.0 * s0 - s1, 2.0 * (v0 - v1) + s0 + s1};
}

}  // namespace diurna
