#include "render/eye/pixel_sun_sum.hpp"

#include <algorithm>

#include "materials/base/parallel.hpp"

namespace diurna {

namespace {

float light_at_sighting(const AtEye& at, const Sighting& s) {
    return at.value + s.deeper * at.by_range + s.higher * at.by_height;
}

}  // namespace

void add_pixel_sun(const View& view, const PixelSun& sun, const SceneLight& light,
                   const EyeTables& tables, std::span<std::vector<float>> planes) {
    if (sun.sighting.empty() || light.input.sun_fraction.empty()) return;
    std::vector<std::uint32_t> targets;
    targets.reserve(sun.sighting.size());
    for (const std::uint32_t s : sun.sighting) targets.push_back(view.sighting[s].target);
    std::sort(targets.begin(), targets.end());
    targets.erase(std::unique(targets.begin(), targets.end()), targets.end());
    std::vector<std::uint32_t> place(view.surface.size());
    for (std::size_t k = 0; k < targets.size(); ++k) {
        place[targets[k]] = static_cast<std::uint32_t>(k);
    }
    const std::size_t columns = planes.size();
    std::vector<AtEye> whole(targets.size() * columns);
    tables.look_at_sun(view, light, targets, whole);
    for_each_index(sun.pixel.size(), [&](std::size_t k) {
        for (std::uint32_t e = sun.row[k]; e < sun.row[k + 1]; ++e) {
            const Sighting& s = view.sighting[sun.sighting[e]];
            const float mean = light.input.sun_fraction[index(view.surface[s.target])];
            const float more = s.weight * (sun.share[e] - mean);
            const AtEye* at = &whole[place[s.target] * columns];
            for (std::size_t c = 0; c < columns; ++c) {
                planes[c][sun.pixel[k]] += more * light_at_sighting(at[c], s);
            }
        }
    });
}

void add_pixel_heat(const View& view, const PixelSun& sun, const SceneLight& light,
                    const EyeTables& tables, std::span<std::vector<float>> planes) {
    if (sun.warmer.empty()) return;
    const std::size_t columns = planes.size();
    for_each_block(sun.pixel.size(), 4096, [&](std::size_t begin, std::size_t end) {
        const std::uint32_t first = sun.row[begin], last = sun.row[end];
        std::vector<std::uint32_t> targets;
        for (std::uint32_t e = first; e < last; ++e) {
            targets.push_back(view.sighting[sun.sighting[e]].target);
        }
        std::vector<AtEye> more(targets.size() * columns);
        tables.look_at_warmth(view, light, targets,
                              std::span(sun.warmer).subspan(first, last - first), more);
        for (std::size_t k = begin; k < end; ++k) {
            for (std::uint32_t e = sun.row[k]; e < sun.row[k + 1]; ++e) {
                const Sighting& s = view.sighting[sun.sighting[e]];
                for (std::size_t c = 0; c < columns; ++c) {
                    planes[c][sun.pixel[k]] +=
                        s.weight * light_at_sighting(more[(e - first) * columns + c], s);
                }
            }
        }
    });
}

}  // namespace diurna
