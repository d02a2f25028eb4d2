#include "render/rays/tables.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"
#include "render/light/scene_basis.hpp"

namespace diurna {

namespace {

PathExtent extent_of(const Hops& hops, double observer_height, double ground_height_km) {
    float near = 1e30f, far = 0.0f, low = 1e30f, high = -1e30f;
    for (const Hop& hop : hops.hop) {
        if (hop.kind == Hop::Kind::sky) continue;
        near = std::min(near, hop.range);
        far = std::max(far, hop.range);
        low = std::min(low, hop.height);
        high = std::max(high, hop.height);
    }
    if (far == 0.0f) near = low = high = 0.0f;  // nothing but sky
    return {.observer_height_km = ground_height_km + 1e-3 * observer_height,
            .least_range_km = std::max(1e-6, 1e-3 * double(near)),
            .most_range_km = std::max(1e-3, 1e-3 * double(far)),
            .least_height_km = ground_height_km + 1e-3 * double(low),
            .most_height_km = ground_height_km + 1e-3 * double(high)};
}

/// Height from which mirrors see the sky, its mean [km].
double mirror_height_km(const Hops& hops, double ground_height_km) {
    double sum = 0.0, count = 0.0;
    for (const Hop& hop : hops.hop) {
        if (hop.kind != Hop::Kind::sky || hop.straight) continue;
        sum += ground_height_km + 1e-3 * double{hop.height};
        count += 1.0;
    }
    return count > 0.0 ? sum / count : ground_height_km;
}

/// Puts the channels of each band, `row(band)`, side by side.
template <class Row>
std::vector<float> side_by_side(const Lanes& lanes, std::size_t bands, const Row& row) {
    std::vector<float> all(lanes.size(), 0.0f);
    for (std::size_t b = 0; b < bands; ++b) {
        const std::vector<float> one = row(b);
        std::copy(one.begin(), one.end(), all.begin() + std::ptrdiff_t(lanes.first[b]));
    }
    return all;
}

std::vector<float> sums(const HopBand& of, std::span<const double> spectrum) {
    const std::vector<double> one(of.band.node_um.size(), 1.0);
    return channel_sums(of.band, of.channels, one, spectrum);
}

/// Absorption of a plume, its mean in each channel.
std::vector<float> absorption_of(const HopBand& of, const Plume& plume) {
    std::vector<double> k;
    for (const double um : of.band.node_um) k.push_back(plume.absorption_at(um));
    std::vector<float> mean = sums(of, k);
    const std::vector<float> width = sums(of, std::vector<double>(k.size(), 1.0));
    for (std::size_t c = 0; c < of.channels.size(); ++c) {
        mean[c] /= width[c] > 0.0f ? width[c] : 1.0f;
    }
    return mean;
}

}  // namespace

HopTables::HopTables(const Hops& hops_of, std::span<const Plume> plumes, double observer_height,
                     std::span<const Band> bands, const RadianceInput& input_of, int bounces,
                     double tolerance)
    : hops(hops_of), input(input_of), plumes_(plumes), bands_(bands.begin(), bands.end()) {
    const std::vector<FacetId> facets = facets_of(hops);
    for (const Hop& hop : hops.hop) {
        const auto at = std::lower_bound(facets.begin(), facets.end(), FacetId{hop.what});
        place.push_back(static_cast<std::uint32_t>(at - facets.begin()));
    }
    lit = lit_facets(input, facets, bands);
    state = lit_state(input, lit);
    band.resize(bands.size());
    for_each_index(
        band.size(),
        [&](std::size_t b) {
            band[b].band = bands_[b];
            prepare(band[b]);
            band[b].basis =
                scene_basis(bands_[b], band[b].optics, band[b].light, lit.worth[b], state.extent);
        },
        1);
    for (const HopBand& one : band) {
        channels_.push_back(one.channels);
        probe_.push_back(one.probe);
    }
    lanes = lanes_of(channels_);
    look_up(observer_height);
    if (!facets.empty()) send(facets, bounces, tolerance);
    const PathExtent extent = extent_of(hops, observer_height, input.ground_height_km);
    fill_air(extent, tolerance);
    ScatteredPath::Angles angles{180.0, 0.0};
    for (const Hop& hop : hops.hop) {
        const double from_sun = angle_from_sun(hop.direction);
        angles.least_deg = std::min(angles.least_deg, from_sun);
        angles.most_deg = std::max(angles.most_deg, from_sun);
    }
    for (HopBand& one : band) {
        if (one.scattered) one.haze.emplace(*one.scattered, one.band, extent, angles);
    }
}

double HopTables::angle_from_sun(const Eigen::Vector3f& direction) const {
    const double cosine = direction.cast<double>().dot(input.to_sun);
    return degrees(std::acos(std::clamp(cosine, -1.0, 1.0)));
}

/// What depends on one band alone.
void HopTables::prepare(HopBand& of) {
    of.scattered = scattered_sun(input, of.band.node_um);
    const SunField* field = of.scattered ? &*of.scattered : nullptr;
    for (std::size_t h = 0; h < 3; ++h) {
        of.light[h] = light_at(input, lit.height_km[h], of.band.node_um, field);
    }
    of.optics = node_optics(of.band, input.materials, lit.material_used);
    of.channels = channels_of(of.band);
    of.probe = probes(of.band, of.channels, input, of.light[1], state.extent);
}

/// Sunlight, materials by angle, plumes and sky in lanes.
void HopTables::look_up(double observer_height) {
    const auto lay = [&](const auto& row) { return side_by_side(lanes, band.size(), row); };
    for (std::size_t h = 0; h < 3; ++h) {
        sun[h] = lay([&](std::size_t b) { return sums(band[b], band[b].light[h].sun); });
    }
    angle.resize(input.materials.size());
    room.resize(input.materials.size());
    for (std::size_t m = 0; m < input.materials.size(); ++m) {
        const Material& material = input.materials[MaterialId{static_cast<std::uint16_t>(m)}];
        if (!lit.material_used[m] || !material.needs_rays()) continue;
        angle[m] = AngleTable(material, bands_, channels_, lanes, double{state.extent.middle()});
        if (band.empty() || band[0].optics[m].room.empty()) continue;
        room[m] = lay([&](std::size_t b) { return sums(band[b], band[b].optics[m].room); });
    }
    for (const Plume& plume : plumes_) {
        absorption.push_back(lay([&](std::size_t b) { return absorption_of(band[b], plume); }));
        glow.push_back(lay([&](std::size_t b) {
            std::vector<double> heat;
            for (const double um : bands_[b].node_um) {
                heat.push_back(planck(um, plume.temperature));
            }
            return sums(band[b], heat);
        }));
    }
    SkyTable::Extent straight, mirrored;
    for (const Hop& hop : hops.hop) {
        if (hop.kind != Hop::Kind::sky) continue;
        (hop.straight ? straight : mirrored).include(hop.direction.cast<double>(), input.to_sun);
    }
    const double eye_km = input.ground_height_km + 1e-3 * observer_height;
    for (HopBand& one : band) {
        const SunField* field = one.scattered ? &*one.scattered : nullptr;
        if (straight.any()) {
            one.from_eye.emplace(input, one.band, one.channels, field, eye_km, straight);
        }
        if (mirrored.any()) {
            one.from_mirror.emplace(input, one.band, one.channels, field,
                                    mirror_height_km(hops, input.ground_height_km), mirrored);
        }
    }
}

/// What the facets of the hops send and receive.
void HopTables::send(std::span<const FacetId> facets, int bounces, double tolerance) {
    std::vector<SpectralBasis> basis;
    std::vector<std::vector<NodeOptics>> optics;
    std::vector<std::array<Light, 3>> light;
    std::vector<BounceOptions> options;
    for (const HopBand& one : band) {
        basis.push_back(one.basis);
        optics.push_back(one.optics);
        light.push_back(one.light);
        options.push_back(bounce_options(one.band, state.extent, one.light[2],
                                         one.scattered.has_value(), bounces, tolerance));
    }
    const LightTables tables = light_tables(
        bands_, basis, optics, light, temperature_grid(state.extent.coldest, state.extent.hottest));
    const SentLight sent(lit, state, tables, options);
    facet.assign(facets.size() * facet_parts * lanes.size(), 0.0f);
    for_each_block(facets.size(), 16, [&](std::size_t begin, std::size_t end) {
        std::vector<float> black(tables.lanes), around(tables.lanes);
        for (std::size_t u = begin; u < end; ++u) {
            const std::size_t i = lit.target[u];
            black_modes(tables, state.temperature[i], black.data());
            sent.around(i, black.data(), around.data());
            for (std::size_t b = 0; b < band.size(); ++b) {
                fill_facet(u, b, std::span(around).subspan(tables.first[b], basis[b].size()));
            }
        }
    });
}

/// A facet's parts in the lanes of a band, from the light of its surroundings in modes.
void HopTables::fill_facet(std::size_t u, std::size_t b, std::span<const float> around) {
    const HopBand& of = band[b];
    const std::size_t i = lit.target[u];
    const NodeOptics& o = of.optics[index(lit.material[i])];
    const bool room_behind = !o.room.empty() && !input.materials[lit.material[i]].see_through;
    const std::array<float, 3> up = height_weights(lit.height[i]);
    const double open = double{lit.sky_view[i]}, sunlight = double{state.sunlight[i]};
    Eigen::VectorXd modes(static_cast<Eigen::Index>(around.size()));
    for (std::size_t k = 0; k < around.size(); ++k) {
        modes[static_cast<Eigen::Index>(k)] = double{around[k]};
    }
    const Eigen::VectorXd nodes = of.basis.mode * modes;
    for (std::size_t c = 0; c < of.channels.size(); ++c) {
        std::array<double, facet_parts> sum{};
        const auto part = [&](FacetPart p) -> double& { return sum[static_cast<std::size_t>(p)]; };
        for (std::size_t k = of.channels.first[c]; k < of.channels.first[c + 1]; ++k) {
            const auto at = static_cast<Eigen::Index>(k);
            const double w = of.band.weight[k];
            const double heat = w * planck(of.band.node_um[k], state.temperature[i]);
            const double near = of.basis.root_weight[at] * nodes[at];
            double of_sky = 0.0, of_sun = 0.0;
            for (std::size_t h = 0; h < 3; ++h) {
                of_sky += w * open * double{up[h]} * of.light[h].sky[k];
                of_sun += w * sunlight * double{up[h]} * of.light[h].sun[k];
            }
            part(FacetPart::black) += heat;
            part(FacetPart::open) += of_sky;
            part(FacetPart::around) += near;
            part(FacetPart::emitted) += o.emissivity[k] * heat;
            part(FacetPart::sun) += o.reflectance[k] * of_sun;
            part(FacetPart::sky) += o.reflectance[k] * of_sky;
            part(FacetPart::surroundings) += o.reflectance[k] * near;
            part(FacetPart::behind) += room_behind ? w * o.room[k] : o.transmittance[k] * heat;
        }
        part(FacetPart::closed) = part(FacetPart::emitted) + part(FacetPart::sun) +
                                  part(FacetPart::sky) + part(FacetPart::surroundings) +
                                  part(FacetPart::behind);
        for (std::size_t p = 0; p < facet_parts; ++p) {
            facet[(u * facet_parts + p) * lanes.size() + lanes.first[b] + c] =
                static_cast<float>(sum[p]);
        }
    }
}

void HopTables::fill_air(const PathExtent& extent, double tolerance) {
    path_.emplace(input.atmosphere, extent, bands_, channels_, probe_, tolerance);
    const std::size_t n = lanes.size(), nodes = path_->ranges() * path_->heights();
    air_.assign(nodes * 2 * n, 0.0f);
    for (std::size_t k = 0; k < nodes; ++k) {
        const std::size_t r = k / path_->heights(), h = k % path_->heights();
        for (std::size_t b = 0; b < band.size(); ++b) {
            float* to = &air_[k * 2 * n + lanes.first[b]];
            std::copy_n(path_->transmittance(b, r, h), channels_[b].padded(), to);
            std::copy_n(path_->air(b, r, h), channels_[b].padded(), to + n);
        }
    }
}

void HopTables::air_to(float range, float height_km, float* transmittance, float* radiance) const {
    const std::size_t n = lanes.size();
    std::fill_n(transmittance, n, 0.0f);
    std::fill_n(radiance, n, 0.0f);
    const Stencil across = path_->range_stencil(range);
    const std::array<float, 5> up = path_->height_weights(height_km);
    for (std::size_t i = 0; i < across.weight.size(); ++i) {
        for (std::size_t h = 0; h < path_->heights(); ++h) {
            const float weight = across.weight[i] * up[h];
            const float* t = &air_[((across.start + i) * path_->heights() + h) * 2 * n];
            const float* l = t + n;
            for (std::size_t c = 0; c < n; ++c) transmittance[c] += weight * t[c];
            for (std::size_t c = 0; c < n; ++c) radiance[c] += weight * l[c];
        }
    }
}

void HopTables::sky_towards(const Eigen::Vector3d& direction, bool straight,
                            std::span<float> out) const {
    const auto table = [&](std::size_t b) -> const SkyTable& {
        return straight ? *band[b].from_eye : *band[b].from_mirror;
    };
    const SkyTable::Place at = table(0).place(direction);
    for (std::size_t b = 0; b < band.size(); ++b) {
        table(b).at(at, out.subspan(lanes.first[b], channels_[b].padded()));
    }
}

}  // namespace diurna
