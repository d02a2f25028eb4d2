#include "scenes/report/curves.hpp"

#include <algorithm>
#include <map>
#include <span>
#include <utility>

#include "materials/base/parallel.hpp"

namespace diurna {

namespace {

struct Patch {
    float kelvin, area;
};

/// Temperature below which `share` of the area lies, of patches by temperature.
double quantile(const std::vector<Patch>& patches, double total, double share) {
    double sum = 0.0;
    for (const Patch& patch : patches) {
        sum += patch.area;
        if (sum >= share * total) return patch.kelvin;
    }
    return patches.back().kelvin;
}

}  // namespace

std::vector<DiurnalCurve> diurnal_curves(const TemperatureField& field, const FacetSet& facets,
                                         const MaterialLibrary& materials) {
    std::map<std::string, std::vector<std::size_t>> members;
    for (std::size_t facet = 0; facet < facets.size(); ++facet) {
        members[materials[facets.material[facet]].kind()].push_back(facet);
    }
    const std::size_t instants = field.instant.size();
    std::vector<DiurnalCurve> curves;
    for (const auto& [kind, all] : members) {
        DiurnalCurve curve;
        curve.material = kind;
        curve.facets = all.size();
        for (const std::size_t facet : all) curve.area += facets.area[facet];
        for (auto* of : {&curve.mean, &curve.tenth, &curve.ninetieth}) of->resize(instants);
        for_each_index(
            instants,
            [&](std::size_t i) {
                const std::span<const float> kelvin = field.at(i);
                std::vector<Patch> patches(all.size());
                double sum = 0.0;
                for (std::size_t k = 0; k < all.size(); ++k) {
                    patches[k] = {kelvin[all[k]], facets.area[all[k]]};
                    sum += double(patches[k].kelvin) * double(patches[k].area);
                }
                std::sort(patches.begin(), patches.end(),
                          [](const Patch& a, const Patch& b) { return a.kelvin < b.kelvin; });
                curve.mean[i] = sum / curve.area;
                curve.tenth[i] = quantile(patches, curve.area, 0.1);
                curve.ninetieth[i] = quantile(patches, curve.area, 0.9);
            },
            1);
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
