#include "render/hop_shading.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "materials/microfacet.hpp"
#include "materials/planck.hpp"
#include "materials/units.hpp"
#include "render/leaving.hpp"
#include "render/lit_facets.hpp"
#include "render/node_optics.hpp"
#include "render/path_table.hpp"
#include "render/scattered_path.hpp"
#include "render/scene_basis.hpp"
#include "render/sky_table.hpp"
#include "render/spectral_basis.hpp"
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

/// Optics of one material in channels over the cosine of the angle, linear between nodes that
/// crowd at grazing angles.
class AngleTable {
 public:
    AngleTable() = default;
    AngleTable(const Material& material, const Band& band, const Channels& channels,
               double temperature)
        : padded_(channels.padded()) {
        values_.assign(nodes * parts * padded_, 0.0f);
        hemisphere_.assign(padded_, 0.0f);
        std::vector<double> shape(band.node_um.size());
        for (std::size_t n = 0; n < shape.size(); ++n) {
            shape[n] = band.weight[n] * planck(band.node_um[n], temperature) + 1e-300;
        }
        // An index of refraction that is one number everywhere is looked up once.
        const auto* glossy = std::get_if<Glossy>(&material.finish);
        std::vector<double> known;
        if (glossy && (glossy->metal || (is_flat(glossy->index) && is_flat(glossy->extinction)))) {
            known.resize(nodes);
            for_each_index(
                nodes,
                [&](std::size_t k) {
                    known[k] = interface_reflectance(material.finish, band.node_um[0], cosine(k));
                },
                1);
        }
        for_each_index(
            channels.size(),
            [&](std::size_t c) {
                double total = 0.0;
                for (std::size_t n = channels.first[c]; n < channels.first[c + 1]; ++n) {
                    total += shape[n];
                }
                // An index of refraction is one number in a channel.
                const double middle = band.node_um[(channels.first[c] + channels.first[c + 1]) / 2];
                const double normal =
                    interface_reflectance(material.finish, middle, laboratory_cosine);
                for (std::size_t k = 0; k < nodes; ++k) {
                    const double here =
                        known.empty() ? interface_reflectance(material.finish, middle, cosine(k))
                                      : known[k];
                    float* at = &values_[k * parts * padded_ + c];
                    for (std::size_t n = channels.first[c]; n < channels.first[c + 1]; ++n) {
                        const double share = shape[n] / total;
                        const DirectionalOptics o =
                            directional_optics(material, band.node_um[n], cosine(k), here, normal);
                        at[0] += static_cast<float>(share * o.mirrored);
                        at[padded_] += static_cast<float>(share * o.diffuse);
                        at[2 * padded_] += static_cast<float>(share * o.transmittance);
                    }
                }
                // ∫ diffuse 2 cosθ d cosθ with cosθ = u², nodes equal in u.
                for (std::size_t k = 0; k < nodes; ++k) {
                    const double u = double(k) / double(nodes - 1);
                    const double ends = k == 0 || k + 1 == nodes ? 0.5 : 1.0;
                    hemisphere_[c] +=
                        static_cast<float>(ends * 4.0 * u * u * u / double(nodes - 1)) *
                        values_[(k * parts + 1) * padded_ + c];
                }
            },
            1);
        if (glossy) roughness = glossy->roughness;
    }
    /// mirrored, diffuse, transmittance at a channel.
    struct Place {
        const float *low, *high;
        float t;
        std::size_t padded;
        float mirrored(std::size_t c) const { return low[c] + t * (high[c] - low[c]); }
        float diffuse(std::size_t c) const { return mirrored(padded + c); }
        float transmittance(std::size_t c) const { return mirrored(2 * padded + c); }
    };
    Place at(double cosine_of) const {
        const double u = std::sqrt(std::clamp(cosine_of, 0.0, 1.0)) * double(nodes - 1);
        const std::size_t k = std::min(nodes - 2, static_cast<std::size_t>(u));
        const float* low = &values_[k * parts * padded_];
        return {low, low + parts * padded_, static_cast<float>(u - double(k)), padded_};
    }
    float mean_diffuse(std::size_t c) const { return hemisphere_[c]; }
    double roughness = -1.0;  // of the mirrored lobe; negative: none

 private:
    static constexpr std::size_t nodes = 128, parts = 3;
    static bool is_flat(const Spectrum& s) {
        return std::all_of(s.value.begin(), s.value.end(),
                           [&](double x) { return x == s.value.front(); });
    }
    static double cosine(std::size_t k) {
        const double u = double(k) / double(nodes - 1);
        return u * u;
    }
    std::size_t padded_ = 0;
    std::vector<float> values_;  // (node, part, channel)
    std::vector<float> hemisphere_;
};

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

/// What a facet of the hops sends and receives, in channels.
struct FacetLight {
    enum Part { black, open, around, emitted, sun, sky, surroundings, behind, parts };
    std::vector<float> value;  // (part, channel): black body, light of the sky and of the
                               // surroundings on it, then the terms of a closed facet
};

constexpr std::array<std::pair<Term, FacetLight::Part>, 5> closed_terms = {
    {{Term::emitted, FacetLight::emitted},
     {Term::sun, FacetLight::sun},
     {Term::sky, FacetLight::sky},
     {Term::surroundings, FacetLight::surroundings},
     {Term::behind, FacetLight::behind}}};

/// All that one band needs.
struct BandLight {
    std::optional<SunField> scattered;
    std::array<Light, 3> light;  // at the heights of LitFacets
    std::vector<NodeOptics> optics;
    Channels channels;
    SpectralBasis basis;
    std::vector<FacetLight> facet;               // (facet of the hops)
    std::vector<AngleTable> angle;               // (material), where needed
    std::vector<std::vector<float>> room;        // (material)(channel) τ B of the room behind
    std::vector<std::vector<float>> absorption;  // (plume)(channel) [m⁻¹]
    std::vector<std::vector<float>> glow;        // (plume)(channel) B(T)
    std::array<std::vector<float>, 3> sun;       // (height)(channel)
    std::optional<SkyTable> from_eye, from_mirror;
    std::optional<ScatteredPath> haze;  // sunlight scattered before places on the line of sight
    float angle_deg(const Eigen::Vector3f& direction, const Eigen::Vector3d& to_sun) const {
        const double cosine = direction.cast<double>().dot(to_sun);
        return static_cast<float>(degrees(std::acos(std::clamp(cosine, -1.0, 1.0))));
    }
};

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

struct HopLight::State {
    const Hops& hops;
    const RadianceInput& input;
    std::span<const Plume> plumes;
    std::vector<Band> bands;
    std::vector<FacetId> facets{};       // in the hops
    std::vector<std::uint32_t> place{};  // (hop) index of its facet above
    LitFacets lit{};
    LitState state{};
    std::vector<Channels> channels{};
    std::vector<std::vector<std::vector<float>>> probes{};
    std::vector<BandLight> band{};
    std::optional<PathTable> path{};

    void prepare(std::size_t b, double eye_km);
    void send(int bounces, double tolerance);
    void add_pixel(std::size_t b, std::size_t k, std::span<std::vector<float>> planes) const;
    void own_light(const BandLight& light, const Hop& hop, std::uint32_t facet,
                   std::span<float> out) const;
};

void HopLight::State::prepare(std::size_t b, double eye_km) {
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
void HopLight::State::send(int bounces, double tolerance) {
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

HopLight::HopLight(const Hops& hops, std::span<const Plume> plumes, double observer_height,
                   std::span<const Band> bands, const RadianceInput& input, int bounces,
                   double tolerance)
    : state_(std::make_unique<State>(State{
          .hops = hops, .input = input, .plumes = plumes, .bands = {bands.begin(), bands.end()}})) {
    State& s = *state_;
    s.facets = facets_of(hops);
    for (const Hop& hop : hops.hop) {
        const auto at = std::lower_bound(s.facets.begin(), s.facets.end(), FacetId{hop.what});
        s.place.push_back(static_cast<std::uint32_t>(at - s.facets.begin()));
    }
    s.lit = lit_facets(input, s.facets, bands);
    s.state = lit_state(input, s.lit);
    s.band.resize(bands.size());
    const double eye_km = input.ground_height_km + 1e-3 * observer_height;
    for (std::size_t b = 0; b < bands.size(); ++b) {
        s.prepare(b, eye_km);
        s.channels.push_back(s.band[b].channels);
        s.probes.push_back(
            probes(bands[b], s.channels[b], input, s.band[b].light[1], s.state.extent));
    }
    if (!s.facets.empty()) s.send(bounces, tolerance);
    const PathExtent extent = extent_of(hops, observer_height, input.ground_height_km);
    s.path.emplace(input.atmosphere, extent, s.bands, s.channels, s.probes, tolerance);
    for (std::size_t b = 0; b < bands.size(); ++b) {
        BandLight& light = s.band[b];
        if (!light.scattered) continue;
        ScatteredPath::Angles angles{180.0, 0.0};
        for (const Hop& hop : hops.hop) {
            const double angle = light.angle_deg(hop.direction, input.to_sun);
            angles.least_deg = std::min(angles.least_deg, angle);
            angles.most_deg = std::max(angles.most_deg, angle);
        }
        light.haze.emplace(*light.scattered, s.bands[b], extent, angles);
    }
}

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
