#include "render/eye/pixel_sum.hpp"

#include <algorithm>
#include <array>
#include <cassert>

#include "materials/base/parallel.hpp"

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
    assert(eye.size() == view.surface.size() * planes.size());
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

}  // namespace diurna
