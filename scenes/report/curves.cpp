#include "scenes/report/curves.hpp"

#include <algorithm>
#include <map>

namespace diurna {

namespace {

/// Temperature below which `share` of the area lies; `order` sorts the facets by temperature.
double quantile(const std::vector<std::size_t>& order, std::span<const float> kelvin,
                const std::vector<float>& area, double total, double share) {
    double sum = 0.0;
    for (const std::size_t facet : order) {
        sum += area[facet];
        if (sum >= share * total) return kelvin[facet];
    }
    return kelvin[order.back()];
}

}  // namespace

std::vector<DiurnalCurve> diurnal_curves(const TemperatureField& field, const FacetSet& facets,
                                         const MaterialLibrary& materials) {
    std::map<std::string, std::vector<std::size_t>> members;
    for (std::size_t facet = 0; facet < facets.size(); ++facet) {
        members[materials[facets.material[facet]].kind()].push_back(facet);
    }
    std::vector<DiurnalCurve> curves;
    for (auto& [kind, order] : members) {
        DiurnalCurve curve;
        curve.material = kind;
        curve.facets = order.size();
        for (const std::size_t facet : order) curve.area += facets.area[facet];
        for (std::size_t i = 0; i < field.instant.size(); ++i) {
            const std::span<const float> kelvin = field.at(i);
            double sum = 0.0;
            for (const std::size_t facet : order) {
                sum += kelvin[facet] * double(facets.area[facet]);
            }
            std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
                return kelvin[a] != kelvin[b] ? kelvin[a] < kelvin[b] : a < b;
            });
            curve.mean.push_back(sum / curve.area);
            curve.tenth.push_back(quantile(order, kelvin, facets.area, curve.area, 0.1));
            curve.ninetieth.push_back(quantile(order, kelvin, facets.area, curve.area, 0.9));
        }
        curves.push_back(std::move(curve));
    }
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
