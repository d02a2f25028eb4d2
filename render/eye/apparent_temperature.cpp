#include "render/eye/apparent_temperature.hpp"

#include <algorithm>
#include <bit>
#include <limits>

#include "materials/base/parallel.hpp"
#include "materials/radiation/planck.hpp"
#include "render/light/band_inverse.hpp"
#include "render/light/hermite.hpp"

namespace diurna {

TemperatureScale::TemperatureScale(const Band& band, float low, float high) : band_(band) {
    if (!(low > 0.0f && high >= low)) return;
    // 64 cells an octave, or fewer where the radiances span many.
    const auto from = std::bit_cast<std::uint32_t>(low), to = std::bit_cast<std::uint32_t>(high);
    shift_ = BandInverse::shift;
    while ((to >> shift_) - (from >> shift_) > 512) ++shift_;
    first_ = from >> shift_;
    const std::size_t cells = (to >> shift_) - first_ + 1;
    std::vector<double> value(cells + 1), slope(cells + 1), radiance(cells + 1);
    const BandInverse& inverse = band_inverse(band_);
    for_each_index(
        cells + 1,
        [&](std::size_t k) {
            const std::uint32_t place = first_ + static_cast<std::uint32_t>(k);
            radiance[k] = std::bit_cast<float>(place << shift_);
            if (shift_ == BandInverse::shift) {
                const BandInverse::Value known = inverse.at(place);
                value[k] = known.temperature;
                slope[k] = 1.0 / known.radiance_per_kelvin;
                return;
            }
            value[k] = brightness_temperature(band_, radiance[k]);
            slope[k] = 1.0 / band_radiance_derivative(band_, value[k]);
        },
        4);
    cubic_.resize(cells);
    for (std::size_t k = 0; k < cells; ++k) {
        const double width = radiance[k + 1] - radiance[k];
        cubic_[k] = hermite_cubic(value[k], slope[k] * width, value[k + 1], slope[k + 1] * width);
    }
}

double TemperatureScale::operator()(double radiance) const {
    if (!(radiance > 0.0)) return 0.0;
    const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(radiance));
    const std::uint32_t cell = (bits >> shift_) - first_;
    if (cell >= cubic_.size()) return brightness_temperature(band_, radiance);
    const auto at = [&](std::uint32_t k) {
        return double{std::bit_cast<float>((first_ + k) << shift_)};
    };
    const double from = at(cell), t = (radiance - from) / (at(cell + 1) - from);
    const auto& [a, b, c, d] = cubic_[cell];
    return a + t * (b + t * (c + t * d));
}

std::vector<float> apparent_temperature(const Band& band, const std::vector<float>& radiance) {
    constexpr std::size_t grain = 16384;
    std::vector<std::array<float, 2>> ends((radiance.size() + grain - 1) / grain);
    for_each_block(radiance.size(), grain, [&](std::size_t begin, std::size_t end) {
        float low = std::numeric_limits<float>::max(), high = 0.0f;
        for (std::size_t p = begin; p < end; ++p) {
            const float value = radiance[p];
            low = value > 0.0f && value < low ? value : low;
            high = value > high ? value : high;
        }
        ends[begin / grain] = {low, high};
    });
    float least = std::numeric_limits<float>::max(), most = 0.0f;
    for (const auto& [low, high] : ends) {
        least = std::min(least, low);
        most = std::max(most, high);
    }
    const TemperatureScale scale(band, std::min(least, most), most);
    std::vector<float> temperature(radiance.size());
    for_each_index(
        radiance.size(),
        [&](std::size_t p) { temperature[p] = static_cast<float>(scale(double{radiance[p]})); },
        grain);
    return temperature;
}

}  // namespace diurna
