#include "thermal/solve/incident_light.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "thermal/weather/sky_shape.hpp"

namespace diurna {

namespace {

/// What facets reflect at an instant: where it was measured, what was measured.
FacetOptics optics_at(const SolveState& solve, std::size_t i) {
    FacetOptics optics = solve.optics;
    for (std::size_t f = 0; f < solve.facets; ++f) {
        const double albedo = measured_albedo(
            solve.sky[i], measured_share(solve.input, solve.input.facets.material[f]));
        if (!std::isnan(albedo)) optics.albedo[f] = float(albedo);
    }
    return optics;
}

/// The skies at some instants over all facets, at their heights.
SkyOverFacets sky_over(const SolveState& solve, std::size_t count, std::size_t first) {
    const std::size_t tiers = solve.tiers.size();
    if (tiers == 1) return {.sky = std::span(solve.sky).subspan(first, count)};
    return {.sky = std::span(solve.tier_sky).subspan(first * tiers, count * tiers),
            .tiers = tiers,
            .low = solve.tiers.low,
            .share = solve.tiers.share};
}

}  // namespace

void shine(SolveState& solve) {
    solve.sunlight.resize(solve.instant.size() * solve.facets);
    const FacetViews* const own = solve.input.sunlight_views;
    const auto at = [&](const FacetOptics& optics, const SkyOverFacets& sky,
                        std::span<const float> fraction, std::span<float> sunlight) {
        incident_sunlight({.facets = solve.input.facets,
                           .views = own ? *own : solve.input.views,
                           .optics = optics,
                           .exchange = solve.options.exchange},
                          {.sky = sky, .fraction = fraction}, sunlight);
    };
    const std::span<const float> fraction = solve.input.sun.fraction;
    if (solve.input.measured_share.empty()) {
        at(solve.optics, sky_over(solve, solve.sky.size(), 0), fraction, solve.sunlight);
        return;
    }
    for (std::size_t i = 0; i < solve.instant.size(); ++i) {
        const bool measured = !std::isnan(solve.sky[i].albedo);
        const FacetOptics of_instant = measured ? optics_at(solve, i) : FacetOptics{};
        at(measured ? of_instant : solve.optics, sky_over(solve, 1, i),
           fraction.empty() ? fraction : fraction.subspan(i * solve.facets, solve.facets),
           solve.row(solve.sunlight, i));
    }
}

void find_jumps(SolveState& solve) {
    const SunExposure& sun = solve.input.sun;
    if (sun.edge.empty()) return;
    // Backs of sheets without air behind have none.
    std::vector<Block::Jumps*> jumps_of(solve.facets, nullptr);
    std::vector<std::size_t> lane_of(solve.facets);
    for (std::size_t b = 0; b < solve.block.size(); ++b) {
        Block& block = solve.block[b];
        const auto tell = [&](const std::vector<std::size_t>& facets, Block::Jumps& jumps) {
            jumps.of.assign(solve.instant.size(), 0);
            for (std::size_t l = 0; l < facets.size(); ++l) {
                jumps_of[facets[l]] = &jumps;
                lane_of[facets[l]] = l;
            }
        };
        tell(block.facet, block.front);
        if (!block.behind.empty()) tell(block.behind, block.back);
    }
    const SkyOverFacets over = sky_over(solve, solve.sky.size(), 0);
    std::vector<SkyLight> light;
    for (const SkyState& sky : over.sky) light.push_back(sky_light(sky));
    const auto beam = [&](std::size_t i, std::size_t f) {
        const double cosine = solve.input.facets.normal[f].cast<double>().dot(solve.sky[i].to_sun);
        return std::max(0.0, cosine) * over.at_facet(light, i, f, &SkyLight::beam);
    };
    for (const ShadowEdge& edge : sun.edge) {
        const std::size_t i = edge.step, f = edge.facet;
        if (!jumps_of[f]) continue;
        const double before = sun.fraction[i * solve.facets + f];
        const double after = sun.fraction[(i + 1) * solve.facets + f];
        const double whole = beam(i, f) + edge.share * (beam(i + 1, f) - beam(i, f));
        jumps_of[f]->jump.push_back({lane_of[f], edge.share, (after - before) * whole});
        ++jumps_of[f]->of[i + 1];
    }
    for (Block& block : solve.block) {
        for (Block::Jumps* const jumps : {&block.front, &block.back}) {
            for (std::size_t i = 1; i < jumps->of.size(); ++i) jumps->of[i] += jumps->of[i - 1];
        }
    }
}

std::vector<float> tilts(const SolveState& solve) {
    const bool even = std::all_of(solve.sky.begin(), solve.sky.end(),
                                  [](const SkyState& sky) { return sky.tilted_longwave == 0.0; });
    if (even) return {};
    std::vector<float> tilt(solve.facets);
    for_each_index(
        solve.facets,
        [&](std::size_t f) {
            tilt[f] = float(tilted_sky_excess(sky_of(solve.input.views, solve.input.facets, f)));
        },
        4096);
    return tilt;
}

}  // namespace diurna
