#include <algorithm>
#include <cmath>
#include <limits>

#include "materials/base/error.hpp"
#include "render/picture/exr.hpp"
#include "scenes/products/export/inspect.hpp"
#include "terrain/place/instant.hpp"

namespace diurna {

Found inspect_exr(const std::filesystem::path& file) {
    const Frame frame = read_exr(file);
    Found found{.kind = "OpenEXR picture"};
    found.fact = {{"width_px", {static_cast<long long>(frame.width)}},
                  {"height_px", {static_cast<long long>(frame.height)}}};
    if (!frame.observer.empty()) {
        found.fact.push_back({"observer", {frame.observer}});
        found.fact.push_back({"utc", {format_instant(frame.instant)}});
    }
    FoundTable planes{"planes", {"plane", "unit", "least", "most", "mean", "finite_px"}, {}};
    for (const Plane& plane : frame.planes) {
        double least = std::numeric_limits<double>::infinity(), most = -least, sum = 0.0;
        long long finite = 0;
        for (const float v : plane.pixel) {
            if (!std::isfinite(v)) continue;
            least = std::min(least, double{v});
            most = std::max(most, double{v});
            sum += v;
            ++finite;
        }
        planes.row.push_back(
            {plane.name, plane.unit, least, most, sum / static_cast<double>(finite), finite});
    }
    FoundTable attributes{"attributes", {"attribute", "text"}, {}};
    for (const auto& [name, text] : frame.attributes) attributes.row.push_back({name, text});
    for (const auto& [name, text] : frame.notes) attributes.row.push_back({"note." + name, text});
    found.table = {std::move(planes), std::move(attributes)};
    return found;
}

}  // namespace diurna
