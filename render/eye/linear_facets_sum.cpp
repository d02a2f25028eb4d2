#include "render/eye/linear_facets_sum.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "materials/base/parallel.hpp"

namespace diurna {

namespace {

constexpr float least_warmer = 1e-3f, most_linear = 0.5f;  // [K]
constexpr auto no_row = ~std::uint32_t{0};

/// Targets with temperatures of their own, and those at which their emission is computed.
struct Chosen {
    std::vector<std::uint32_t> place;        // (target) of its first row, or no_row
    std::vector<std::uint32_t> target;       // (row)
    std::vector<float> warmer;               // (row) [K]; a target's second row is the opposite
    std::vector<std::uint8_t> has_parabola;  // (row)

    Chosen(const View& view, const LinearFacets& ground) : place(view.surface.size(), no_row) {
        std::vector<float> most(view.surface.size(), 0.0f);
        for (std::size_t k = 0; k < ground.warmer.size(); ++k) {
            float& of = most[view.sighting[k].target];
            of = std::max(of, std::abs(ground.warmer[k]));
        }
        for (std::size_t t = 0; t < most.size(); ++t) {
            if (most[t] < least_warmer) continue;
            place[t] = static_cast<std::uint32_t>(target.size());
            add(t, most[t], most[t] > most_linear);
            if (most[t] > most_linear) add(t, -most[t], true);
        }
    }
    void add(std::size_t t, float kelvins, bool parabola) {
        target.push_back(static_cast<std::uint32_t>(t));
        warmer.push_back(kelvins);
        has_parabola.push_back(parabola);
    }
};

float radiance_here(const AtEye& at, const Sighting& s) {
    return at.value + s.deeper * at.by_range + s.higher * at.by_height;
}

}  // namespace

void add_linear_facets(const View& view, const LinearFacets& ground, const SceneLight& light,
                       const EyeTables& tables, std::span<std::vector<float>> planes) {
    if (ground.empty()) return;
    const Chosen chosen(view, ground);
    if (chosen.target.empty()) return;
    const std::size_t columns = planes.size();
    std::vector<AtEye> more(chosen.target.size() * columns);
    tables.look_at_warmth(view, light, chosen.target, chosen.warmer, more);
    for_each_block(view.pixels(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t p = begin; p < end; ++p) {
            for (std::uint32_t k = view.row[p]; k < view.row[p + 1]; ++k) {
                const Sighting& s = view.sighting[k];
                const std::uint32_t place = chosen.place[s.target];
                if (place == no_row || ground.warmer[k] == 0.0f) continue;
                // Of +1 and -1 times the largest difference.
                const float share = ground.warmer[k] / chosen.warmer[place];
                const bool parabola = chosen.has_parabola[place] != 0;
                const float first = parabola ? 0.5f * share * (share + 1.0f) : share;
                const float second = 0.5f * share * (share - 1.0f);
                const AtEye* const up = &more[place * columns];
                const AtEye* const down = parabola ? up + columns : up;
                for (std::size_t c = 0; c < columns; ++c) {
                    float radiance = first * radiance_here(up[c], s);
                    if (parabola) radiance += second * radiance_here(down[c], s);
                    planes[c][p] += s.weight * radiance;
                }
            }
        }
    });
}

}  // namespace diurna
