#include "render/leaving.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/error.hpp"
#include "terrain/parallel.hpp"

namespace diurna {

namespace {

/// The terms of one facet, per channel.
struct Shades {
    explicit Shades(std::size_t padded)
        : black(padded),
          emitted(padded),
          reflectance(padded),
          sun(padded),
          sky(padded),
          behind(padded),
          around(padded) {}
    std::vector<float> black, emitted, reflectance, sun, sky, behind, around;
};

/// out = factor · Σ weight · values, over the three heights.
void blend(const std::array<std::vector<float>, 3>& values, const std::array<float, 3>& weight,
           float factor, std::vector<float>& out) {
    const float a = factor * weight[0], b = factor * weight[1], c = factor * weight[2];
    const float *x = values[0].data(), *y = values[1].data(), *z = values[2].data();
    float* o = out.data();
    const std::size_t n = out.size();
#pragma omp simd
    for (std::size_t i = 0; i < n; ++i) o[i] = a * x[i] + b * y[i] + c * z[i];
}

void add_scaled(float factor, const float* values, std::size_t n, float* out) {
#pragma omp simd
    for (std::size_t i = 0; i < n; ++i) out[i] += factor * values[i];
}

/// All terms but the light of the surroundings, which is handed in later.
void shade(const LitFacets::State& s, const SurfaceTable& table, const ReflectedLight& light,
           Shades& out) {
    const auto m = static_cast<std::size_t>(s.material);
    const std::size_t n = table.padded();
    table.black(s.temperature, out.black.data());
    table.surface(s.material, s.temperature, out.emitted.data(), out.reflectance.data());
    blend(light.sun[m], s.height_weight, s.sunlight, out.sun);
    blend(light.sky[m], s.height_weight, s.sky_view, out.sky);
    if (!table.transparent(s.material)) {
        std::fill(out.behind.begin(), out.behind.end(), 0.0f);
    } else if (const float* room = table.room(s.material)) {
        std::copy_n(room, n, out.behind.data());
    } else {
        for (std::size_t c = 0; c < n; ++c) {
            out.behind[c] = out.black[c] - out.emitted[c] - out.reflectance[c] * out.black[c];
        }
    }
}

void sum_terms(const Shades& s, float* out) {
    const float *emitted = s.emitted.data(), *reflectance = s.reflectance.data(),
                *sun = s.sun.data(), *sky = s.sky.data(), *behind = s.behind.data(),
                *around = s.around.data();
    const std::size_t n = s.emitted.size();
#pragma omp simd
    for (std::size_t c = 0; c < n; ++c) {
        out[c] = emitted[c] + (sun[c] + sky[c]) + (reflectance[c] * around[c] + behind[c]);
    }
}

}  // namespace

LitFacets lit_facets(const RadianceInput& input, std::span<const FacetId> seen) {
    const FacetSet& facets = input.facets;
    const Exchange& exchange = input.sky_view.exchange;
    LitFacets lit;
    lit.place.assign(facets.size(), LitFacets::absent);
    for (const FacetId id : seen) {
        lit.place[index(id)] = 0;
        for (std::uint32_t k = exchange.row[index(id)]; k < exchange.row[index(id) + 1]; ++k) {
            lit.place[index(exchange.facet[k])] = 0;
        }
    }
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (lit.place[f] == LitFacets::absent) continue;
        lit.place[f] = static_cast<std::uint32_t>(lit.facet.size());
        lit.facet.push_back(FacetId{static_cast<std::uint32_t>(f)});
    }

    lit.material_used.assign(input.materials.size(), false);
    lit.state.resize(lit.facet.size());
    std::vector<float> height_km(lit.facet.size());
    lit.coldest = 1e30f;
    for (std::size_t i = 0; i < lit.facet.size(); ++i) {
        const std::size_t f = index(lit.facet[i]);
        const float temperature = input.temperature[f];
        if (!(temperature >= 1.0f && temperature <= 5000.0f)) {
            throw InputError(
                fmt::format("facet {}", f),
                fmt::format("has a temperature of {} K, expected 1 to 5000", temperature));
        }
        lit.coldest = std::min(lit.coldest, temperature);
        lit.hottest = std::max(lit.hottest, temperature);
        lit.material_used[index(facets.material[f])] = true;
        lit.state[i] = {.material = facets.material[f],
                        .temperature = temperature,
                        .sunlight = static_cast<float>(sunlight_on(input, lit.facet[i])),
                        .sky_view = input.sky_view.sky_view[f],
                        .height_weight = {}};
        height_km[i] = static_cast<float>(input.ground_height_km +
                                          1e-3 * level_height(facets.centroid[f].cast<double>()));
    }
    if (lit.facet.empty()) {
        lit.coldest = lit.hottest = 300.0f;
        return lit;
    }

    const auto [least, most] = std::minmax_element(height_km.begin(), height_km.end());
    lit.height_km = {*least, 0.5 * (double{*least} + *most), *most};
    const double half = lit.height_km[1] - lit.height_km[0];
    for (std::size_t i = 0; i < lit.facet.size(); ++i) {
        // Quadratic through three heights: optical depths fall off exponentially with height.
        const double y = half > 1e-6 ? (height_km[i] - lit.height_km[1]) / half : 0.0;
        lit.state[i].height_weight = {static_cast<float>(0.5 * y * (y - 1.0)),
                                      static_cast<float>(1.0 - y * y),
                                      static_cast<float>(0.5 * y * (y + 1.0))};
    }
    return lit;
}

ReflectedLight reflected_light(const Band& band, const Channels& channels,
                               const MaterialLibrary& materials, const std::vector<bool>& used,
                               std::span<const Light, 3> light) {
    ReflectedLight reflected;
    reflected.sun.resize(materials.size());
    reflected.sky.resize(materials.size());
    std::vector<double> reflectance(band.node_um.size());
    for (std::size_t m = 0; m < materials.size(); ++m) {
        if (!used[m]) continue;
        const Material& material = materials[MaterialId{static_cast<std::uint16_t>(m)}];
        for (std::size_t n = 0; n < reflectance.size(); ++n) {
            reflectance[n] = material.reflectance.at(band.node_um[n]);
        }
        for (std::size_t h = 0; h < 3; ++h) {
            reflected.sun[m][h] = channel_sums(band, channels, reflectance, light[h].sun);
            reflected.sky[m][h] = channel_sums(band, channels, reflectance, light[h].sky);
        }
    }
    return reflected;
}

Leaving::Leaving(const RadianceInput& input, const LitFacets& lit, const SurfaceTable& table,
                 const ReflectedLight& light)
    : input_(input), lit_(lit), table_(table), light_(light) {
    const std::size_t n = table.padded();
    sent_.resize(lit.facet.size() * n);
    for_each_block(lit.facet.size(), 512, [&](std::size_t begin, std::size_t end) {
        Shades shades(n);
        for (std::size_t i = begin; i < end; ++i) {
            const LitFacets::State& state = lit.state[i];
            shade(state, table, light, shades);
            // What a neighbour itself sees of the scene counts as black at its own temperature.
            for (std::size_t c = 0; c < n; ++c) {
                shades.around[c] = (1.0f - state.sky_view) * shades.black[c];
            }
            sum_terms(shades, &sent_[i * n]);
        }
    });
}

void Leaving::around(FacetId facet, float* out, float* black) const {
    const Exchange& exchange = input_.sky_view.exchange;
    const std::size_t f = index(facet), n = table_.padded();
    const float rest = 1.0f - input_.sky_view.sky_view[f];
    const std::uint32_t begin = exchange.row[f], end = exchange.row[f + 1];
    if (begin == end) {
        for (std::size_t c = 0; c < n; ++c) out[c] = rest * black[c];
        return;
    }
    double total = 0.0;
    for (std::uint32_t k = begin; k < end; ++k) total += double(exchange.factor[k]);
    std::fill_n(out, n, 0.0f);
    for (std::uint32_t k = begin; k < end; ++k) {
        const auto factor = static_cast<float>(double(rest) * double(exchange.factor[k]) / total);
        const std::size_t neighbour = lit_.place[index(exchange.facet[k])];
        add_scaled(factor, &sent_[neighbour * n], n, out);
    }
}

template <class Combine>
void Leaving::each(std::span<const FacetId> seen, std::vector<float>& out,
                   const Combine& combine) const {
    const std::size_t n = table_.padded();
    out.resize(seen.size() * n);
    for_each_block(seen.size(), 256, [&](std::size_t begin, std::size_t end) {
        Shades shades(n);
        for (std::size_t i = begin; i < end; ++i) {
            shade(lit_.state[lit_.place[index(seen[i])]], table_, light_, shades);
            around(seen[i], shades.around.data(), shades.black.data());
            combine(shades, &out[i * n]);
        }
    });
}

void Leaving::total(std::span<const FacetId> seen, std::vector<float>& out) const {
    each(seen, out, sum_terms);
}

void Leaving::term(Term term, std::span<const FacetId> seen, std::vector<float>& out) const {
    each(seen, out, [&](const Shades& s, float* o) {
        const std::size_t n = s.emitted.size();
        switch (term) {
            case Term::emitted:
                std::copy_n(s.emitted.data(), n, o);
                break;
            case Term::sun:
                std::copy_n(s.sun.data(), n, o);
                break;
            case Term::sky:
                std::copy_n(s.sky.data(), n, o);
                break;
            case Term::surroundings:
                for (std::size_t c = 0; c < n; ++c) o[c] = s.reflectance[c] * s.around[c];
                break;
            case Term::behind:
                std::copy_n(s.behind.data(), n, o);
                break;
            case Term::path:
                std::fill_n(o, n, 0.0f);
                break;
        }
    });
}

}  // namespace diurna
