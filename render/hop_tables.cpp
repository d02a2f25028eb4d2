#include "render/hop_tables.hpp"

#include <algorithm>
#include <cmath>

#include "materials/planck.hpp"
#include "render/scene_basis.hpp"
#include "terrain/parallel.hpp"

namespace diurna {

namespace {

PathExtent extent_of(const Hops& hops, double observer_height, double ground_height_km) {
    float near = 1e30f, far = 0.0f, low = 1e30f, high = -1e30f;
    for (const Hop& hop : hops.hop) {
        near = std::min(near, hop.range);
        far = std::max(far, hop.range);
        low = std::min(low, hop.height);
        high = std::max(high, hop.height);
    }
    return {.observer_height_km = ground_height_km + 1e-3 * observer_height,
            .least_range_km = std::max(1e-6, 1e-3 * double(near)),
            .most_range_km = std::max(1e-3, 1e-3 * double(far)),
            .least_height_km = ground_height_km + 1e-3 * double(low),
            .most_height_km = ground_height_km + 1e-3 * double(high)};
}

/// Heights from which mirrors see the sky, their mean [km].
double mirror_height_km(const Hops& hops, double ground_height_km) {
    double sum = 0.0, count = 0.0;
    for (const Hop& hop : hops.hop) {
        if (hop.kind != Hop::Kind::sky || hop.straight) continue;
        sum += ground_height_km + 1e-3 * double{hop.height};
        count += 1.0;
    }
    return count > 0.0 ? sum / count : ground_height_km;
}

}  // namespace

void HopTables::prepare(std::size_t b, double eye_km) {
    const Band& one_band = bands[b];
    BandLight& light = band[b];
    light.scattered = scattered_sun(input, one_band.node_um);
    const SunField* field = light.scattered ? &*light.scattered : nullptr;
    for (std::size_t h = 0; h < 3; ++h) {
        light.light[h] = light_at(input, lit.height_km[h], one_band.node_um, field);
    }
    light.optics = node_optics(one_band, input.materials, lit.material_used);
    light.channels = channels_of(one_band);
    light.basis = scene_basis(one_band, light.optics, light.light, lit.worth[b], state.extent);
    const std::vector<double> one(one_band.node_um.size(), 1.0);
    const auto sums = [&](std::span<const double> spectrum) {
        return channel_sums(one_band, light.channels, one, spectrum);
    };
    for (std::size_t h = 0; h < 3; ++h) light.sun[h] = sums(light.light[h].sun);
    light.angle.resize(input.materials.size());
    light.room.resize(input.materials.size());
    for (std::size_t m = 0; m < input.materials.size(); ++m) {
        const Material& material = input.materials[MaterialId{static_cast<std::uint16_t>(m)}];
        if (!lit.material_used[m] || !material.needs_rays()) continue;
        light.angle[m] =
            AngleTable(material, one_band, light.channels, double{state.extent.middle()});
        if (!light.optics[m].room.empty()) light.room[m] = sums(light.optics[m].room);
    }
    for (const Plume& plume : plumes) {
        std::vector<double> absorption(one.size()), glow(one.size());
        for (std::size_t n = 0; n < one.size(); ++n) {
            absorption[n] = plume.absorption_at(one_band.node_um[n]);
            glow[n] = planck(one_band.node_um[n], plume.temperature);
        }
        light.glow.push_back(sums(glow));
        light.absorption.push_back(sums(absorption));
        const std::vector<float> width = sums(one);
        for (std::size_t c = 0; c < light.channels.size(); ++c) {
            light.absorption.back()[c] /= width[c] > 0.0f ? width[c] : 1.0f;
        }
    }
    SkyTable::Extent straight, mirrored;
    for (const Hop& hop : hops.hop) {
        if (hop.kind != Hop::Kind::sky) continue;
        (hop.straight ? straight : mirrored).include(hop.direction.cast<double>());
    }
    if (straight.any()) {
        light.from_eye.emplace(input, one_band, light.channels, field, eye_km, straight);
    }
    if (mirrored.any()) {
        light.from_mirror.emplace(input, one_band, light.channels, field,
                                  mirror_height_km(hops, input.ground_height_km), mirrored);
    }
}

/// What the facets of the hops send and receive.
void HopTables::send(int bounces, double tolerance) {
    std::vector<SpectralBasis> basis;
    std::vector<std::vector<NodeOptics>> optics;
    std::vector<std::array<Light, 3>> light;
    std::vector<BounceOptions> options;
    for (std::size_t b = 0; b < bands.size(); ++b) {
        basis.push_back(band[b].basis);
        optics.push_back(band[b].optics);
        light.push_back(band[b].light);
        options.push_back(bounce_options(bands[b], state.extent, light[b][2],
                                         band[b].scattered.has_value(), bounces, tolerance));
        band[b].facet.resize(facets.size());
    }
    const LightTables tables = light_tables(
        bands, basis, optics, light, temperature_grid(state.extent.coldest, state.extent.hottest));
    const SentLight sent(lit, state, tables, options);
    for_each_block(facets.size(), 64, [&](std::size_t begin, std::size_t end) {
        std::vector<float> black(tables.lanes), around(tables.lanes);
        for (std::size_t u = begin; u < end; ++u) {
            const std::size_t i = lit.target[u];
            black_modes(tables, state.temperature[i], black.data());
            sent.around(i, black.data(), around.data());
            const std::array<float, 3> up = height_weights(lit.height[i]);
            const double open = double{lit.sky_view[i]}, sunlight = double{state.sunlight[i]};
            const Material& material = input.materials[lit.material[i]];
            for (std::size_t b = 0; b < bands.size(); ++b) {
                const Band& one = bands[b];
                BandLight& here = band[b];
                const NodeOptics& o = here.optics[index(lit.material[i])];
                Eigen::VectorXd modes(static_cast<Eigen::Index>(basis[b].size()));
                for (std::size_t k = 0; k < basis[b].size(); ++k) {
                    modes[static_cast<Eigen::Index>(k)] = double{around[tables.first[b] + k]};
                }
                const Eigen::VectorXd nodes = basis[b].mode * modes;
                const std::size_t n = here.channels.padded();
                std::vector<float>& value = here.facet[u].value;
                value.assign(FacetLight::parts * n, 0.0f);
                for (std::size_t c = 0; c < here.channels.size(); ++c) {
                    std::array<double, FacetLight::parts> sum{};
                    for (std::size_t k = here.channels.first[c]; k < here.channels.first[c + 1];
                         ++k) {
                        const auto at = static_cast<Eigen::Index>(k);
                        const double w = one.weight[k];
                        const double heat = w * planck(one.node_um[k], state.temperature[i]);
                        const double near = basis[b].root_weight[at] * nodes[at];
                        double sky = 0.0, sun = 0.0;
                        for (std::size_t h = 0; h < 3; ++h) {
                            sky += w * open * double{up[h]} * light[b][h].sky[k];
                            sun += w * sunlight * double{up[h]} * light[b][h].sun[k];
                        }
                        sum[FacetLight::black] += heat;
                        sum[FacetLight::open] += sky;
                        sum[FacetLight::around] += near;
                        sum[FacetLight::emitted] += o.emissivity[k] * heat;
                        sum[FacetLight::sun] += o.reflectance[k] * sun;
                        sum[FacetLight::sky] += o.reflectance[k] * sky;
                        sum[FacetLight::surroundings] += o.reflectance[k] * near;
                        sum[FacetLight::behind] += o.room.empty() || material.see_through
                                                       ? o.transmittance[k] * heat
                                                       : w * o.room[k];
                    }
                    for (std::size_t p = 0; p < FacetLight::parts; ++p) {
                        value[p * n + c] = static_cast<float>(sum[p]);
                    }
                }
            }
        }
    });
}

HopTables::HopTables(const Hops& hops_of, std::span<const Plume> plumes_of, double observer_height,
                     std::span<const Band> bands_of, const RadianceInput& input_of, int bounces,
                     double tolerance)
    : hops(hops_of), input(input_of), plumes(plumes_of), bands(bands_of.begin(), bands_of.end()) {
    facets = facets_of(hops);
    for (const Hop& hop : hops.hop) {
        const auto at = std::lower_bound(facets.begin(), facets.end(), FacetId{hop.what});
        place.push_back(static_cast<std::uint32_t>(at - facets.begin()));
    }
    lit = lit_facets(input, facets, bands);
    state = lit_state(input, lit);
    band.resize(bands.size());
    const double eye_km = input.ground_height_km + 1e-3 * observer_height;
    for (std::size_t b = 0; b < bands.size(); ++b) {
        prepare(b, eye_km);
        channels.push_back(band[b].channels);
        probe.push_back(probes(bands[b], channels[b], input, band[b].light[1], state.extent));
    }
    if (!facets.empty()) send(bounces, tolerance);
    const PathExtent extent = extent_of(hops, observer_height, input.ground_height_km);
    path.emplace(input.atmosphere, extent, bands, channels, probe, tolerance);
    for (std::size_t b = 0; b < bands.size(); ++b) {
        BandLight& light = band[b];
        if (!light.scattered) continue;
        ScatteredPath::Angles angles{180.0, 0.0};
        for (const Hop& hop : hops.hop) {
            const double angle = light.angle_deg(hop.direction, input.to_sun);
            angles.least_deg = std::min(angles.least_deg, angle);
            angles.most_deg = std::max(angles.most_deg, angle);
        }
        light.haze.emplace(*light.scattered, bands[b], extent, angles);
    }
}

}  // namespace diurna
