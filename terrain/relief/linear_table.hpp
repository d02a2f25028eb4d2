#pragma once

#include <array>
#include <cstddef>

namespace diurna {

/// A function over [0, cells] from its values at integers, linear between them.
template <int cells>
class LinearTable {
 public:
    template <class Function>
    explicit LinearTable(const Function& value_at) {
        for (int i = 0; i <= cells; ++i) {
            value_[std::size_t(i)] = static_cast<float>(value_at(i));
        }
        value_[cells + 1] = value_[cells];  // so that x = cells needs no branch
    }
    float operator()(float x) const {
        const auto i = static_cast<std::size_t>(x);
        return value_[i] + (x - static_cast<float>(i)) * (value_[i + 1] - value_[i]);
    }

 private:
    std::array<float, cells + 2> value_{};
};

}  // namespace diurna
