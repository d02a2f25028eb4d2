#include "render/view/add_view.hpp"

#include <algorithm>
#include <array>
#include <cassert>

namespace diurna {

namespace {

void add_sky(View& view, const View& more, std::size_t pixel, float share) {
    const float old_sky = (1.0f - share) * view.sky[pixel], sky = share * more.sky[pixel];
    view.sky[pixel] = old_sky + sky;
    if (sky == 0.0f) return;
    if (old_sky == 0.0f) view.sky_azimuth_deg[pixel] = more.sky_azimuth_deg[pixel];
    view.sky_zenith_deg[pixel] =
        (old_sky * view.sky_zenith_deg[pixel] + sky * more.sky_zenith_deg[pixel]) / (old_sky + sky);
}

/// Weights are shared pixel by pixel; targets of `more` are counted from `first` on.
void add_sightings(View& view, const View& more, std::span<const float> share,
                   std::uint32_t first) {
    std::vector<Sighting> sighting;
    sighting.reserve(view.sighting.size() + more.sighting.size());
    std::vector<std::uint32_t> row{0};
    row.reserve(view.row.size());
    for (std::size_t p = 0; p < view.pixels(); ++p) {
        for (std::uint32_t k = view.row[p]; k < view.row[p + 1]; ++k) {
            Sighting& s = sighting.emplace_back(view.sighting[k]);
            s.weight *= 1.0f - share[p];
        }
        if (share[p] > 0.0f) {
            for (std::uint32_t k = more.row[p]; k < more.row[p + 1]; ++k) {
                Sighting& s = sighting.emplace_back(more.sighting[k]);
                s.weight *= share[p];
                s.target += first;
            }
            add_sky(view, more, p, share[p]);
        }
        row.push_back(static_cast<std::uint32_t>(sighting.size()));
    }
    view.sighting = std::move(sighting);
    view.row = std::move(row);
}

/// - any_targets: in `extent`
void widen(ViewExtent& extent, const ViewExtent& other, bool any_targets, bool other_has_targets) {
    if (other_has_targets) {
        extent.near = any_targets ? std::min(extent.near, other.near) : other.near;
        extent.far = any_targets ? std::max(extent.far, other.far) : other.far;
        extent.low = any_targets ? std::min(extent.low, other.low) : other.low;
        extent.high = any_targets ? std::max(extent.high, other.high) : other.high;
    }
    if (other.sky_pixels == 0) return;
    const auto join = [&](std::array<float, 2>& range, const std::array<float, 2>& with) {
        range = extent.sky_pixels == 0 ? with
                                       : std::array<float, 2>{std::min(range[0], with[0]),
                                                              std::max(range[1], with[1])};
    };
    join(extent.sky_zenith_deg, other.sky_zenith_deg);
    join(extent.sky_azimuth_deg, other.sky_azimuth_deg);
}

}  // namespace

void add_view(View& view, const View& more, std::span<const float> share) {
    assert(view.pixels() == more.pixels() && view.pixels() == share.size());
    const auto first = static_cast<std::uint32_t>(view.surface.size());
    add_sightings(view, more, share, first);
    const auto append = [](auto& to, const auto& from) {
        to.insert(to.end(), from.begin(), from.end());
    };
    append(view.surface, more.surface);
    append(view.copy, more.copy);
    append(view.range, more.range);
    append(view.range_root, more.range_root);
    append(view.target_height, more.target_height);
    view.rays += more.rays;
    widen(view.extent, more.extent, first > 0, !more.surface.empty());
    view.extent.sky_pixels = static_cast<std::size_t>(
        std::count_if(view.sky.begin(), view.sky.end(), [](float sky) { return sky > 0.0f; }));
}

}  // namespace diurna
