#include "scenes/products/export/curve_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "scenes/charts/curves.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

std::string cell(const std::string& name) {
    return name.find(',') == name.npos ? name : fmt::format("\"{}\"", name);
}

}  // namespace

std::string curve_csv(const RunHeat& heat, std::span<const NamedGroup> groups,
                      std::span<const Instant> instants) {
    std::vector<HeatAt> at;
    for (const Instant when : instants) at.push_back(heat_at(heat, when));
    const std::vector<float>& area = heat.mesh.facets.area;
    std::string text = "utc,local_time,kind,name,facets,area_m2,mean_K,least_K,most_K\n";
    for (const auto& [kind, group] : groups) {
        double total = 0.0;
        for (const std::uint32_t f : group.facet) total += area[f];
        for (const HeatAt& one : at) {
            float least = std::numeric_limits<float>::infinity(), most = -least;
            for (const std::uint32_t f : group.facet) {
                least = std::min(least, one.kelvin[f]);
                most = std::max(most, one.kelvin[f]);
            }
            text += fmt::format(
                "{},{},{},{},{},{:.6g},{:.4f},{:.4f},{:.4f}\n", format_instant(one.when),
                format_local(one.when, heat.mesh.utc_offset), kind, cell(group.name),
                group.facet.size(), total, area_mean(group, area, one.kelvin), least, most);
        }
    }
    return text;
}

}  // namespace diurna
