#include "render/rays/secondary_samples.hpp"

#include <algorithm>
#include <cmath>

#include "materials/matter/directional_optics.hpp"

namespace diurna {

namespace {

constexpr double heat_um = 10.0;

/// Shares that a facet mirrors and lets through.
struct Shares {
    double mirrored = 0.0, through = 0.0;
};

Shares shares_of(const SecondaryScene& scene, const SecondaryRay& secondary) {
    if (secondary.kind == SecondaryRay::Kind::plume) return {0.0, 1.0};
    if (secondary.kind == SecondaryRay::Kind::sky || secondary.closed) return {};
    const Material& material = scene.material(secondary.surface());
    if (!material.needs_rays()) return {};
    // Of a rough one what its microfacets do near the normal's angle: enough, and cheap.
    const auto* glossy = std::get_if<Glossy>(&material.finish);
    const double cosine = std::max(0.05, double{secondary.cosine});
    const double here = glossy ? smooth_reflectance(*glossy, heat_um, cosine) : 0.0;
    const double normal = glossy ? smooth_reflectance(*glossy, heat_um, laboratory_cosine) : 0.0;
    const DirectionalOptics optics = directional_optics(material, heat_um, cosine, here, normal);
    return {optics.mirrored, material.see_through ? optics.transmittance : 0.0};
}

}  // namespace

void sample_values(const SecondaryScene& scene, std::span<const SecondaryRay> sample,
                   std::span<const Appearance> appearances, std::vector<double>& value) {
    const std::size_t first = value.size();
    value.resize(first + appearances.size(), 0.0);
    double whole = 0.0;
    for (const SecondaryRay& secondary : sample)
        whole += secondary.before < 0 ? double{secondary.weight} : 0.0;
    std::vector<double> passed(sample.size(), 1.0);
    std::vector<double> shown(sample.size(),
                              0.0);  // of what it mirrors, by rays that were followed
    for (std::size_t i = 0; i < sample.size(); ++i) {
        const SecondaryRay& secondary = sample[i];
        if (secondary.before < 0) {
            passed[i] = double{secondary.weight} / whole;
            continue;
        }
        const auto j = static_cast<std::size_t>(secondary.before);
        const Shares before = shares_of(scene, sample[j]);
        const double part = double{secondary.weight} / double{sample[j].weight};
        const bool mirrored = secondary.way == SecondaryRay::Way::mirrored;
        passed[i] = passed[j] * part * (mirrored ? before.mirrored : before.through);
        if (mirrored) shown[j] += part * before.mirrored;
    }
    for (std::size_t i = 0; i < sample.size(); ++i) {
        const SecondaryRay& secondary = sample[i];
        const Shares shares = shares_of(scene, secondary);
        const double own = secondary.kind == SecondaryRay::Kind::sky
                               ? 1.0
                               : 1.0 - shares.mirrored - shares.through;
        for (std::size_t a = 0; a < appearances.size(); ++a) {
            const double sky = double{appearances[a].sky};
            const double facet = secondary.kind == SecondaryRay::Kind::facet
                                     ? double{appearances[a].facet[secondary.what]}
                                     : sky;
            value[first + a] += passed[i] * (own * facet + (shares.mirrored - shown[i]) * sky);
        }
    }
}

int samples_wanted(std::span<const double> values, const SecondarySampling& sampling) {
    const std::size_t kinds = sampling.appearances.size();
    const auto [from, to, tolerance] = sampling.options;
    double worst = 0.0;
    const std::size_t count = kinds > 0 ? values.size() / kinds : 0;
    for (std::size_t a = 0; a < kinds && count > 1; ++a) {
        // From the first's value, so that large numbers' differences stay exact.
        const double base = values[a];
        double sum = 0.0, squares = 0.0;
        for (std::size_t s = 0; s < count; ++s) {
            const double x = values[s * kinds + a] - base;
            sum += x;
            squares += x * x;
        }
        worst = std::max(worst, (squares - sum * sum / double(count)) / double(count - 1));
    }
    int samples = from;
    while (2 * samples <= to && worst > tolerance * tolerance * std::pow(samples, 1.5))
        samples *= 2;
    return samples;
}

}  // namespace diurna
