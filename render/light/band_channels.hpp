#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "materials/radiation/band.hpp"

namespace diurna {

/// Runs of a band's nodes that lie in one bin of the atmosphere, inside which its transmittance is
/// one number. What leaves a surface needs to be known per channel only; rows of channels are
/// padded with zeros to whole SIMD registers.
struct Channels {
    std::vector<std::uint32_t> first;  // (channel + 1) nodes of channel c: [first[c], first[c + 1])

    std::size_t size() const { return first.size() - 1; }
    std::size_t padded() const { return (size() + 7) / 8 * 8; }
};
Channels channels_of(const Band& band);

/// Σ weight · f · g per channel, padded.
std::vector<float> channel_sums(const Band& band, const Channels& channels,
                                std::span<const double> f, std::span<const double> g);

/// Temperatures a table is made for, in equal cells [K].
struct TemperatureGrid {
    double low = 200.0;
    double step = 2.0;
    std::size_t cells = 50;

    /// Cell of a temperature (the nearest one if it lies outside) and its place in it, 0 to 1.
    std::size_t cell(float temperature, float& place) const {
        const float u = (temperature - static_cast<float>(low)) * static_cast<float>(1.0 / step);
        const float c = u < 0.0f ? 0.0f : u < float(cells) ? u : float(cells) - 0.5f;
        place = u - static_cast<float>(static_cast<std::size_t>(c));
        return static_cast<std::size_t>(c);
    }
};
/// Cells of at most 2 K that hold [low, high].
TemperatureGrid temperature_grid(double low, double high);

/// The inverse of a band's radiance over a range of radiances: T by cubic Hermite with exact
/// derivatives over cells of equal ratio, found from the number's own bits. Within 0.05 mK of
/// brightness_temperature() where that is 150 K or more (tests/render/band_channels_test.cpp).
class TemperatureScale {
 public:
    /// For radiances [low, high]; others are inverted one by one.
    TemperatureScale(const Band& band, float low, float high);
    /// [K]; 0 for a radiance of zero or less.
    double operator()(double radiance) const;

 private:
    Band band_;
    int shift_ = 0;            // a cell: radiances alike but for so many last bits
    std::uint32_t first_ = 0;  // leading bits of the first cell
    std::vector<std::array<double, 4>> cubic_;
};

}  // namespace diurna
