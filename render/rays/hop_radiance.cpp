#include "render/rays/reference.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "materials/base/units.hpp"
#include "materials/matter/directional_optics.hpp"
#include "materials/matter/microfacet.hpp"
#include "materials/radiation/planck.hpp"
#include "terrain/place/site.hpp"

namespace diurna {

namespace {

double zenith_deg(const Eigen::Vector3d& direction) {
    return degrees(std::acos(std::clamp(direction.z(), -1.0, 1.0)));
}

/// directional_optics() of the nodes; an index of refraction that does not change with wavelength
/// is evaluated once.
std::vector<DirectionalOptics> optics_of(const Material& material, const Band& band,
                                         double cosine) {
    std::vector<DirectionalOptics> optics;
    const auto* glossy = std::get_if<Glossy>(&material.finish);
    const bool once =
        !glossy || glossy->metal || (glossy->index.value.size() == 2 && glossy->extinction.empty());
    double here = 0.0, normal = 0.0;
    for (std::size_t n = 0; n < band.node_um.size(); ++n) {
        const double um = band.node_um[n];
        if (n == 0 || !once) {
            here = interface_reflectance(material.finish, um, cosine);
            normal = interface_reflectance(material.finish, um, laboratory_cosine);
        }
        optics.push_back(directional_optics(material, um, cosine, here, normal));
    }
    return optics;
}

/// The diffuse optics' mean over the hemisphere, node by node: midpoints.
std::vector<double> mean_diffuse(const Material& material, const Band& band) {
    constexpr int steps = 100;
    std::vector<double> mean(band.node_um.size(), 0.0);
    for (int i = 0; i < steps; ++i) {
        const double cosine = (i + 0.5) / steps;
        const auto optics = optics_of(material, band, cosine);
        for (std::size_t n = 0; n < mean.size(); ++n) {
            mean[n] += optics[n].diffuse * 2.0 * cosine / steps;
        }
    }
    return mean;
}

/// What a facet sends along the ray that arrives, but for what it mirrors and lets through.
std::vector<double> open_facet(const Hop& hop, const Material& material, const Band& band,
                               const RadianceInput& input, const SunField* scattered) {
    const FacetId facet{hop.what};
    const std::size_t f = hop.what;
    const auto terms = leaving_radiance(input, facet, band.node_um, 2, scattered);
    const Light light = light_at(
        input,
        input.ground_height_km + 1e-3 * level_height(input.facets.centroid[f].cast<double>()),
        band.node_um, scattered);
    const Eigen::Vector3d normal = input.facets.normal[f].cast<double>();
    const Eigen::Vector3d eye = -hop.direction.cast<double>();
    const double sunlight = sunlight_on(input, facet), sun_cosine = normal.dot(input.to_sun);
    std::vector<double> sent(band.node_um.size());
    const auto seen = optics_of(material, band, double{hop.cosine});
    std::vector<DirectionalOptics> lit, half_way;
    std::vector<double> mean;
    if (sunlight > 0.0) {
        lit = optics_of(material, band, sun_cosine);
        half_way = optics_of(material, band, (eye + input.to_sun).normalized().dot(eye));
        mean = mean_diffuse(material, band);
    }
    for (std::size_t n = 0; n < sent.size(); ++n) {
        const double um = band.node_um[n], reflectance = material.reflectance.at(um);
        const DirectionalOptics& optics = seen[n];
        sent[n] = optics.emissivity * planck(um, input.temperature[f]);
        if (reflectance > 0.0) {
            sent[n] +=
                optics.diffuse / reflectance *
                (terms[std::size_t(Term::sky)][n] + terms[std::size_t(Term::surroundings)][n]);
        }
        if (!material.see_through) {
            sent[n] += optics.transmittance *
                       planck(um, temperature_behind(material, input.temperature[f]));
        }
        if (!(sunlight > 0.0)) continue;
        if (mean[n] > 0.0) {
            sent[n] += optics.diffuse * lit[n].diffuse / mean[n] * sunlight * light.sun[n];
        }
        const auto* glossy = std::get_if<Glossy>(&material.finish);
        if (glossy == nullptr || normal.dot(eye) <= 0.0) continue;
        const Microfacets surface{.roughness =
                                      std::hypot(glossy->roughness, 0.5 * radians(0.2666))};
        const Eigen::Vector3d half = (eye + input.to_sun).normalized();
        const double eye_cosine = std::max(1e-3, double{hop.cosine});
        const double lobe = surface.lobe(half.dot(normal), eye_cosine, sun_cosine);
        sent[n] += half_way[n].mirrored * lobe * std::numbers::pi * sunlight * light.sun[n];
    }
    return sent;
}

}  // namespace

double hop_radiance(const Hops& hops, std::size_t pixel, std::span<const Plume> plumes,
                    double observer_height, const Band& band, const RadianceInput& input,
                    const SunField* scattered) {
    const std::span<const Hop> list(&hops.hop[hops.row[pixel]],
                                    hops.row[pixel + 1] - hops.row[pixel]);
    const std::size_t nodes = band.node_um.size();
    const double eye_km = input.ground_height_km + 1e-3 * observer_height;
    std::vector<std::vector<double>> filter;
    std::vector<PathSpectrum> air;
    double sum = 0.0;
    for (const Hop& hop : list) {
        std::vector<double> past(nodes, 1.0);
        const PathSpectrum* from = nullptr;
        if (hop.before >= 0) {
            const auto j = static_cast<std::size_t>(hop.before);
            const Hop& before = list[j];
            from = &air[j];
            if (before.kind == Hop::Kind::plume) {
                for (std::size_t n = 0; n < nodes; ++n) {
                    past[n] = filter[j][n] *
                              std::exp(-plumes[before.what].absorption_at(band.node_um[n]) *
                                       double{before.chord});
                }
            } else {
                const auto optics = optics_of(input.materials[input.facets.material[before.what]],
                                              band, double{before.cosine});
                for (std::size_t n = 0; n < nodes; ++n) {
                    past[n] =
                        filter[j][n] * (hop.way == Hop::Way::mirrored ? optics[n].mirrored
                                                                      : optics[n].transmittance);
                }
            }
        }
        std::vector<double> light(nodes, 0.0);
        const double height_km = input.ground_height_km + 1e-3 * double{hop.height};
        PathSpectrum path;
        if (hop.kind == Hop::Kind::sky) {
            const Eigen::Vector3d to = hop.direction.cast<double>();
            const double from_km = hop.straight ? eye_km : height_km;
            light = background_at(input, from_km, zenith_deg(to), band.node_um);
            if (scattered) {
                const double azimuth = degrees(std::atan2(to.x(), to.y())) -
                                       degrees(std::atan2(input.to_sun.x(), input.to_sun.y()));
                const auto sunlit =
                    scattered_background_at(input, *scattered, from_km, zenith_deg(to), azimuth);
                for (std::size_t n = 0; n < nodes; ++n) light[n] += sunlit[n];
            }
            for (std::size_t n = 0; n < nodes; ++n) {
                if (!hop.straight) {
                    light[n] *= from->transmittance[n];
                } else if (from) {
                    light[n] -= from->radiance[n];
                }
            }
        } else {
            path = path_at_nodes(input.atmosphere,
                                 chord(eye_km, height_km, 1e-3 * double{hop.range}), band.node_um);
            if (scattered && hop.straight) {
                const Eigen::Vector3d to = hop.direction.cast<double>();
                const double azimuth = degrees(std::atan2(to.x(), to.y())) -
                                       degrees(std::atan2(input.to_sun.x(), input.to_sun.y()));
                const auto haze = scattered->path(
                    chord(eye_km, height_km, 1e-3 * double{hop.range}), zenith_deg(to), azimuth);
                for (std::size_t n = 0; n < nodes; ++n) path.radiance[n] += haze[n];
            }
            std::vector<double> sent(nodes, 0.0);
            if (hop.kind == Hop::Kind::plume) {
                const Plume& plume = plumes[hop.what];
                for (std::size_t n = 0; n < nodes; ++n) {
                    sent[n] =
                        -std::expm1(-plume.absorption_at(band.node_um[n]) * double{hop.chord}) *
                        planck(band.node_um[n], plume.temperature);
                }
            } else {
                const Material& material = input.materials[input.facets.material[hop.what]];
                if (hop.closed || !material.needs_rays()) {
                    const auto terms =
                        leaving_radiance(input, FacetId{hop.what}, band.node_um, 2, scattered);
                    for (const auto& term : terms) {
                        for (std::size_t n = 0; n < nodes; ++n) sent[n] += term[n];
                    }
                } else {
                    sent = open_facet(hop, material, band, input, scattered);
                }
            }
            for (std::size_t n = 0; n < nodes; ++n) {
                light[n] = path.transmittance[n] * sent[n] + path.radiance[n] -
                           (from ? from->radiance[n] : 0.0);
            }
        }
        for (std::size_t n = 0; n < nodes; ++n) {
            sum += double{hop.weight} * band.weight[n] * past[n] * light[n];
        }
        filter.push_back(std::move(past));
        air.push_back(std::move(path));
    }
    return sum;
}

}  // namespace diurna
