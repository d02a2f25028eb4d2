#include "scenes/job/world/border_ground.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "materials/air/sight_line.hpp"
#include "materials/base/units.hpp"
#include "scenes/job/world/heights.hpp"

namespace diurna {

namespace {

/// The height [m] above the sea that a share of the outline lies below.
double height_of_share(const World& world, const FacetSet& facets, double share) {
    std::vector<std::pair<double, double>> part;  // height, length
    double all = 0.0;
    for (const BorderFacet& border : world.border) {
        part.emplace_back(height_above_sea(world, facets.centroid[border.facet].cast<double>()),
                          double(border.length));
        all += double(border.length);
    }
    std::sort(part.begin(), part.end());
    double passed = 0.0;
    for (const auto& [height, length] : part) {
        passed += length;
        if (passed >= share * all) return height;
    }
    return part.back().first;
}

}  // namespace

std::optional<BorderGround> border_ground(const World& world, const FacetSet& facets) {
    constexpr double lowest_share = 0.05;
    if (world.border.empty()) return std::nullopt;
    std::map<MaterialId, double> length;
    for (const BorderFacet& border : world.border) {
        length[facets.material[border.facet]] += double(border.length);
    }
    const auto most =
        std::max_element(length.begin(), length.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    BorderGround ground{.material = most->first,
                        .height = height_of_share(world, facets, lowest_share)};
    for (const BorderFacet& border : world.border) {
        if (facets.material[border.facet] == ground.material) ground.facet.push_back(border);
    }
    return ground;
}

bool looks_below_horizon(double eye_height, double border_height, double zenith_deg) {
    const double radius = 1e3 * earth_radius_km + border_height;
    const double eye = 1e3 * earth_radius_km + eye_height;
    const double dip_deg = eye <= radius ? 0.0 : degrees(std::acos(radius / eye));
    return zenith_deg > 90.0 + dip_deg;
}

}  // namespace diurna
