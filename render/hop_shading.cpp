#include "render/hop_shading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/microfacet.hpp"
#include "materials/units.hpp"
#include "render/hop_tables.hpp"
#include "terrain/parallel.hpp"

namespace diurna {

namespace {

/// Transmittance and radiance of the air to a place, in channels.
struct Air {
    std::vector<float> transmittance, radiance;
    void at(const PathTable& path, std::size_t band, std::size_t padded, float range,
            double height_km) {
        transmittance.assign(padded, 0.0f);
        radiance.assign(padded, 0.0f);
        const Stencil across = path.range_stencil(range);
        std::array<float, 5> up{}, slope{};
        path.height_weights(static_cast<float>(height_km), up, slope);
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t h = 0; h < path.heights(); ++h) {
                const float weight = across.weight[i] * up[h];
                const float* t = path.transmittance(band, across.start + i, h);
                const float* l = path.air(band, across.start + i, h);
                for (std::size_t c = 0; c < padded; ++c) {
                    transmittance[c] += weight * t[c];
                    radiance[c] += weight * l[c];
                }
            }
        }
    }
};

}  // namespace

struct HopLight::State : HopTables {
    using HopTables::HopTables;
    void add_pixel(std::size_t b, std::size_t k, std::span<std::vector<float>> planes) const;
    void own_light(const BandLight& light, const Hop& hop, std::uint32_t facet,
                   std::span<float> out) const;
};

HopLight::HopLight(const Hops& hops, std::span<const Plume> plumes, double observer_height,
                   std::span<const Band> bands, const RadianceInput& input, int bounces,
                   double tolerance)
    : state_(std::make_unique<State>(hops, plumes, observer_height, bands, input, bounces,
                                     tolerance)) {}

HopLight::~HopLight() = default;

/// What a facet sends at the angle it is seen at, but for what it mirrors and lets through, into
/// (term, channel).
void HopLight::State::own_light(const BandLight& light, const Hop& hop, std::uint32_t facet,
                                std::span<float> out) const {
    const std::size_t n = light.channels.padded(), f = hop.what, i = lit.target[facet];
    const MaterialId id = input.facets.material[f];
    const Material& material = input.materials[id];
    const AngleTable& table = light.angle[index(id)];
    const auto term = [&](Term t) { return out.subspan(static_cast<std::size_t>(t) * n, n); };
    const auto part = [&](FacetLight::Part p) { return &light.facet[facet].value[p * n]; };
    const AngleTable::Place at = table.at(double{hop.cosine});

    const Eigen::Vector3d normal = input.facets.normal[f].cast<double>();
    const double sun_cosine = normal.dot(input.to_sun);
    const float sunlight = state.sunlight[i];
    const AngleTable::Place towards_sun = table.at(std::max(0.0, sun_cosine));
    float glint = 0.0f;
    AngleTable::Place at_half = at;
    if (sunlight > 0.0f && table.roughness >= 0.0) {
        // The sun's disc of 0.2666° widens the lobe: half of that for the half vector.
        const Microfacets surface{.roughness = std::hypot(table.roughness, 0.5 * radians(0.2666))};
        const Eigen::Vector3d eye = -hop.direction.cast<double>();
        const Eigen::Vector3d half = (eye + input.to_sun).normalized();
        const double eye_cosine = std::max(1e-3, double{hop.cosine});
        at_half = table.at(std::max(0.0, half.dot(eye)));
        if (normal.dot(eye) > 0.0) {
            glint = static_cast<float>(
                surface.density(half.dot(normal)) * surface.lit_and_seen(eye_cosine, sun_cosine) /
                (4.0 * eye_cosine * sun_cosine) * std::numbers::pi * double{sunlight});
        }
    }
    const std::array<float, 3> up = height_weights(lit.height[i]);
    const std::vector<float>& room = light.room[index(id)];
    const AngleTable::Place upright = table.at(laboratory_cosine);
    const float *black = part(FacetLight::black), *open = part(FacetLight::open),
                *around = part(FacetLight::around);
    for (std::size_t c = 0; c < light.channels.size(); ++c) {
        const float mirrored = at.mirrored(c), diffuse = at.diffuse(c);
        const float through = at.transmittance(c);
        term(Term::emitted)[c] = (1.0f - mirrored - diffuse - through) * black[c];
        term(Term::sky)[c] = diffuse * open[c];
        term(Term::surroundings)[c] = diffuse * around[c];
        term(Term::sun)[c] = 0.0f;
        if (sunlight > 0.0f) {
            const float mean = table.mean_diffuse(c);
            const float slant = mean > 0.0f ? towards_sun.diffuse(c) / mean : 0.0f;
            term(Term::sun)[c] =
                (diffuse * slant * sunlight + glint * at_half.mirrored(c)) *
                (up[0] * light.sun[0][c] + up[1] * light.sun[1][c] + up[2] * light.sun[2][c]);
        }
        // A room behind, at this angle; without one, what is behind is as warm as the facet.
        float behind = 0.0f;
        if (!material.see_through && !room.empty()) {
            const float whole = upright.transmittance(c);
            behind = whole > 0.0f ? through / whole * room[c] : 0.0f;
        } else if (!material.see_through) {
            behind = through * black[c];
        }
        term(Term::behind)[c] = behind;
    }
}

void HopLight::State::add_pixel(std::size_t b, std::size_t k,
                                std::span<std::vector<float>> planes) const {
    const BandLight& light = band[b];
    const std::size_t n = light.channels.padded();
    const std::span<const Hop> list(&hops.hop[hops.row[k]], hops.row[k + 1] - hops.row[k]);
    std::vector<float> filter(list.size() * n), total(n);
    std::vector<float> own(term_count * n);
    std::vector<Air> air(list.size());
    std::array<double, term_count> sum{};
    std::vector<float> haze(list.size(), 0.0f);
    std::vector<Term> as(list.size(), Term::path);  // what a hop's light counts as
    for (std::size_t i = 0; i < list.size(); ++i) {
        const Hop& hop = list[i];
        const std::span<float> past(&filter[i * n], n);
        const double height_km = input.ground_height_km + 1e-3 * double{hop.height};
        if (hop.before < 0) {
            std::fill(past.begin(), past.end(), 1.0f);
        } else {
            const auto j = static_cast<std::size_t>(hop.before);
            const Hop& before = list[j];
            const float* earlier = &filter[j * n];
            if (before.kind == Hop::Kind::plume) {
                const std::vector<float>& absorption = light.absorption[before.what];
                for (std::size_t c = 0; c < n; ++c) {
                    past[c] = earlier[c] * std::exp(-absorption[c] * before.chord);
                }
            } else {
                const auto at =
                    light.angle[index(input.facets.material[before.what])].at(before.cosine);
                for (std::size_t c = 0; c < n; ++c) {
                    past[c] = earlier[c] * (hop.way == Hop::Way::mirrored ? at.mirrored(c)
                                                                          : at.transmittance(c));
                }
            }
            as[i] = as[j] != Term::path             ? as[j]
                    : hop.way == Hop::Way::mirrored ? Term::surroundings
                                                    : Term::behind;
            if (as[i] == Term::surroundings && hop.kind == Hop::Kind::sky) as[i] = Term::sky;
        }
        const auto put = [&](Term own_term, std::size_t c, float value) {
            const Term t = as[i] == Term::path ? own_term : as[i];
            sum[static_cast<std::size_t>(t)] +=
                double{hop.weight} * double{past[c]} * double{value};
        };
        // What the air scatters into the line of sight since the hop before; a mirror's own way is
        // left dark.
        if (light.haze && hop.straight) {
            float passed_sun = 0.0f, all_sun = 0.0f;
            for (std::size_t c = 0; c < light.channels.size(); ++c) {
                passed_sun += past[c] * light.sun[1][c];
                all_sun += light.sun[1][c];
            }
            if (hop.kind != Hop::Kind::sky) {
                haze[i] = (*light.haze)(
                    light.haze->towards(double{light.angle_deg(hop.direction, input.to_sun)},
                                        double{hop.direction.z()}),
                    hop.range, static_cast<float>(height_km));
            }
            const float before =
                hop.before >= 0 ? haze[static_cast<std::size_t>(hop.before)] : 0.0f;
            sum[static_cast<std::size_t>(as[i])] += double{hop.weight} *
                                                    double{passed_sun / std::max(all_sun, 1e-30f)} *
                                                    double{haze[i] - before};
        }
        const Air* from = hop.before >= 0 ? &air[static_cast<std::size_t>(hop.before)] : nullptr;
        if (hop.kind == Hop::Kind::sky) {
            const SkyTable& sky = hop.straight ? *light.from_eye : *light.from_mirror;
            sky.at(hop.direction.cast<double>(), total);
            for (std::size_t c = 0; c < light.channels.size(); ++c) {
                if (hop.straight) {
                    put(Term::path, c, total[c] - (from ? from->radiance[c] : 0.0f));
                } else {
                    put(Term::path, c, total[c] * from->transmittance[c]);
                }
            }
            continue;
        }
        air[i].at(*path, b, n, hop.range, height_km);
        for (std::size_t c = 0; c < light.channels.size(); ++c) {
            put(Term::path, c, air[i].radiance[c] - (from ? from->radiance[c] : 0.0f));
        }
        if (hop.kind == Hop::Kind::plume) {
            const std::vector<float>& absorption = light.absorption[hop.what];
            for (std::size_t c = 0; c < light.channels.size(); ++c) {
                put(Term::emitted, c,
                    -std::expm1(-absorption[c] * hop.chord) * light.glow[hop.what][c] *
                        air[i].transmittance[c]);
            }
            continue;
        }
        const MaterialId id = input.facets.material[hop.what];
        const std::uint32_t facet = place[hops.row[k] + i];
        if (hop.closed || !input.materials[id].needs_rays()) {
            const std::vector<float>& value = light.facet[facet].value;
            for (const auto& [term, part] : closed_terms) {
                std::copy_n(&value[part * n], n, &own[static_cast<std::size_t>(term) * n]);
            }
        } else {
            own_light(light, hop, facet, own);
        }
        for (std::size_t t = 0; t + 1 < term_count; ++t) {
            for (std::size_t c = 0; c < light.channels.size(); ++c) {
                put(static_cast<Term>(t), c, own[t * n + c] * air[i].transmittance[c]);
            }
        }
    }
    const std::size_t pixel = hops.pixel[k];
    if (planes.size() == 1) {
        double all = 0.0;
        for (const double part : sum) all += part;
        planes[0][pixel] += static_cast<float>(all);
    } else {
        for (std::size_t t = 0; t < term_count; ++t) {
            planes[t][pixel] += static_cast<float>(sum[t]);
        }
    }
}

void HopLight::add(std::size_t band, std::span<std::vector<float>> planes) const {
    for_each_index(
        state_->hops.pixel.size(), [&](std::size_t k) { state_->add_pixel(band, k, planes); }, 64);
}

}  // namespace diurna
