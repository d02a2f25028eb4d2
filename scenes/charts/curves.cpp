#include "scenes/charts/curves.hpp"

#include <algorithm>

#include "materials/base/parallel.hpp"

namespace diurna {

namespace {

/// Temperature below which `share` of the area lies; `order` sorts the facets by temperature.
double quantile(const std::vector<std::uint32_t>& order, std::span<const float> kelvin,
                const std::vector<float>& area, double total, double share) {
    double sum = 0.0;
    for (const std::uint32_t facet : order) {
        sum += area[facet];
        if (sum >= share * total) return kelvin[facet];
    }
    return kelvin[order.back()];
}

}  // namespace

std::size_t DiurnalCurve::coldest() const {
    return static_cast<std::size_t>(std::min_element(mean.begin(), mean.end()) - mean.begin());
}

std::size_t DiurnalCurve::warmest() const {
    return static_cast<std::size_t>(std::max_element(mean.begin(), mean.end()) - mean.begin());
}

double area_mean(const FacetGroup& group, const std::vector<float>& area,
                 std::span<const float> value) {
    double sum = 0.0, total = 0.0;
    for (const std::uint32_t facet : group.facet) {
        sum += value[facet] * double(area[facet]);
        total += area[facet];
    }
    return sum / total;
}

std::vector<DiurnalCurve> diurnal_curves(const TemperatureField& field, const FacetSet& facets,
                                         const std::vector<FacetGroup>& groups) {
    std::vector<DiurnalCurve> curves(groups.size());
    for (std::size_t g = 0; g < groups.size(); ++g) {
        curves[g].name = groups[g].name;
        curves[g].facets = groups[g].facet.size();
        for (const std::uint32_t facet : groups[g].facet) curves[g].area += facets.area[facet];
        curves[g].mean.resize(field.instant.size());
    }
    for_each_index(
        field.instant.size(),
        [&](std::size_t i) {
            for (std::size_t g = 0; g < groups.size(); ++g) {
                curves[g].mean[i] = area_mean(groups[g], facets.area, field.at(i));
            }
        },
        1);
    for_each_index(
        groups.size(),
        [&](std::size_t g) {
            const std::span<const float> kelvin = field.at(curves[g].warmest());
            std::vector<std::uint32_t> order = groups[g].facet;
            std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
                return kelvin[a] != kelvin[b] ? kelvin[a] < kelvin[b] : a < b;
            });
            curves[g].tenth = quantile(order, kelvin, facets.area, curves[g].area, 0.1);
            curves[g].ninetieth = quantile(order, kelvin, facets.area, curves[g].area, 0.9);
        },
        1);
    return curves;
}

std::vector<Instant> crossovers(const std::vector<Instant>& instants, const DiurnalCurve& a,
                                const DiurnalCurve& b) {
    std::vector<Instant> found;
    for (std::size_t i = 0; i + 1 < instants.size(); ++i) {
        const double before = a.mean[i] - b.mean[i];
        const double after = a.mean[i + 1] - b.mean[i + 1];
        if ((before < 0.0) == (after < 0.0) || before == after) continue;
        const double seconds = seconds_between(instants[i], instants[i + 1]);
        found.push_back(later(instants[i], seconds * before / (before - after)));
    }
    return found;
}

}  // namespace diurna
