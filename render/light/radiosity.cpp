#include "render/light/radiosity.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "render/light/lanes.hpp"
#include "terrain/visibility/interreflection.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_lanes = 1024, ahead = 12;

/// Of the quadratic over three heights, eight lanes from k on.
Lane at_height(const std::array<std::vector<float>, 3>& heights, const std::array<float, 3>& up,
               std::size_t k) {
    return up[0] * load(&heights[0][k]) + up[1] * load(&heights[1][k]) +
           up[2] * load(&heights[2][k]);
}

void add(const float* from, std::size_t n, float* to) {
    for (std::size_t k = 0; k < n; ++k) to[k] += from[k];
}

/// Adds Σ share × row of a matrix, whose rows are groups of four lanes.
void add_rows(const float* share, std::size_t rows, const float* matrix, std::size_t width,
              float* to) {
    using Four = Eigen::Array<float, 4, 1>;
    for (std::size_t k = 0; k < width; k += 4) {
        Four sum = Eigen::Map<const Four>(to + k);
        const float* row = matrix + k;
        for (std::size_t r = 0; r < rows; ++r, row += width) {
            sum += share[r] * Eigen::Map<const Four>(row);
        }
        Eigen::Map<Four>(to + k) = sum;
    }
}

/// How much light in modes counts in a picture: its band radiance over what a band leaves out, from
/// above (Σ w f ≤ √(Σ w) √(Σ w f²)), in the band where it counts most.
class Counting {
 public:
    Counting(const RadiosityTables& tables, std::span<const BandLight> bands,
             std::span<const BounceOptions> bounces)
        : first_(tables.first) {
        for (std::size_t b = 0; b < bands.size(); ++b) {
            const double scale =
                std::sqrt(std::max(0.0, bands[b].band.width_um())) / double{bounces[b].least};
            scale_.push_back(static_cast<float>(std::min(scale, 1e30)));
        }
    }
    float worth(const float* modes) const {
        float most = 0.0f;
        for (std::size_t b = 0; b < scale_.size(); ++b) {
            float square = 0.0f;
            for (std::size_t k = first_[b]; k < first_[b + 1]; ++k) square += modes[k] * modes[k];
            most = std::max(most, scale_[b] * std::sqrt(square));
        }
        return most;
    }

 private:
    std::span<const std::size_t> first_;
    std::vector<float> scale_;  // (band)
};

}  // namespace

Radiosity::Radiosity(const LitFacets& lit, const LitState& state, const RadiosityTables& tables,
                     std::span<const BandLight> bands, std::span<const BounceOptions> bounces)
    : lit_(lit), state_(state), tables_(tables), radiosity_(lit.facet.size() * tables.lanes) {
    if (tables.lanes > most_lanes) throw InputError("render", "too many bands at once");
    for_each_block(lit.facet.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (lit_.is_source[i]) first_bounce(i, bands, &radiosity_[i * tables_.lanes]);
        }
    });
    follow_bounces(bands, bounces);
}

void Radiosity::follow_bounces(std::span<const BandLight> bands,
                               std::span<const BounceOptions> bounces) {
    int most = 1;
    float first = 1.0f;
    for (const BounceOptions& band : bounces) {
        most = std::max(most, band.bounces);
        first = std::min(first, band.first);
    }
    const std::size_t n = lit_.facet.size(), lanes = tables_.lanes;
    if (most < 2 || n == 0) return;
    const Counting counting(tables_, bands, bounces);
    ReusedFloats unsent(n * lanes);
    std::vector<float> counts(n, 0.0f);
    std::vector<std::uint8_t> begun(n, 0);  // whether it has a value in `unsent`
    for_each_block(n, 4096, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint32_t> chosen;
        for (std::size_t i = begin; i < end; ++i) {
            begun[i] = lit_.row[i] != lit_.row[i + 1] && lit_.reach[i] * lit_.returned[i] > first;
            if (begun[i]) chosen.push_back(static_cast<std::uint32_t>(i));
        }
        for (std::size_t k = 0; k < chosen.size(); ++k) {
            if (k + ahead < chosen.size()) fetch(chosen[k + ahead]);
            const std::size_t i = chosen[k];
            second_bounce(i, &unsent[i * lanes]);
            counts[i] = lit_.reach[i] * counting.worth(&unsent[i * lanes]);
        }
    });
    for_each_block(n, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (begun[i]) add(&unsent[i * lanes], lanes, &radiosity_[i * lanes]);
        }
    });
    followed_ = std::size_t(std::count(begun.begin(), begun.end(), 1));
    bounces_ = 2 + interreflect(
                       SeenRows{.row = lit_.row, .source = lit_.source, .factor = lit_.factor},
                       {.value = unsent.data(), .stride = lanes, .lanes = lanes, .counts = counts},
                       [&](std::size_t i, const float* arrived, float* own) {
                           if (!lit_.is_source[i]) return 0.0f;
                           alignas(32) std::array<float, most_lanes> more;
                           std::fill_n(more.begin(), lanes, 0.0f);
                           reflect(i, arrived, more.data());
                           add(more.data(), lanes, &radiosity_[i * lanes]);
                           if (begun[i]) {
                               add(more.data(), lanes, own);
                           } else {
                               std::copy_n(more.data(), lanes, own);
                           }
                           begun[i] = 1;
                           return lit_.reach[i] * counting.worth(own);
                       },
                       most - 2);
}

/// Own heat, sky and sun; black surroundings. Eight lanes at a time stay in registers.
void Radiosity::first_bounce(std::size_t i, std::span<const BandLight> bands, float* out) const {
    const std::size_t n = tables_.lanes;
    const auto& material = tables_.material[index(lit_.material[i])];
    float t = 0.0f;
    const std::size_t cell = tables_.grid.cell(state_.temperature[i], t) * 4 * n;
    const float *emitted = &material.emitted[cell], *reflected = &material.reflected[cell];
    const std::array<float, 3> up = height_weights(lit_.height[i]);
    const float open = lit_.sky_view[i], sunlight = state_.sunlight[i];
    for (std::size_t k = 0; k < n; k += lane_count) {
        Lane all = cubic(emitted + k, n, t) + (1.0f - open) * cubic(reflected + k, n, t);
        if (sunlight > 0.0f) all += sunlight * at_height(material.sun, up, k);
        Eigen::Map<Lane>(out + k) = all;
    }
    std::array<float, SkyModes::most> sky;
    for (std::size_t b = 0; b < bands.size(); ++b) {
        bands[b].sky.of(open, state_.uneven[i], state_.narrow_of(i), up, sky.data());
        const std::size_t first = tables_.first[b];
        add_rows(sky.data(), bands[b].sky.size(), material.sky[b].data(),
                 tables_.first[b + 1] - first, out + first);
    }
}

/// Light that arrives less that of the black surroundings it was closed with.
void Radiosity::second_bounce(std::size_t i, float* unsent) const {
    const std::size_t n = tables_.lanes;
    alignas(32) std::array<float, most_lanes> own, light;
    black_modes(tables_, state_.temperature[i], own.data());
    arriving(i, own.data(), light.data());
    const float rest = 1.0f - lit_.sky_view[i];
    for (std::size_t k = 0; k < n; ++k) light[k] -= rest * own[k];
    std::fill_n(unsent, n, 0.0f);
    reflect(i, light.data(), unsent);
}

void Radiosity::reflect(std::size_t i, const float* light, float* out) const {
    const auto& material = tables_.material[index(lit_.material[i])];
    for (std::size_t b = 0; b < tables_.size.size(); ++b) {
        const std::size_t first = tables_.first[b];
        add_rows(light + first, tables_.size[b], material.reflection[b].data(),
                 tables_.first[b + 1] - first, out + first);
    }
}

namespace {

/// Σ factor × radiosity over a row of sources, of `groups` groups of lanes from `first` on.
template <std::size_t groups>
void add_row(const LitFacets& lit, std::size_t i, const float* radiosity, std::size_t lanes,
             std::size_t first, float* out) {
    Lane sum[groups];
    for (Lane& of : sum) of = Lane::Zero();
    for (std::uint32_t e = lit.row[i]; e < lit.row[i + 1]; ++e) {
        const float* from = radiosity + std::size_t{lit.source[e]} * lanes + first;
        for (std::size_t g = 0; g < groups; ++g) {
            sum[g] += lit.factor[e] * load(from + g * lane_count);
        }
    }
    for (std::size_t g = 0; g < groups; ++g)
        Eigen::Map<Lane>(out + first + g * lane_count) = sum[g];
}

}  // namespace

void Radiosity::arriving(std::size_t i, const float* black, float* out) const {
    const std::size_t n = tables_.lanes;
    if (lit_.row[i] == lit_.row[i + 1]) {
        for (std::size_t k = 0; k < n; k += lane_count) {
            Eigen::Map<Lane>(out + k) = (1.0f - lit_.sky_view[i]) * load(black + k);
        }
        return;
    }
    std::size_t k = 0;
    for (; k + 4 * lane_count <= n; k += 4 * lane_count) {
        add_row<4>(lit_, i, radiosity_.data(), n, k, out);
    }
    switch ((n - k) / lane_count) {
        case 3:
            add_row<3>(lit_, i, radiosity_.data(), n, k, out);
            break;
        case 2:
            add_row<2>(lit_, i, radiosity_.data(), n, k, out);
            break;
        case 1:
            add_row<1>(lit_, i, radiosity_.data(), n, k, out);
            break;
        default:
            break;
    }
}

}  // namespace diurna
