#include "render/rays/shading.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "materials/base/fast_exp.hpp"
#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "materials/matter/directional_optics.hpp"
#include "materials/matter/microfacet.hpp"
#include "render/rays/tables.hpp"

namespace diurna {

namespace {

/// The terms a surface sends by itself: all but the path's.
constexpr std::size_t own_terms = term_count - 1;
constexpr std::array<FacetPart, own_terms> closed_part = {
    FacetPart::emitted, FacetPart::sun, FacetPart::sky, FacetPart::surroundings, FacetPart::behind};

/// Memory of one pixel's work, kept from pixel to pixel: rows of lanes.
struct PixelWork {
    std::vector<float> passed, transmittance, radiance;  // (hop, lane)
    std::vector<float> haze;                             // (hop, band)
    std::vector<Term> as;                                // (hop) what its light counts as
    std::vector<float> filter, own;                      // (lane), (term, lane)
    std::vector<double> sum;                             // (row, lane): terms, or one for all
};

}  // namespace

struct HopLight::State : HopTables {
    using HopTables::HopTables;

    void add_pixel(std::size_t k, PixelWork& work, std::span<std::vector<float>> planes) const;
    void pass(const Hop& before, Hop::Way way, const float* earlier, float* passed) const;
    void own_light(const Hop& hop, std::uint32_t facet_place, float* out) const;
    void add_haze(const Hop& hop, std::size_t i, float height_km, const float* passed, float* haze,
                  const float* haze_before, double* row) const;
};

HopLight::HopLight(const Hops& hops, std::span<const Plume> plumes, double observer_height,
                   std::span<const Band> bands, const RadianceInput& input, int bounces,
                   double tolerance)
    : state_(std::make_unique<State>(hops, plumes, observer_height, bands, input, bounces,
                                     tolerance)) {}

HopLight::~HopLight() = default;

/// What light is left of, past a hop.
void HopLight::State::pass(const Hop& before, Hop::Way way, const float* earlier,
                           float* passed) const {
    const std::size_t n = lanes.size();
    if (before.kind == Hop::Kind::plume) {
        const float* k = absorption[before.what].data();
        for (std::size_t c = 0; c < n; ++c) passed[c] = earlier[c] * fast_exp(-k[c] * before.chord);
        return;
    }
    const AngleTable::Place at =
        angle[index(input.facets.material[before.what])].at(double{before.cosine});
    if (way == Hop::Way::mirrored) {
        for (std::size_t c = 0; c < n; ++c) passed[c] = earlier[c] * at.mirrored(c);
    } else {
        for (std::size_t c = 0; c < n; ++c) passed[c] = earlier[c] * at.transmittance(c);
    }
}

/// What a facet sends at the angle it is seen at, but for what it mirrors and lets through, into
/// (term, lane).
void HopLight::State::own_light(const Hop& hop, std::uint32_t facet_place, float* out) const {
    const std::size_t n = lanes.size(), f = hop.what, i = lit.target[facet_place];
    const MaterialId id = input.facets.material[f];
    const bool see_through = input.materials[id].see_through;
    const AngleTable& table = angle[index(id)];
    const AngleTable::Place at = table.at(double{hop.cosine});

    const Eigen::Vector3d normal = input.facets.normal[f].cast<double>();
    const double sun_cosine = normal.dot(input.to_sun);
    const float sunlight = state.sunlight[i];
    const AngleTable::Place towards_sun = table.at(std::max(0.0, sun_cosine));
    float glint = 0.0f;
    AngleTable::Place at_half = at;
    if (sunlight > 0.0f && table.roughness() >= 0.0) {
        // The sun's disc of 0.2666° widens the lobe: half of that for the half vector.
        const Microfacets surface{.roughness =
                                      std::hypot(table.roughness(), 0.5 * radians(0.2666))};
        const Eigen::Vector3d eye = -hop.direction.cast<double>();
        const Eigen::Vector3d half = (eye + input.to_sun).normalized();
        const double eye_cosine = std::max(1e-3, double{hop.cosine});
        at_half = table.at(std::max(0.0, half.dot(eye)));
        if (normal.dot(eye) > 0.0) {
            glint = static_cast<float>(surface.lobe(half.dot(normal), eye_cosine, sun_cosine) *
                                       std::numbers::pi * double{sunlight});
        }
    }
    const auto term = [&](Term t) { return out + static_cast<std::size_t>(t) * n; };
    const float* black = part(facet_place, FacetPart::black);
    const float* open = part(facet_place, FacetPart::open);
    const float* around = part(facet_place, FacetPart::around);
    for (std::size_t c = 0; c < n; ++c) {
        term(Term::emitted)[c] =
            (1.0f - at.mirrored(c) - at.diffuse(c) - at.transmittance(c)) * black[c];
        term(Term::sky)[c] = at.diffuse(c) * open[c];
        term(Term::surroundings)[c] = at.diffuse(c) * around[c];
    }
    std::fill_n(term(Term::sun), n, 0.0f);
    if (sunlight > 0.0f) {
        const std::array<float, 3> up = height_weights(lit.height[i]);
        for (std::size_t c = 0; c < n; ++c) {
            const float mean = table.mean_diffuse(c);
            const float slant = mean > 0.0f ? towards_sun.diffuse(c) / mean : 0.0f;
            term(Term::sun)[c] = (at.diffuse(c) * slant * sunlight + glint * at_half.mirrored(c)) *
                                 (up[0] * sun[0][c] + up[1] * sun[1][c] + up[2] * sun[2][c]);
        }
    }
    // A room behind, at this angle; without one, what is behind is as warm as the facet.
    float* behind = term(Term::behind);
    std::fill_n(behind, n, 0.0f);
    if (see_through) return;
    const std::vector<float>& of_room = room[index(id)];
    const AngleTable::Place upright = table.at(laboratory_cosine);
    for (std::size_t c = 0; c < n; ++c) {
        if (of_room.empty()) {
            behind[c] = at.transmittance(c) * black[c];
        } else if (upright.transmittance(c) > 0.0f) {
            behind[c] = at.transmittance(c) / upright.transmittance(c) * of_room[c];
        }
    }
}

/// What the air scatters into the line of sight since the hop before.
void HopLight::State::add_haze(const Hop& hop, std::size_t b, float height_km, const float* passed,
                               float* haze, const float* haze_before, double* row) const {
    const ScatteredPath& table = *band[b].haze;
    float passed_sun = 0.0f, all_sun = 0.0f;
    for (std::size_t c = lanes.first[b]; c < lanes.first[b + 1]; ++c) {
        passed_sun += passed[c] * sun[1][c];
        all_sun += sun[1][c];
    }
    if (hop.kind != Hop::Kind::sky) {
        haze[b] = table(table.towards(angle_from_sun(hop.direction), double{hop.direction.z()}),
                        hop.range, height_km);
    }
    const float before = haze_before ? haze_before[b] : 0.0f;
    row[lanes.first[b]] += double{hop.weight} * double{passed_sun / std::max(all_sun, 1e-30f)} *
                           double{haze[b] - before};
}

void HopLight::State::add_pixel(std::size_t k, PixelWork& work,
                                std::span<std::vector<float>> planes) const {
    const std::size_t n = lanes.size(), bands = band.size();
    const bool by_term = planes.size() > bands;
    const std::span<const Hop> list(&hops.hop[hops.row[k]], hops.row[k + 1] - hops.row[k]);
    work.passed.resize(list.size() * n);
    work.transmittance.resize(list.size() * n);
    work.radiance.resize(list.size() * n);
    work.haze.assign(list.size() * bands, 0.0f);
    work.as.assign(list.size(), Term::path);
    work.filter.resize(n);
    work.own.resize(own_terms * n);
    work.sum.assign((by_term ? term_count : 1) * n, 0.0);
    for (std::size_t i = 0; i < list.size(); ++i) {
        const Hop& hop = list[i];
        float *passed = &work.passed[i * n], *transmittance = &work.transmittance[i * n],
              *radiance = &work.radiance[i * n];
        const auto height_km =
            static_cast<float>(input.ground_height_km + 1e-3 * double{hop.height});
        const auto before = static_cast<std::size_t>(std::max(hop.before, 0));
        const bool first = hop.before < 0;
        Term& as = work.as[i];
        if (first) {
            std::fill_n(passed, n, 1.0f);
        } else {
            pass(list[before], hop.way, &work.passed[before * n], passed);
            as = work.as[before] != Term::path   ? work.as[before]
                 : hop.way == Hop::Way::mirrored ? Term::surroundings
                                                 : Term::behind;
            if (as == Term::surroundings && hop.kind == Hop::Kind::sky) as = Term::sky;
        }
        const auto row = [&](Term own) {
            const Term t = as == Term::path ? own : as;
            return &work.sum[by_term ? static_cast<std::size_t>(t) * n : 0];
        };
        // A mirror's own way is left dark.
        for (std::size_t b = 0; hop.straight && b < bands; ++b) {
            if (!band[b].haze) continue;
            add_haze(hop, b, height_km, passed, &work.haze[i * bands],
                     first ? nullptr : &work.haze[before * bands], row(Term::path));
        }
        // What the air up to here sends, but for what it sends up to the hop before.
        const float* nearer = first ? nullptr : &work.radiance[before * n];
        double* path = row(Term::path);
        if (hop.kind == Hop::Kind::sky) {
            sky_towards(hop.direction.cast<double>(), hop.straight, {radiance, n});
            if (!hop.straight) {
                const float* dimmed = &work.transmittance[before * n];
                for (std::size_t c = 0; c < n; ++c) radiance[c] *= dimmed[c];
                nearer = nullptr;
            }
        } else {
            air_to(hop.range, height_km, transmittance, radiance);
        }
        for (std::size_t c = 0; c < n; ++c) {
            const float since = nearer ? radiance[c] - nearer[c] : radiance[c];
            path[c] += double{hop.weight * passed[c] * since};
        }
        if (hop.kind == Hop::Kind::sky) continue;

        float* filter = work.filter.data();
        for (std::size_t c = 0; c < n; ++c) filter[c] = hop.weight * passed[c] * transmittance[c];
        const auto add = [&](Term own, const float* light) {
            double* sum = row(own);
            for (std::size_t c = 0; c < n; ++c) sum[c] += double{filter[c] * light[c]};
        };
        if (hop.kind == Hop::Kind::plume) {
            const float *absorbing = absorption[hop.what].data(), *glows = glow[hop.what].data();
            for (std::size_t c = 0; c < n; ++c) {
                work.own[c] = -std::expm1(-absorbing[c] * hop.chord) * glows[c];
            }
            add(Term::emitted, work.own.data());
            continue;
        }
        const std::uint32_t facet_place = place[hops.row[k] + i];
        if (!hop.closed && input.materials[input.facets.material[hop.what]].needs_rays()) {
            own_light(hop, facet_place, work.own.data());
            for (std::size_t t = 0; t < own_terms; ++t) {
                add(static_cast<Term>(t), &work.own[t * n]);
            }
        } else if (!by_term || as != Term::path) {
            add(Term::emitted, part(facet_place, FacetPart::closed));
        } else {
            for (std::size_t t = 0; t < own_terms; ++t) {
                add(static_cast<Term>(t), part(facet_place, closed_part[t]));
            }
        }
    }
    const std::size_t rows = planes.size() / bands;
    for (std::size_t p = 0; p < planes.size(); ++p) {
        const double* lane = &work.sum[p % rows * n];
        double sum = 0.0;
        for (std::size_t c = lanes.first[p / rows]; c < lanes.first[p / rows + 1]; ++c) {
            sum += lane[c];
        }
        planes[p][hops.pixel[k]] += static_cast<float>(sum);
    }
}

void HopLight::add(std::span<std::vector<float>> planes) const {
    for_each_block(state_->hops.pixel.size(), 64, [&](std::size_t begin, std::size_t end) {
        PixelWork work;
        for (std::size_t k = begin; k < end; ++k) state_->add_pixel(k, work, planes);
    });
}

}  // namespace diurna
