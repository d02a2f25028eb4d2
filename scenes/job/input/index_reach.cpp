#include "scenes/job/input/index_reach.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <variant>

#include "materials/matter/read_finish.hpp"

namespace diurna {

void check_index_reach(const Section& section, const Material& material,
                       std::span<const SeenRange> ranges) {
    const auto* glossy = std::get_if<Glossy>(&material.finish);
    if (glossy == nullptr) return;
    const std::optional<IndexReach> reach = index_reach(section, *glossy);
    if (!reach) return;
    const SeenRange* worst = nullptr;
    double furthest = 1e-6;  // [µm]
    for (const SeenRange& range : ranges) {
        const double below = reach->from_um - range.from_um,
                     above = std::min(range.to_um, reach->needed_to_um) - reach->to_um;
        if (std::max(below, above) <= furthest) continue;
        furthest = std::max(below, above);
        worst = &range;
    }
    if (worst == nullptr) return;
    const double needed_to_um = std::min(worst->to_um, reach->needed_to_um);
    section.section("finish", finish_says)
        .mistake(
            "index_file",
            fmt::format("band {} needs n and k from {:g} to {:g} um, the file has {:g} to {:g} um",
                        worst->name, worst->from_um, needed_to_um, reach->from_um, reach->to_um),
            reach->effective_helps && reach->to_um >= 4.0
                ? "add rows to the file, or set effective_index = true (beyond 4 um)"
                : "add rows to the file");
}

}  // namespace diurna
