#include "render/eye/pixel_sum.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

#include "materials/base/parallel.hpp"
#include "render/light/band_channels.hpp"

namespace diurna {

namespace {

/// `Columns` columns from the one numbered `first`.
template <std::size_t Columns>
void sum_columns(const View& view, std::span<const AtEye> eye, std::size_t first,
                 std::span<const BackgroundTable* const> background, double azimuth_deg,
                 std::span<std::vector<float>> planes) {
    const std::size_t stride = planes.size();
    for_each_block(view.pixels(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            std::array<float, Columns> sum{};
            for (std::uint32_t k = view.row[p]; k < view.row[p + 1]; ++k) {
                const Sighting& s = view.sighting[k];
                const AtEye* at = &eye[s.target * stride + first];
                for (std::size_t c = 0; c < Columns; ++c) {
                    sum[c] += s.weight * (at[c].value + s.deeper * at[c].by_range +
                                          s.higher * at[c].by_height);
                }
            }
            for (std::size_t c = 0; c < Columns; ++c) {
                if (view.sky[p] > 0.0f && background[first + c] != nullptr) {
                    const double azimuth = azimuth_deg + double{view.sky_azimuth_deg[p]};
                    sum[c] += view.sky[p] * static_cast<float>((*background[first + c])(
                                                view.sky_zenith_deg[p], azimuth));
                }
                planes[first + c][p] = sum[c];
            }
        }
    });
}

}  // namespace

void sum_pixels(const View& view, std::span<const AtEye> eye,
                std::span<const BackgroundTable* const> background, double azimuth_deg,
                std::span<std::vector<float>> planes) {
    assert(eye.size() == view.facet.size() * planes.size());
    std::size_t first = 0;
    for (; first + 6 <= planes.size(); first += 6) {
        sum_columns<6>(view, eye, first, background, azimuth_deg, planes);
    }
    for (; first + 2 <= planes.size(); first += 2) {
        sum_columns<2>(view, eye, first, background, azimuth_deg, planes);
    }
    if (first < planes.size()) {
        sum_columns<1>(view, eye, first, background, azimuth_deg, planes);
    }
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
