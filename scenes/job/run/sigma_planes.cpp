#include "scenes/job/run/sigma_planes.hpp"

#include <cmath>
#include <string>

#include "render/picture/quicklook.hpp"
#include "scenes/job/run/picture.hpp"

namespace diurna {

void add_sigma_planes(const std::vector<ChangedSeries>& changed, const std::vector<Band>& bands,
                      Instant instant, bool blurred, Frame& frame) {
    if (changed.empty()) return;
    std::vector<Plane> sigma;  // squares until the end
    for (const Band& band : bands) {
        const Plane& shown = frame[shown_plane(band)];
        sigma.push_back({.name = "sigma." + band.name,
                         .unit = shown.unit,
                         .pixel = std::vector<float>(shown.pixel.size(), 0.0f)});
    }
    for (const ChangedSeries& one : changed) {
        const Picture other = picture_at(one.scene.prepared(), one.series, one.scene.stage.views,
                                         one.field, instant, blurred);
        for (std::size_t b = 0; b < bands.size(); ++b) {
            const std::string name = shown_plane(bands[b]);
            const std::vector<float>& before = frame[name].pixel;
            const std::vector<float>& after = other.frame[name].pixel;
            for (std::size_t p = 0; p < before.size(); ++p) {
                const float change = after[p] - before[p];
                sigma[b].pixel[p] += change * change;
            }
        }
    }
    for (Plane& plane : sigma) {
        for (float& value : plane.pixel) value = std::sqrt(value);
        frame.planes.push_back(std::move(plane));
    }
}

}  // namespace diurna
