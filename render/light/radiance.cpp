#include "render/light/radiance.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>

#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

namespace {

/// What node-by-node shading needs to know of a facet.
struct Surface {
    const Material* material;
    double temperature, behind;  // [K]
    double sunlight;             // f cosθ / π
    double sky_view;
    double height_km;  // above the sea
};

struct Optics {
    double emissivity, reflectance, transmittance;
};

Optics optics(const Material& material, double wavelength_um) {
    const double reflectance = material.reflectance.at(wavelength_um);
    const double transmittance =
        material.transmittance.empty() ? 0.0 : material.transmittance.at(wavelength_um);
    return {1.0 - reflectance - transmittance, reflectance, transmittance};
}

Surface surface_of(const RadianceInput& input, FacetId facet) {
    const std::size_t f = index(facet);
    const Material& material = input.materials[input.facets.material[f]];
    const double temperature = input.temperature[f];
    return {.material = &material,
            .temperature = temperature,
            .behind = temperature_behind(material, temperature),
            .sunlight = sunlight_on(input, facet),
            .sky_view = input.views.sky[f],
            .height_km = input.ground_height_km +
                         1e-3 * level_height(input.facets.centroid[f].cast<double>())};
}

}  // namespace

double temperature_behind(const Material& material, double facet_temperature) {
    const auto* room = std::get_if<Interior>(&material.thermal.bottom);
    return room ? room->air_temperature : facet_temperature;
}

double sunlight_on(const RadianceInput& input, FacetId facet) {
    if (input.sun_fraction.empty()) return 0.0;
    const std::size_t f = index(facet);
    const double cosine = input.facets.normal[f].cast<double>().dot(input.to_sun);
    return input.sun_fraction[f] * std::max(0.0, cosine) / std::numbers::pi;
}

std::optional<SunField> scattered_sun(const RadianceInput& input, std::span<const double> node_um) {
    constexpr double no_sunlight_um = 5.0;
    const auto* model = std::get_if<BandModel>(&input.atmosphere);
    if (model == nullptr || input.sun_fraction.empty() || input.sun_zenith_deg >= 90.0 ||
        std::none_of(node_um.begin(), node_um.end(),
                     [](double um) { return um < no_sunlight_um; })) {
        return std::nullopt;
    }
    return SunField(*model,
                    {.zenith_deg = input.sun_zenith_deg, .distance_au = input.sun_distance_au},
                    node_um);
}

Light light_at(const RadianceInput& input, double height_km, std::span<const double> node_um,
               const SunField* scattered) {
    Light light{.sun = std::vector<double>(node_um.size(), 0.0),
                .sky = mean_sky_at_nodes(input.atmosphere, height_km, node_um, 8)};
    if (!input.sun_fraction.empty()) {
        light.sun = solar_at_nodes(input.atmosphere, height_km, input.sun_zenith_deg,
                                   input.sun_distance_au, node_um);
    }
    if (scattered != nullptr) {
        const SunFlux flux = scattered->flux(height_km);
        for (std::size_t n = 0; n < node_um.size(); ++n) {
            light.sky[n] += flux.down[n] * std::numbers::inv_pi;
        }
    }
    return light;
}

double horizon_zenith_deg(const RadianceInput& input, double height_km) {
    const double plain = earth_radius_km + input.ground_height_km;
    const double eye = earth_radius_km + height_km;
    return eye <= plain ? 90.0 : 180.0 - degrees(std::asin(plain / eye));
}

namespace {

/// Range [km] of the nearer crossing of a ray with the sphere of the plain.
double range_to_plain(const RadianceInput& input, double height_km, double zenith_deg) {
    const double plain = earth_radius_km + input.ground_height_km;
    const double eye = earth_radius_km + height_km;
    const double cosine = std::cos(radians(zenith_deg));
    const double square = (plain - eye) * (plain + eye) + eye * eye * cosine * cosine;
    return std::max(0.0, -eye * cosine - std::sqrt(std::max(0.0, square)));
}

}  // namespace

std::vector<double> background_at(const RadianceInput& input, double height_km, double zenith_deg,
                                  std::span<const double> node_um) {
    if (zenith_deg <= horizon_zenith_deg(input, height_km)) {
        return sky_at_nodes(input.atmosphere, height_km, zenith_deg, node_um);
    }
    PathSpectrum path = path_at_nodes(
        input.atmosphere,
        chord(height_km, input.ground_height_km, range_to_plain(input, height_km, zenith_deg)),
        node_um);
    const double temperature = air_temperature_at(input.atmosphere, input.ground_height_km);
    for (std::size_t n = 0; n < node_um.size(); ++n) {
        path.radiance[n] += path.transmittance[n] * planck(node_um[n], temperature);
    }
    return std::move(path.radiance);
}

std::vector<double> scattered_background_at(const RadianceInput& input, const SunField& scattered,
                                            double height_km, double zenith_deg,
                                            double azimuth_from_sun_deg) {
    return std::move(scattered_backgrounds_at(input, scattered, height_km, zenith_deg,
                                              std::span(&azimuth_from_sun_deg, 1))
                         .front());
}

std::vector<std::vector<double>> scattered_backgrounds_at(
    const RadianceInput& input, const SunField& scattered, double height_km, double zenith_deg,
    std::span<const double> azimuth_from_sun_deg) {
    if (zenith_deg <= horizon_zenith_deg(input, height_km)) {
        return scattered.skies(height_km, zenith_deg, azimuth_from_sun_deg);
    }
    std::vector<double> angle_deg;
    for (const double azimuth : azimuth_from_sun_deg) {
        angle_deg.push_back(scattered.angle_from_sun_deg(zenith_deg, azimuth));
    }
    SunField::ByTurn light = scattered.path_by_turn(
        chord(height_km, input.ground_height_km, range_to_plain(input, height_km, zenith_deg)),
        angle_deg);
    const double cosine = std::cos(radians(zenith_deg));
    for (std::vector<double>& radiance : light.at_angle) {
        for (std::size_t n = 0; n < radiance.size(); ++n) {
            radiance[n] += cosine * light.by_cosine[n];
        }
    }
    return std::move(light.at_angle);
}

namespace {

/// The light at heights 4 m apart, worked out once, and linear between them (2e-6 off, as optical
/// depths change over a kilometre).
struct LightMemo {
    const RadianceInput& input;
    std::span<const double> node_um;
    const SunField* scattered;
    std::map<long, Light> known;

    const Light& step(long k) {
        const auto [place, is_new] = known.try_emplace(k);
        if (is_new) place->second = light_at(input, 4e-3 * double(k), node_um, scattered);
        return place->second;
    }
    Light at(double height_km) {
        const double u = height_km / 4e-3, below = std::floor(u), t = u - below;
        const Light &low = step(std::lround(below)), &high = step(std::lround(below) + 1);
        Light light = low;
        for (std::size_t n = 0; n < node_um.size(); ++n) {
            light.sun[n] += t * (high.sun[n] - low.sun[n]);
            light.sky[n] += t * (high.sky[n] - low.sky[n]);
        }
        return light;
    }
};

std::array<std::vector<double>, term_count> leaving_terms(const RadianceInput& input, FacetId facet,
                                                          std::span<const double> node_um,
                                                          int bounces, LightMemo& memo) {
    std::array<std::vector<double>, term_count> leaving;
    for (auto& term : leaving) term.assign(node_um.size(), 0.0);
    const auto of = [&](Term term) -> std::vector<double>& {
        return leaving[static_cast<std::size_t>(term)];
    };
    const Surface own = surface_of(input, facet);
    const ViewFactors& exchange = input.views.others;
    const std::size_t f = index(facet);
    const double rest = 1.0 - own.sky_view;
    double total = 0.0;
    for (std::uint32_t k = exchange.row[f]; k < exchange.row[f + 1]; ++k) {
        total += double{exchange.factor[k]};
    }
    std::vector<double> around(node_um.size(), 0.0);
    for (std::uint32_t k = exchange.row[f]; bounces > 0 && k < exchange.row[f + 1]; ++k) {
        if (exchange.factor[k] == 0.0f) continue;
        const auto sent = leaving_terms(input, exchange.facet[k], node_um, bounces - 1, memo);
        const double factor = rest * double{exchange.factor[k]} / total;
        for (const auto& term : sent) {
            for (std::size_t n = 0; n < around.size(); ++n) around[n] += factor * term[n];
        }
    }
    const bool closed = bounces == 0 || total == 0.0;
    const Light light = memo.at(own.height_km);
    for (std::size_t n = 0; n < node_um.size(); ++n) {
        const auto [emissivity, reflectance, transmittance] = optics(*own.material, node_um[n]);
        const double black = planck(node_um[n], own.temperature);
        of(Term::emitted)[n] = emissivity * black;
        of(Term::sun)[n] = reflectance * own.sunlight * light.sun[n];
        of(Term::sky)[n] = reflectance * own.sky_view * light.sky[n];
        of(Term::surroundings)[n] = reflectance * (closed ? rest * black : around[n]);
        of(Term::behind)[n] = transmittance * planck(node_um[n], own.behind);
    }
    return leaving;
}

}  // namespace

std::array<std::vector<double>, term_count> leaving_radiance(const RadianceInput& input,
                                                             FacetId facet,
                                                             std::span<const double> node_um,
                                                             int bounces,
                                                             const SunField* scattered) {
    std::optional<SunField> own;
    if (scattered == nullptr) own = scattered_sun(input, node_um);
    LightMemo memo{
        .input = input, .node_um = node_um, .scattered = own ? &*own : scattered, .known = {}};
    return leaving_terms(input, facet, node_um, bounces, memo);
}

std::array<double, term_count> radiance_at_eye(const RadianceInput& input, const Band& band,
                                               double observer_height, FacetId facet, double range,
                                               double height, int segments,
                                               const SunField* scattered) {
    const double from_km = input.ground_height_km + 1e-3 * observer_height;
    const double to_km = input.ground_height_km + 1e-3 * height;
    const PathSpectrum path = path_at_nodes(
        input.atmosphere, chord(from_km, to_km, 1e-3 * range, segments), band.node_um);
    const auto leaving = leaving_radiance(input, facet, band.node_um, 2, scattered);
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
