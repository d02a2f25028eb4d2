#include "render/leaving.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "materials/error.hpp"
#include "terrain/parallel.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_modes = 256, lane = 8;
using Lane = Eigen::Array<float, lane, 1>;
Eigen::Map<const Lane> load(const float* from) { return Eigen::Map<const Lane>(from); }

/// A cubic whose coefficients lie n apart.
Lane cubic(const float* a, std::size_t n, float t) {
    return load(a) + t * (load(a + n) + t * (load(a + 2 * n) + t * load(a + 3 * n)));
}

/// out += factor · Σ weight · values, over the three heights.
void add_blend(const std::array<std::vector<float>, 3>& values, const std::array<float, 3>& weight,
               float factor, std::size_t n, float* out) {
    const float a = factor * weight[0], b = factor * weight[1], c = factor * weight[2];
    const float *x = values[0].data(), *y = values[1].data(), *z = values[2].data();
#pragma omp simd
    for (std::size_t i = 0; i < n; ++i) out[i] += a * x[i] + b * y[i] + c * z[i];
}

void add_scaled(float factor, const float* values, std::size_t n, float* out) {
#pragma omp simd
    for (std::size_t i = 0; i < n; ++i) out[i] += factor * values[i];
}

/// Weights of the least, middle and greatest height: a quadratic, as optical depths fall off
/// exponentially with height.
std::array<float, 3> height_weights(float y) {
    return {0.5f * y * (y - 1.0f), 1.0f - y * y, 0.5f * y * (y + 1.0f)};
}

}  // namespace

namespace {

/// A few pieces of memory between frames.
struct Pool {
    static constexpr std::size_t most = 3;
    std::mutex mutex;
    std::vector<std::pair<std::size_t, std::unique_ptr<float[]>>> pieces;
};
Pool& pool() {
    static Pool only;
    return only;
}

}  // namespace

Scratch::Scratch(std::size_t size) : size_(size) {
    {
        const std::lock_guard lock(pool().mutex);
        auto& pieces = pool().pieces;
        const auto fits = std::find_if(pieces.begin(), pieces.end(), [&](const auto& piece) {
            return piece.first >= size && piece.first / 2 <= size;
        });
        if (fits != pieces.end()) {
            size_ = fits->first;
            memory_ = std::move(fits->second);
            pieces.erase(fits);
        }
    }
    if (!memory_) memory_ = std::make_unique_for_overwrite<float[]>(size);
}

Scratch::~Scratch() {
    const std::lock_guard lock(pool().mutex);
    auto& pieces = pool().pieces;
    if (pieces.size() >= Pool::most) pieces.erase(pieces.begin());
    pieces.emplace_back(size_, std::move(memory_));
}

LitFacets lit_facets(const RadianceInput& input, std::span<const FacetId> seen) {
    const FacetSet& facets = input.facets;
    const Exchange& exchange = input.sky_view.exchange;
    const auto each_source = [&](std::size_t f, const auto& body) {
        for (std::uint32_t k = exchange.row[f]; k < exchange.row[f + 1]; ++k) {
            body(index(exchange.facet[k]), double{exchange.factor[k]});
        }
    };
    // Steps from the eye: 1 seen, 2 shines on one seen, 3 shines on one of those.
    std::vector<std::uint8_t> step(facets.size(), 0);
    for (const FacetId id : seen) step[index(id)] = 1;
    std::vector<std::uint8_t> shining(facets.size(), 0);
    for (std::uint8_t now = 1; now <= 2; ++now) {
        for (std::size_t f = 0; f < facets.size(); ++f) {
            if (step[f] != now) continue;
            each_source(f, [&](std::size_t from, double) {
                if (step[from] == 0) step[from] = static_cast<std::uint8_t>(now + 1);
                if (now == 1) shining[from] = 1;
            });
        }
    }

    LitFacets lit;
    lit.place.assign(facets.size(), LitFacets::absent);
    lit.material_used.assign(input.materials.size(), false);
    std::size_t entries = 0;
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (step[f] == 0) continue;
        lit.place[f] = static_cast<std::uint32_t>(lit.facet.size());
        lit.facet.push_back(FacetId{static_cast<std::uint32_t>(f)});
        lit.shining.push_back(shining[f]);
        lit.material_used[index(facets.material[f])] = true;
        if (step[f] <= 2) entries += exchange.row[f + 1] - exchange.row[f];
    }
    lit.row.reserve(lit.facet.size() + 1);
    lit.source.reserve(entries);
    lit.factor.reserve(entries);
    lit.row.push_back(0);
    std::vector<double> height_km(lit.facet.size());
    for (std::size_t i = 0; i < lit.facet.size(); ++i) {
        const std::size_t f = index(lit.facet[i]);
        if (step[f] <= 2) {
            double total = 0.0;
            each_source(f, [&](std::size_t, double factor) { total += factor; });
            const double rest = 1.0 - double{input.sky_view.sky_view[f]};
            each_source(f, [&](std::size_t from, double factor) {
                if (factor == 0.0) return;  // a row of nothing but zeros is no row
                lit.source.push_back(lit.place[from]);
                lit.factor.push_back(static_cast<float>(rest * factor / total));
            });
        }
        lit.row.push_back(static_cast<std::uint32_t>(lit.source.size()));
        height_km[i] =
            input.ground_height_km + 1e-3 * level_height(facets.centroid[f].cast<double>());
    }
    lit.height.assign(lit.facet.size(), 0.0f);
    if (lit.facet.empty()) return lit;
    const auto [least, most] = std::minmax_element(height_km.begin(), height_km.end());
    lit.height_km = {*least, 0.5 * (*least + *most), *most};
    const double half = lit.height_km[1] - lit.height_km[0];
    for (std::size_t i = 0; i < lit.facet.size() && half > 1e-6; ++i) {
        lit.height[i] = static_cast<float>((height_km[i] - lit.height_km[1]) / half);
    }
    return lit;
}

TemperatureExtent temperature_extent(const RadianceInput& input, const LitFacets& lit) {
    TemperatureExtent extent;
    if (lit.facet.empty()) return extent;
    extent = {.coldest = 1e30f, .hottest = 0.0f};
    for (const FacetId id : lit.facet) {
        const float temperature = input.temperature[index(id)];
        if (!(temperature >= 1.0f && temperature <= 5000.0f)) {
            throw InputError(
                fmt::format("facet {}", index(id)),
                fmt::format("has a temperature of {} K, expected 1 to 5000", temperature));
        }
        extent.coldest = std::min(extent.coldest, temperature);
        extent.hottest = std::max(extent.hottest, temperature);
    }
    return extent;
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

ReflectedLight in_modes(const ReflectedLight& light, const ModeBasis& basis) {
    ReflectedLight modes = light;
    for (auto* part : {&modes.sun, &modes.sky}) {
        for (auto& heights : *part) {
            for (auto& channels : heights) {
                if (channels.empty()) continue;
                std::vector<float> projected(basis.padded());
                basis.project(channels.data(), projected.data());
                channels = std::move(projected);
            }
        }
    }
    return modes;
}

/// What leaves a facet, its surroundings closed as black at its own temperature. Eight modes at a
/// time stay in registers.
void Leaving::first(std::size_t i, float* sum) const {
    const std::size_t f = index(lit_.facet[i]), n = table_.padded();
    const MaterialId material = input_.facets.material[f];
    const float sky_view = input_.sky_view.sky_view[f];
    const ModeTable::Cell cell = table_.cell(material, input_.temperature[f]);
    const std::array<float, 3> up = height_weights(lit_.height[i]);
    const bool through = table_.transparent(material);
    const float* room = through ? table_.room(material) : nullptr;
    const auto& sun = light_.sun[index(material)];
    const auto& sky = light_.sky[index(material)];
    const auto sunlight = input_.sun_fraction.empty() || input_.sun_fraction[f] == 0.0f
                              ? 0.0f
                              : static_cast<float>(sunlight_on(input_, lit_.facet[i]));
    for (std::size_t k = 0; k < n; k += lane) {
        const Lane emitted = cubic(cell.emitted + k, n, cell.t);
        const Lane reflected = cubic(cell.reflected + k, n, cell.t);
        Lane all = emitted + (1.0f - sky_view) * reflected;
        if (room) {
            all += load(room + k);
        } else if (through) {
            // Without a room behind, what shines through is τB = B − εB − ρB.
            all += cubic(cell.black + k, n, cell.t) - emitted - reflected;
        }
        all += sky_view *
               (up[0] * load(&sky[0][k]) + up[1] * load(&sky[1][k]) + up[2] * load(&sky[2][k]));
        if (sunlight > 0.0f) {
            all += sunlight *
                   (up[0] * load(&sun[0][k]) + up[1] * load(&sun[1][k]) + up[2] * load(&sun[2][k]));
        }
        Eigen::Map<Lane>(sum + k) = all;
    }
}

/// The light of a facet's surroundings.
void Leaving::around(std::size_t i, float* out) const {
    const std::size_t n = table_.padded();
    std::fill_n(out, n, 0.0f);
    for (std::uint32_t k = lit_.row[i]; k < lit_.row[i + 1]; ++k) {
        add_scaled(lit_.factor[k], &sent_[std::size_t{lit_.source[k]} * n], n, out);
    }
}

Leaving::Leaving(const RadianceInput& input, const LitFacets& lit, const ModeTable& table,
                 const ReflectedLight& light, std::span<const float> reflectance,
                 const BounceOptions& options)
    : input_(input),
      lit_(lit),
      table_(table),
      light_(light),
      sent_(lit.facet.size() * table.padded()) {
    const std::size_t n = table.padded();
    if (n > most_modes) throw InputError("render", "a band has too many channels");
    for_each_block(lit.facet.size(), 2048, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            first(i, &sent_[i * n]);
        }
    });
    if (options.bounces < 2) return;

    // ρ (1 − V) of the facets seen bounds what a change of their surroundings does to them.
    const auto response = [&](std::size_t i) {
        const std::size_t f = index(lit.facet[i]);
        return reflectance[index(input.facets.material[f])] * (1.0f - input.sky_view.sky_view[f]);
    };
    std::vector<float> seen_by(lit.facet.size(), 0.0f);
    for (std::size_t i = 0; i < lit.facet.size(); ++i) {
        const float r = response(i);
        for (std::uint32_t k = lit.row[i]; k < lit.row[i + 1]; ++k) {
            seen_by[lit.source[k]] = std::max(seen_by[lit.source[k]], r);
        }
    }
    // What the second bounce changes: ρ Σ F (T_k − T) of heat, and the sunlight of neighbours.
    std::vector<std::uint8_t> worth(lit.facet.size(), 0);
    for_each_block(lit.facet.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const float most = response(i) * seen_by[i];
            if (!lit.shining[i] || most * options.most_change < options.tolerance) continue;
            const float own = input.temperature[index(lit.facet[i])];
            float change = 0.0f;
            for (std::uint32_t k = lit.row[i]; k < lit.row[i + 1]; ++k) {
                const std::size_t other = index(lit.facet[lit.source[k]]);
                change += lit.factor[k] * std::abs(input.temperature[other] - own);
                if (!input.sun_fraction.empty()) {
                    change += lit.factor[k] * reflectance[index(input.facets.material[other])] *
                              (options.sunlight * input.sun_fraction[other] +
                               options.skylight * input.sky_view.sky_view[other]);
                }
            }
            worth[i] = reflectance[index(input.facets.material[index(lit.facet[i])])] * change *
                           seen_by[i] >
                       options.tolerance;
        }
    });
    for (std::size_t i = 0; i < worth.size(); ++i) {
        if (worth[i]) second_.push_back(static_cast<std::uint32_t>(i));
    }
    std::vector<float> refined(second_.size() * n);
    for_each_block(second_.size(), 1024, [&](std::size_t begin, std::size_t end) {
        for (std::size_t s = begin; s < end; ++s) total(lit.facet[second_[s]], &refined[s * n]);
    });
    followed_.assign(lit.facet.size(), 0);
    for (std::size_t s = 0; s < second_.size(); ++s) {
        std::copy_n(&refined[s * n], n, &sent_[second_[s] * n]);
        followed_[second_[s]] = 1;
    }
}

void Leaving::total(FacetId facet, float* out) const {
    const std::size_t i = lit_.place[index(facet)], n = table_.padded();
    if (!followed_.empty() && followed_[i]) {
        first(i, out);
    } else {
        std::copy_n(&sent_[i * n], n, out);
    }
    const std::uint32_t begin = lit_.row[i], end = lit_.row[i + 1];
    if (begin == end) return;
    // ρ times the light of the surroundings less that of the black body they were closed with.
    const MaterialId material = input_.facets.material[index(facet)];
    const ModeTable::Cell cell = table_.cell(material, input_.temperature[index(facet)]);
    const float rest = 1.0f - input_.sky_view.sky_view[index(facet)];
    const std::vector<float>& reflection = table_.reflection(material);
    alignas(32) std::array<float, most_modes> light;
    for (std::size_t k = 0; k < n; k += lane) {
        Lane around = -rest * cubic(cell.black + k, n, cell.t);
        for (std::uint32_t e = begin; e < end; ++e) {
            around += lit_.factor[e] * load(&sent_[std::size_t{lit_.source[e]} * n + k]);
        }
        if (reflection.size() == n) {
            Eigen::Map<Lane>(out + k) += load(&reflection[k]) * around;
        } else {
            Eigen::Map<Lane>(light.data() + k) = around;
        }
    }
    if (reflection.size() != n) add_product(reflection, light.data(), n, out);
}

void Leaving::terms(FacetId facet, float* out) const {
    const std::size_t i = lit_.place[index(facet)], f = index(facet), n = table_.padded();
    const MaterialId material = input_.facets.material[f];
    const float temperature = input_.temperature[f], sky_view = input_.sky_view.sky_view[f];
    const auto of = [&](Term term) { return out + static_cast<std::size_t>(term) * n; };
    std::fill_n(out, term_count * n, 0.0f);
    alignas(32) std::array<float, most_modes> black, light;
    table_.black(temperature, black.data());
    table_.emitted(material, temperature, of(Term::emitted));
    const std::array<float, 3> weight = height_weights(lit_.height[i]);
    add_blend(light_.sun[index(material)], weight, static_cast<float>(sunlight_on(input_, facet)),
              n, of(Term::sun));
    add_blend(light_.sky[index(material)], weight, sky_view, n, of(Term::sky));
    if (lit_.row[i] == lit_.row[i + 1]) {
        for (std::size_t k = 0; k < n; ++k) light[k] = (1.0f - sky_view) * black[k];
    } else {
        around(i, light.data());
    }
    add_product(table_.reflection(material), light.data(), n, of(Term::surroundings));
    if (table_.transparent(material)) {
        if (const float* room = table_.room(material)) {
            std::copy_n(room, n, of(Term::behind));
        } else {
            for (std::size_t k = 0; k < n; ++k) {
                of(Term::behind)[k] = black[k] - of(Term::emitted)[k];
                light[k] = -black[k];
            }
            add_product(table_.reflection(material), light.data(), n, of(Term::behind));
        }
    }
}

}  // namespace diurna
