#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "materials/radiation/band.hpp"

namespace diurna {

/// The inverse of a band's radiance over a range of radiances: T by cubic Hermite with exact
/// derivatives over cells of equal ratio, located by the number's bits. Within 0.05 mK of
/// brightness_temperature() where that is 150 K or more
/// (tests/render/apparent_temperature_test.cpp).
class TemperatureScale {
 public:
    /// For radiances [low, high]; others are inverted one by one.
    TemperatureScale(const Band& band, float low, float high);
    /// [K]; 0 for a radiance of zero or less.
    double operator()(double radiance) const;

 private:
    Band band_;
    int shift_ = 0;            // a cell: radiances that differ only in this many last bits
    std::uint32_t first_ = 0;  // leading bits of the first cell
    std::vector<std::array<double, 4>> cubic_;
};

/// Temperature [K] of the black body of each radiance.
std::vector<float> apparent_temperature(const Band& band, const std::vector<float>& radiance);

}  // namespace diurna
