#include "thermal/solve/incident_sunlight.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "materials/base/parallel.hpp"
#include "thermal/surface/surface_cover.hpp"
#include "thermal/weather/sky_shape.hpp"

namespace diurna {

namespace {

/// What others see of a surface whose broadband albedo is `albedo`.
float shown_albedo(const Material& material, double albedo) {
    constexpr double most = 0.99;
    const double stops = material.see_through ? 1.0 - material.thermal.solar_transmittance : 1.0;
    return float(stops > 0.0 ? std::min(most, albedo / stops) : 0.0);
}

const Material& material_of(const SolveState& solve, std::size_t facet) {
    return solve.input.materials[solve.input.facets.material[facet]];
}

/// The albedo, at all instants, of all facets with water that others see; none if it never changes
/// theirs.
ChangingAlbedo under_water(const SolveState& solve, const CoveredFacets& water) {
    ChangingAlbedo changing;
    for (const std::uint32_t f : water.facet) {
        if (f < solve.counted) changing.facet.push_back(f);
    }
    bool changes = false;
    changing.albedo.reserve(water.cover.size());
    for (std::size_t n = 0; n < water.cover.size(); ++n) {
        const std::size_t f = water.facet[n % water.facet.size()];
        if (f >= solve.counted) continue;
        const Material& material = material_of(solve, f);
        changing.albedo.push_back(
            shown_albedo(material, covered_albedo(material.thermal, water.cover[n])));
        changes = changes || std::abs(changing.albedo.back() - solve.optics.albedo[f]) > 1e-6f;
    }
    return changes ? changing : ChangingAlbedo{};
}

/// Moves the albedo that sunlight goes by towards what has been found under it. Snow that melts the
/// sooner the more light its neighbours' snow sends it would swing to and fro: each value goes by
/// the secant of its last two residuals, a fifth of the way at the least.
void approach(const ChangingAlbedo& found, SolveState& solve) {
    ChangingAlbedo& now = solve.changing;
    AlbedoMove& last = solve.albedo_move;
    const std::size_t size = found.albedo.size();
    if (now.facet != found.facet || now.albedo.size() != size) {
        now = found;
        last = {};
        return;
    }
    const bool first = last.residual.size() != size;
    last.residual.resize(size, 0.0f);
    last.move.resize(size, 0.0f);
    for (std::size_t n = 0; n < size; ++n) {
        const float residual = found.albedo[n] - now.albedo[n];
        const float bend = last.residual[n] - residual;
        float share = 1.0f;
        if (!first && std::abs(bend) > 1e-6f) {
            share = std::clamp(last.move[n] / bend, 0.2f, 1.0f);
        }
        last.residual[n] = residual;
        last.move[n] = share * residual;
        now.albedo[n] += last.move[n];
    }
}

/// Whether two are alike to a ten thousandth: less than sunlight is followed to.
bool alike(const ChangingAlbedo& a, const ChangingAlbedo& b) {
    return a.facet == b.facet &&
           std::equal(a.albedo.begin(), a.albedo.end(), b.albedo.begin(), b.albedo.end(),
                      [](float x, float y) { return std::abs(x - y) <= 1e-4f; });
}

/// What facets reflect at an instant: where it was measured, what was measured; else what lies
/// there.
FacetOptics optics_at(const SolveState& solve, std::size_t i) {
    FacetOptics optics = solve.optics;
    const ChangingAlbedo& changing = solve.changing;
    for (std::size_t k = 0; k < changing.facet.size(); ++k) {
        optics.albedo[changing.facet[k]] = changing.albedo[i * changing.facet.size() + k];
    }
    if (std::isnan(solve.sky[i].albedo)) return optics;
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

/// Slots for values of sunlit instants.
std::vector<int> sunlit_slots(const SolveState& solve) {
    std::vector<int> slots(solve.sky.size(), -1);
    int next = 0;
    for (const std::size_t i : sunlit(sky_over(solve, solve.sky.size(), 0))) slots[i] = next++;
    return slots;
}

/// [W m⁻²] The largest change of what a facet takes in, mean over an hour: what comes and goes
/// within minutes warms little.
///
/// - albedo: at instant i, n × i further on; null: as dry
double most_of_an_hour(const SolveState& solve, std::size_t facet, const float* albedo,
                       std::size_t n, const PackedField& before) {
    const ThermalSurface& surface = material_of(solve, facet).thermal;
    const auto steps = std::max<std::size_t>(1, std::size_t(std::lround(3600.0 / solve.step)));
    double most = 0.0;
    for (std::size_t from = 0; from < solve.instant.size(); from += steps) {
        const std::size_t to = std::min(solve.instant.size(), from + steps);
        double sum = 0.0;
        for (std::size_t i = from; i < to; ++i) {
            const double sent = albedo ? double(albedo[i * n]) : surface.albedo;
            sum += std::max(0.0, 1.0 - sent - surface.solar_transmittance) *
                   double(std::abs(solve.sunlight.at(i, facet) - before.at(i, facet)));
        }
        most = std::max(most, sum / double(steps));
    }
    return most;
}

}  // namespace

void store_shares(SolveState& solve) {
    const std::vector<float>& fraction = solve.input.sun.fraction;
    const std::size_t facets = solve.facets;
    solve.shares = fraction.empty() ? PackedField{} : PackedField(sunlit_slots(solve), facets);
    if (solve.shares.empty()) return;
    const std::vector<std::size_t> lit = sunlit(sky_over(solve, solve.sky.size(), 0));
    constexpr std::size_t at_once = 64;
    for_each_block(facets, 64 * at_once, [&](std::size_t begin, std::size_t end) {
        std::vector<float> values(PackedField::run * at_once);
        std::size_t chosen[at_once];
        for (std::size_t first = begin; first < end; first += at_once) {
            const std::size_t n = std::min(at_once, end - first);
            for (std::size_t l = 0; l < n; ++l) chosen[l] = first + l;
            for (std::size_t r = 0; r < solve.shares.runs(); ++r) {
                for (std::size_t k = 0; k < solve.shares.width(r); ++k) {
                    const std::size_t row = lit[r * PackedField::run + k];
                    std::copy_n(&fraction[row * facets + first], n, &values[k * at_once]);
                }
                solve.shares.put(r, {chosen, n}, at_once, values.data());
            }
        }
    });
}

void add_sunlight(SolveState& solve) {
    solve.sunlight = PackedField(sunlit_slots(solve), solve.facets);
    const FacetViews* const own = solve.input.sunlight_views;
    const bool changes = !solve.changing.facet.empty();
    const auto at = [&](const FacetOptics& optics, const ChangingAlbedo* changing,
                        std::size_t count, std::size_t first, const auto& put) {
        incident_sunlight({.facets = solve.input.facets,
                           .views = own ? *own : solve.input.views,
                           .optics = optics,
                           .beside = solve.input.beside,
                           .exchange = solve.options.exchange,
                           .changing = changing,
                           .bound = solve.options.quick ? 5e-4 : 1e-4},
                          {.sky = sky_over(solve, count, first),
                           .fraction = {},
                           .shares = &solve.shares,
                           .first = first},
                          put);
    };
    std::size_t run = 0;
    const auto put_run = [&](std::span<const float> light, std::size_t width) {
        for (std::size_t k = 0; k < width; k += PackedField::run, ++run) {
            for_each_index(
                solve.facets,
                [&](std::size_t f) { solve.sunlight.put(run, f, light.data() + f * width + k); },
                4096);
        }
    };
    if (solve.input.measured_share.empty()) {
        at(solve.optics, changes ? &solve.changing : nullptr, solve.sky.size(), 0,
           [&](std::span<const std::size_t> instants, std::span<const float> light) {
               put_run(light, instants.size());
           });
        return;
    }
    // Each instant has its own optics.
    const std::vector<std::size_t> lit = sunlit(sky_over(solve, solve.sky.size(), 0));
    std::vector<float> together;
    for (std::size_t first = 0; first < lit.size(); first += PackedField::run) {
        const std::size_t width = std::min(PackedField::run, lit.size() - first);
        together.assign(solve.facets * width, 0.0f);
        for (std::size_t k = 0; k < width; ++k) {
            const std::size_t i = lit[first + k];
            const bool own_optics = changes || !std::isnan(solve.sky[i].albedo);
            const FacetOptics of_instant = own_optics ? optics_at(solve, i) : FacetOptics{};
            at(own_optics ? of_instant : solve.optics, nullptr, 1, i,
               [&](std::span<const std::size_t>, std::span<const float> light) {
                   for (std::size_t f = 0; f < solve.facets; ++f)
                       together[f * width + k] = light[f];
               });
        }
        put_run(together, width);
    }
}

void take_earlier_water(SolveState& solve) {
    if (!solve.input.from) return;
    const FacetSet& facets = solve.input.facets;
    std::vector<const HeatState::Point*> point;
    for (const HeatState::Point& p : solve.input.from->point) {
        if (p.facet < solve.facets && holds_water(material_of(solve, p.facet).thermal)) {
            point.push_back(&p);
        }
    }
    std::sort(point.begin(), point.end(),
              [](const auto* a, const auto* b) { return a->facet < b->facet; });
    CoveredFacets water;
    std::vector<SurfaceCover> row;
    for (const HeatState::Point* p : point) {
        const ThermalSurface& surface = material_of(solve, p->facet).thermal;
        row.push_back(surface_cover(surface,
                                    store_capacity(surface.store, facets.normal[p->facet].z()),
                                    p->standing, p->snow_albedo));
        water.facet.push_back(std::uint32_t(p->facet));
    }
    for (std::size_t i = 0; i < solve.instant.size(); ++i) {
        water.cover.insert(water.cover.end(), row.begin(), row.end());
    }
    solve.changing = under_water(solve, water);
}

double relight(SolveState& solve, const CoveredFacets& water) {
    const auto& seen = solve.input.views;
    const bool reflects =
        solve.options.exchange &&
        (!seen.others.facet.empty() || std::any_of(seen.below.begin(), seen.below.end(),
                                                   [](float below) { return below > 0.0f; }));
    if (!reflects) return 0.0;
    const ChangingAlbedo found = under_water(solve, water);
    if (alike(found, solve.changing)) return 0.0;
    approach(found, solve);
    const PackedField before = std::move(solve.sunlight);
    add_sunlight(solve);
    solve.relit.resize(solve.facets, 0.0f);
    const std::size_t n = solve.changing.facet.size();
    double most = 0.0;
    for (std::size_t f = 0, place = 0; f < solve.facets; ++f) {
        const bool covered = place < n && solve.changing.facet[place] == f;
        const float* const albedo = covered ? &solve.changing.albedo[place++] : nullptr;
        const double change = most_of_an_hour(solve, f, albedo, n, before);
        solve.relit[f] += float(change);
        if (f < solve.counted) most = std::max(most, change);
    }
    for (Block& block : solve.block) {
        for (const auto* face : {&block.facet, &block.behind}) {
            for (const std::size_t f : *face) {
                block.relit = std::max(block.relit, double(solve.relit[f]));
            }
        }
    }
    return most;
}

void find_jumps(SolveState& solve) {
    const SunExposure& sun = solve.input.sun;
    if (sun.edge.empty() || solve.shares.empty()) return;
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
        const double before = solve.shares.at(i, f), after = solve.shares.at(i + 1, f);
        const double whole = beam(i, f) + edge.share * (beam(i + 1, f) - beam(i, f));
        jumps_of[f]->jump.push_back(
            {std::uint32_t(lane_of[f]), edge.share, float((after - before) * whole)});
        ++jumps_of[f]->of[i + 1];
    }
    for (Block& block : solve.block) {
        for (Block::Jumps* const jumps : {&block.front, &block.back}) {
            for (std::size_t i = 1; i < jumps->of.size(); ++i) jumps->of[i] += jumps->of[i - 1];
            jumps->jump.shrink_to_fit();
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
            // (T28) of docs/theory.md
            tilt[f] = float(tilted_sky_excess(sky_of(solve.input.views, solve.input.facets, f)));
        },
        4096);
    return tilt;
}

}  // namespace diurna
