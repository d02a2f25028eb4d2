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
    const ScatteredSun* scattered;
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
        const auto mix = [&](std::vector<double>& value, const std::vector<double>& next) {
            for (std::size_t n = 0; n < value.size(); ++n) value[n] += t * (next[n] - value[n]);
        };
        mix(light.sun, high.sun);
        mix(light.sky, high.sky);
        mix(light.scattered, high.scattered);
        mix(light.aureole, high.aureole);
        for (std::size_t k = 0; k < light.uneven_heat.size(); ++k) {
            mix(light.uneven_heat[k], high.uneven_heat[k]);
        }
        for (std::size_t k = 0; k < light.uneven_scattered.size(); ++k) {
            mix(light.uneven_scattered[k], high.uneven_scattered[k]);
        }
        for (std::size_t k = 0; k < light.left_scattered.size(); ++k) {
            mix(light.left_scattered[k], high.left_scattered[k]);
        }
        return light;
    }
};

/// Adds factor × light, node by node.
void add(LightByOrigin& sum, std::span<const double> factor, const LightByOrigin& light) {
    for (std::size_t origin = 0; origin < origin_count; ++origin) {
        if (light[origin].empty()) continue;
        sum[origin].resize(factor.size(), 0.0);
        for (std::size_t n = 0; n < factor.size(); ++n) {
            sum[origin][n] += factor[n] * light[origin][n];
        }
    }
}

/// Light that arrives from the facets around [W m⁻² sr⁻¹ µm⁻¹]; empty if there are none.
LightByOrigin arriving(LightMemo& memo, SurfaceId facet, int bounces);

TermsByOrigin terms_of(LightMemo& memo, SurfaceId facet, int bounces) {
    const RadianceInput& input = memo.input;
    const std::span<const double> node_um = memo.node_um;
    const std::size_t f = index(facet), nodes = node_um.size();
    const Material& material = input.materials[input.facets.material[f]];
    const double temperature = input.temperature[f];
    const double behind = temperature_behind(material, temperature);
    const double sky_view = input.views.sky[f], sunlight = sunlight_on(input, facet);
    const IncidentLight light = memo.at(input.height_km(facet));
    std::vector<double> emitted(nodes), shone_through(nodes), reflectance(nodes), of_sun(nodes),
        black(nodes);
    for (std::size_t n = 0; n < nodes; ++n) {
        const SurfaceOptics optics = optics_at(material, node_um[n]);
        reflectance[n] = optics.reflectance;
        of_sun[n] = optics.reflectance * sunlight;
        black[n] = (1.0 - sky_view) * planck(node_um[n], temperature);
        emitted[n] = optics.emissivity * planck(node_um[n], temperature);
        shone_through[n] = optics.transmittance * planck(node_um[n], behind);
    }
    LightByOrigin around =
        bounces > 0 ? arriving(memo, facet, bounces) : from_surface(std::move(black));
    if (around == LightByOrigin{}) around = from_surface(std::move(black));
    // (T36) of docs/theory.md
    TermsByOrigin terms;
    const auto term = [&](Term t) -> LightByOrigin& { return terms[static_cast<std::size_t>(t)]; };
    term(Term::emitted) = from_surface(std::move(emitted));
    term(Term::behind) = from_surface(std::move(shone_through));
    add(term(Term::sun), of_sun, light.sun_by_origin());
    add(term(Term::sky), reflectance,
        light.sky_on(sky_view, uneven_view(input, facet), narrow_view(input, facet)));
    add(term(Term::surroundings), reflectance, around);
    return terms;
}

LightByOrigin arriving(LightMemo& memo, SurfaceId facet, int bounces) {
    LightByOrigin sum;
    each_seen_facet(memo.input.views, facet, [&](SurfaceId other, double factor) {
        // Of a net its strips alone, which the factor is for: what is behind has its own.
        const RadianceInput& input = memo.input;
        const Material& material = input.materials[input.facets.material[index(other)]];
        const bool room = std::holds_alternative<Interior>(material.thermal.bottom);
        const double passed = room ? 0.0 : passed_heat(material);
        const double of_strips = passed < 1.0 ? factor / (1.0 - passed) : factor;
        const std::vector<double> share(memo.node_um.size(), of_strips);
        for (const LightByOrigin& term : terms_of(memo, other, bounces - 1)) {
            add(sum, share, term);
        }
        if (passed == 0.0) return;
        std::vector<double>& of_surface = from(sum, Origin::surface);
        const double temperature = input.temperature[index(other)];
        for (std::size_t n = 0; n < of_surface.size(); ++n) {
            of_surface[n] -= of_strips * passed * planck(memo.node_um[n], temperature);
        }
    });
    return sum;
}

}  // namespace

double sunlight_on(const RadianceInput& input, SurfaceId facet) {
    if (input.sun_fraction.empty()) return 0.0;
    const std::size_t f = index(facet);
    return sunlight_on(double{input.sun_fraction[f]},
                       input.facets.normal[f].cast<double>().dot(input.to_sun));
}

TermsByOrigin radiosity_by_origin(const RadianceInput& input, SurfaceId facet,
                                  std::span<const double> node_um, int bounces,
                                  const ScatteredSun* scattered) {
    std::optional<ScatteredSun> own;
    if (scattered == nullptr) own = scattered_sun(input, node_um);
    LightMemo memo{
        .input = input, .node_um = node_um, .scattered = own ? &*own : scattered, .known = {}};
    return terms_of(memo, facet, bounces);
}

NodeTerms radiosity_terms(const RadianceInput& input, SurfaceId facet,
                          std::span<const double> node_um, int bounces,
                          const ScatteredSun* scattered) {
    NodeTerms sums;
    const TermsByOrigin terms = radiosity_by_origin(input, facet, node_um, bounces, scattered);
    for (std::size_t t = 0; t < term_count; ++t) {
        sums[t].assign(node_um.size(), 0.0);
        for (const std::vector<double>& light : terms[t]) {
            for (std::size_t n = 0; n < light.size(); ++n) sums[t][n] += light[n];
        }
    }
    return sums;
}

LightByOrigin onward_shares(const RadianceInput& input, const SightLine& line, double height_km,
                            std::span<const double> node_um) {
    LightByOrigin shares =
        from_surface(path_at_nodes(input.atmosphere, line, node_um).transmittance);
    const auto sun = [&](const SightLine& onward) {
        return solar_at_nodes(input.atmosphere, height_km, input.sun_zenith_deg, 1.0, node_um,
                              onward);
    };
    const auto sky = [&](const SightLine& onward) {
        return mean_sky_at_nodes(input.atmosphere, height_km, node_um, 8, onward);
    };
    const std::vector<double> sun_here = sun({}), sky_here = sky({});
    from(shares, Origin::sunlight) = sun(line);
    from(shares, Origin::sky_heat) = sky(line);
    for (std::size_t n = 0; n < node_um.size(); ++n) {
        const double of_surface = from(shares, Origin::surface)[n];
        double& of_sun = from(shares, Origin::sunlight)[n];
        double& of_sky = from(shares, Origin::sky_heat)[n];
        of_sun = sun_here[n] > 1e-300 ? of_sun / sun_here[n] : of_surface;
        of_sky = sky_here[n] > 1e-300 ? of_sky / sky_here[n] : of_surface;
    }
    return shares;
}

std::array<double, term_count> radiance_at_eye(const RadianceInput& input, const Band& band,
                                               const FacetSight& sight, int segments,
                                               const ScatteredSun* scattered) {
    const double height_km = input.above_sea_km(sight.height);
    const SightLine line =
        chord(input.above_sea_km(sight.observer_height), height_km, 1e-3 * sight.range, segments);
    const PathSpectrum path = path_at_nodes(input.atmosphere, line, band.node_um);
    const LightByOrigin shares = onward_shares(input, line, height_km, band.node_um);
    const TermsByOrigin leaving =
        radiosity_by_origin(input, sight.facet, band.node_um, 2, scattered);
    // (T40) of docs/theory.md
    std::array<double, term_count> sum{};
    for (std::size_t t = 0; t + 1 < term_count; ++t) {
        for (std::size_t origin = 0; origin < origin_count; ++origin) {
            const std::vector<double>& light = leaving[t][origin];
            for (std::size_t n = 0; n < light.size(); ++n) {
                sum[t] += band.weight[n] * shares[origin][n] * light[n];
            }
        }
    }
    sum.back() = band_sum_nodes(band, path.radiance);
    return sum;
}

}  // namespace diurna
