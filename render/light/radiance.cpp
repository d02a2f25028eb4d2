#include "render/light/radiance.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <variant>

#include "materials/matter/passed_light.hpp"
#include "materials/radiation/planck.hpp"
#include "render/light/node_optics.hpp"

namespace diurna {

namespace {

/// The light at heights 4 m apart, worked out once, and linear between them (2e-6 off, as optical
/// depths change over a kilometre).
struct LightMemo {
    const RadianceInput& input;
    std::span<const double> node_um;
    const SunField* scattered;
    std::map<long, IncidentLight> known;

    const IncidentLight& step(long k) {
        const auto [place, is_new] = known.try_emplace(k);
        if (is_new) place->second = incident_light(input, 4e-3 * double(k), node_um, scattered);
        return place->second;
    }
    IncidentLight at(double height_km) {
        const double u = height_km / 4e-3, below = std::floor(u), t = u - below;
        const IncidentLight &low = step(std::lround(below)), &high = step(std::lround(below) + 1);
        IncidentLight light = low;
        for (std::size_t n = 0; n < node_um.size(); ++n) {
            light.sun[n] += t * (high.sun[n] - low.sun[n]);
            light.sky[n] += t * (high.sky[n] - low.sky[n]);
        }
        return light;
    }
};

/// Light that arrives from the facets around, (node) [W m⁻² sr⁻¹ µm⁻¹]; empty if there are none.
std::vector<double> arriving(LightMemo& memo, FacetId facet, int bounces);

NodeTerms terms_of(LightMemo& memo, FacetId facet, int bounces) {
    const RadianceInput& input = memo.input;
    const std::span<const double> node_um = memo.node_um;
    const std::size_t f = index(facet);
    const Material& material = input.materials[input.facets.material[f]];
    const double temperature = input.temperature[f];
    const double behind = temperature_behind(material, temperature);
    const double sky_view = input.views.sky[f], sunlight = sunlight_on(input, facet);
    const std::vector<double> around =
        bounces > 0 ? arriving(memo, facet, bounces) : std::vector<double>{};
    const IncidentLight light = memo.at(input.height_km(facet));
    NodeTerms terms;
    for (auto& term : terms) term.assign(node_um.size(), 0.0);
    const auto of = [&](Term term) -> std::vector<double>& {
        return terms[static_cast<std::size_t>(term)];
    };
    for (std::size_t n = 0; n < node_um.size(); ++n) {
        const auto [emissivity, reflectance, transmittance] = optics_at(material, node_um[n]);
        const double black = planck(node_um[n], temperature);
        of(Term::emitted)[n] = emissivity * black;
        of(Term::sun)[n] = reflectance * sunlight * light.sun[n];
        of(Term::sky)[n] = reflectance * sky_view * light.sky[n];
        of(Term::surroundings)[n] =
            reflectance * (around.empty() ? (1.0 - sky_view) * black : around[n]);
        of(Term::behind)[n] = transmittance * planck(node_um[n], behind);
    }
    return terms;
}

std::vector<double> arriving(LightMemo& memo, FacetId facet, int bounces) {
    std::vector<double> sum;
    each_seen_facet(memo.input.views, facet, [&](FacetId other, double factor) {
        sum.resize(memo.node_um.size(), 0.0);
        // Of a net its strips alone, which the factor is for: what is behind has its own.
        const RadianceInput& input = memo.input;
        const Material& material = input.materials[input.facets.material[index(other)]];
        const bool room = std::holds_alternative<Interior>(material.thermal.bottom);
        const double passed = room ? 0.0 : passed_heat(material);
        const double share = passed < 1.0 ? factor / (1.0 - passed) : factor;
        const double temperature = input.temperature[index(other)];
        for (const auto& term : terms_of(memo, other, bounces - 1)) {
            for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += share * term[n];
        }
        for (std::size_t n = 0; n < sum.size() && passed > 0.0; ++n) {
            sum[n] -= share * passed * planck(memo.node_um[n], temperature);
        }
    });
    return sum;
}

}  // namespace

double sunlight_on(const RadianceInput& input, FacetId facet) {
    if (input.sun_fraction.empty()) return 0.0;
    const std::size_t f = index(facet);
    return sunlight_on(double{input.sun_fraction[f]},
                       input.facets.normal[f].cast<double>().dot(input.to_sun));
}

NodeTerms radiosity_terms(const RadianceInput& input, FacetId facet,
                          std::span<const double> node_um, int bounces, const SunField* scattered) {
    std::optional<SunField> own;
    if (scattered == nullptr) own = scattered_sun(input, node_um);
    LightMemo memo{
        .input = input, .node_um = node_um, .scattered = own ? &*own : scattered, .known = {}};
    return terms_of(memo, facet, bounces);
}

std::array<double, term_count> radiance_at_eye(const RadianceInput& input, const Band& band,
                                               const FacetSight& sight, int segments,
                                               const SunField* scattered) {
    const SightLine line = chord(input.above_sea_km(sight.observer_height),
                                 input.above_sea_km(sight.height), 1e-3 * sight.range, segments);
    const PathSpectrum path = path_at_nodes(input.atmosphere, line, band.node_um);
    const NodeTerms leaving = radiosity_terms(input, sight.facet, band.node_um, 2, scattered);
    std::array<double, term_count> sum{};
    for (std::size_t n = 0; n < band.node_um.size(); ++n) {
        for (std::size_t t = 0; t + 1 < term_count; ++t) {
            sum[t] += band.weight[n] * path.transmittance[n] * leaving[t][n];
        }
        sum[term_count - 1] += band.weight[n] * path.radiance[n];
    }
    return sum;
}

}  // namespace diurna
