#include "thermal/solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <map>

#include "materials/error.hpp"
#include "terrain/parallel.hpp"
#include "thermal/passes.hpp"
#include "thermal/scene_points.hpp"
#include "thermal/sun_path.hpp"

namespace diurna {

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
}
/// [s] of all threads of this process, so far
double cpu_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// Terrain longwave still changing by less than this is settled: what is left of it is a tenth.
constexpr double settled_exchange = 0.5;  // [W m⁻²]

void check(const SolveInput& input, const SolveOptions& options) {
    const std::size_t n = input.facets.size();
    if (n == 0) throw InputError("thermal solve", "the scene has no facets");
    if (!(options.step > 0.0) || !(options.duration > 0.0)) {
        throw InputError("thermal solve", "step and duration must be more than zero");
    }
    if (input.sky_view.sky_view.size() != n || input.sky_view.below.size() != n ||
        input.sky_view.exchange.row.size() != n + 1) {
        throw InputError("thermal solve", "the sky view belongs to another set of facets");
    }
    const std::size_t instants = step_instants(options).size();
    for (std::size_t i = 0; i < input.sun.edge.size(); ++i) {
        const ShadowEdge& edge = input.sun.edge[i];
        if (edge.facet >= n || edge.step + 1 >= instants || !(edge.share >= 0.0f) ||
            edge.share > 1.0f || (i > 0 && edge.step < input.sun.edge[i - 1].step)) {
            throw InputError("thermal solve", "shadow edges must lie in the span, in its order");
        }
    }
    if (!input.sun.fraction.empty() && input.sun.fraction.size() != n * instants) {
        throw InputError("thermal solve",
                         fmt::format("sun exposure has {} values for {} facets and {} instants",
                                     input.sun.fraction.size(), n, instants));
    }
}

/// Cuts the facets into blocks by material. Returns the materials in the order of Block::material.
std::vector<MaterialId> group_by_material(Job& job) {
    std::map<std::size_t, std::size_t> place_of;
    std::vector<MaterialId> materials;
    std::vector<std::size_t> open;  // (material) block still taking facets
    for (std::size_t f = 0; f < job.facets; ++f) {
        const MaterialId id = job.input.facets.material[f];
        const auto [place, is_new] = place_of.try_emplace(index(id), materials.size());
        const std::size_t m = place->second;
        if (is_new) {
            materials.push_back(id);
            open.push_back(0);
        }
        if (is_new || job.block[open[m]].facet.size() == job.block[open[m]].stride) {
            open[m] = job.block.size();
            const ThermalSurface& surface = job.input.materials[id].thermal;
            Block& block = job.block.emplace_back();
            block.material = m;
            block.stride = in_modes(job.options, surface) ? mode_lanes : lanes;
        }
        Block& block = job.block[open[m]];
        block.facet.push_back(f);
        block.natural.push_back(natural_film(job.input.facets.normal[f].z()));
    }
    return materials;
}

void shine(Job& job) {
    job.sunlight.resize(job.instant.size() * job.facets);
    for_each_index(
        job.instant.size(),
        [&](std::size_t i) {
            std::span<const float> fraction;
            if (!job.input.sun.fraction.empty()) {
                fraction = {job.input.sun.fraction.data() + i * job.facets, job.facets};
            }
            incident_sunlight(job.input.facets, job.input.sky_view, job.optics, job.sky[i],
                              fraction, job.options.exchange, job.row(job.sunlight, i));
        },
        1);
}

/// Sunlight that jumps at the shadows' edges: what falls on the facet with the sun's whole disc
/// less what falls on it with none, times the change of the share.
void find_jumps(Job& job) {
    const SunExposure& sun = job.input.sun;
    if (sun.edge.empty()) return;
    std::vector<std::size_t> block_of(job.facets), lane_of(job.facets);
    for (std::size_t b = 0; b < job.block.size(); ++b) {
        job.block[b].jumps.assign(job.instant.size(), 0);
        for (std::size_t l = 0; l < job.block[b].facet.size(); ++l) {
            block_of[job.block[b].facet[l]] = b;
            lane_of[job.block[b].facet[l]] = l;
        }
    }
    const auto beam = [&](std::size_t i, std::size_t f) {
        const SkyState& sky = job.sky[i];
        const double cosine = job.input.facets.normal[f].cast<double>().dot(sky.to_sun);
        return facet_sunlight(sky, cosine, 1.0, job.input.sky_view.sky_view[f]) -
               facet_sunlight(sky, cosine, 0.0, job.input.sky_view.sky_view[f]);
    };
    for (const ShadowEdge& edge : sun.edge) {
        const std::size_t i = edge.step, f = edge.facet;
        const double before = sun.fraction[i * job.facets + f];
        const double after = sun.fraction[(i + 1) * job.facets + f];
        const double whole = beam(i, f) + edge.share * (beam(i + 1, f) - beam(i, f));
        Block& block = job.block[block_of[f]];
        block.jump.push_back({lane_of[f], edge.share, (after - before) * whole});
        ++block.jumps[i + 1];
    }
    for (Block& block : job.block) {
        for (std::size_t i = 1; i < block.jumps.size(); ++i) block.jumps[i] += block.jumps[i - 1];
    }
}

/// What a watt more of longwave does to a facet [K m² W⁻¹], on the material's mean: one that stays
/// all day, and one that comes and goes with it.
struct Response {
    std::vector<float> steady, daily;  // (facet)
};

Response longwave_response(const Job& job, const Level& level) {
    Response response{std::vector<float>(job.facets), std::vector<float>(job.facets)};
    for (const Block& block : job.block) {
        const Kind& kind = level.kind[block.material];
        const double film = typical_film(kind), emissivity = kind.column.surface.emissivity;
        double ground = 0.0, under = 0.0;
        if (kind.modes) {
            const ReducedColumn& column = kind.modes->reduced;
            ground = 1.0 / std::abs(impedance(column, 2.0 * M_PI / 86400.0));
            under = column.below > 0.0 ? 1.0 / std::abs(impedance(column, 0.0)) : 0.0;
        }
        // A thin plate's back gives off about as much as its front.
        if (job.input.materials[job.input.facets.material[block.facet.front()]].thermal.back) {
            ground = under = typical_back_film(kind);
        }
        for (const std::size_t f : block.facet) {
            response.steady[f] = float(emissivity / (film + under));
            response.daily[f] = float(emissivity / (film + ground));
        }
    }
    return response;
}

/// Renews the terrain's longwave from the temperatures of the last pass, then twice more from what
/// these become under the longwave found, to first order: neighbours that warm each other settle
/// within a pass. Returns the largest change of the first and tells each block its own.
double exchange_longwave(Job& job, const Level& level) {
    constexpr int sweeps = 3;
    const std::size_t used = job.steps() / level.stride + 1;  // instants that this level lands on
    const Response response = longwave_response(job, level);
    const std::vector<float> before = job.excess;
    std::vector<float> leaving(used * job.facets);  // (facet, instant)
    std::vector<float> change(job.facets), first_change;
    std::vector<float> mean(job.facets, 0.0f);  // of the longwave beyond `before`
    constexpr std::size_t facets_at_once = 256;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
        for_each_block(job.facets, facets_at_once, [&](std::size_t begin, std::size_t end) {
            for (std::size_t k = 0; k < used; ++k) {
                const std::size_t i = k * level.stride;
                for (std::size_t f = begin; f < end; ++f) {
                    const std::size_t at = i * job.facets + f;
                    float kelvin = job.kelvin[at];
                    if (sweep > 0) {
                        const float beyond = job.excess[at] - before[at];
                        kelvin +=
                            response.steady[f] * mean[f] + response.daily[f] * (beyond - mean[f]);
                    }
                    leaving[f * used + k] = leaving_longwave(
                        job.optics.emissivity[f], job.sky[i].longwave_down, kelvin, job.excess[at]);
                }
            }
        });
        for_each_block(job.facets, facets_at_once, [&](std::size_t begin, std::size_t end) {
            std::vector<float> arriving((end - begin) * used);
            for (std::size_t f = begin; f < end; ++f) {
                arriving_longwave(job.input.sky_view, leaving, f,
                                  std::span(arriving).subspan((f - begin) * used, used));
                change[f] = mean[f] = 0.0f;
            }
            for (std::size_t k = 0; k < used; ++k) {
                for (std::size_t f = begin; f < end; ++f) {
                    const std::size_t at = k * level.stride * job.facets + f;
                    const float next = arriving[(f - begin) * used + k];
                    change[f] = std::max(change[f], std::abs(next - job.excess[at]));
                    job.excess[at] = next;
                    mean[f] += (next - before[at]) / float(used);
                }
            }
        });
        if (sweep == 0) first_change = change;
    }
    for_each_index(
        job.block.size(),
        [&](std::size_t b) {
            Block& block = job.block[b];
            float most = 0.0f;
            for (const std::size_t f : block.facet) most = std::max(most, change[f]);
            block.heat_change += double(most);
            // The start follows what stays all day; the passes find the rest.
            const Kind& kind = level.kind[block.material];
            if (!job.options.periodic || most < 0.05f || block.change.empty()) return;
            const Eigen::VectorXd steady = steady_states(kind);
            for (std::size_t l = 0; l < block.facet.size(); ++l) {
                const std::size_t f = block.facet[l];
                const double warmer = response.steady[f] * mean[f];
                for (Eigen::Index m = 0; m < steady.size(); ++m) {
                    block.start[std::size_t(m) * block.stride + l] += warmer * steady[m];
                }
            }
        },
        16);
    return *std::max_element(first_change.begin(), first_change.end());
}

/// The largest number of steps that divides the span and takes an hour at most.
std::size_t coarse_stride(const Job& job) {
    auto stride = static_cast<std::size_t>(std::max(1.0, std::floor(3600.0 / job.step + 1e-9)));
    while (job.steps() % stride != 0) --stride;
    return stride;
}

/// What each facet sees of a sky brighter towards the horizon, where any instant's is.
std::vector<float> tilts(const Job& job) {
    const bool even = std::all_of(job.sky.begin(), job.sky.end(),
                                  [](const SkyState& sky) { return sky.tilted_longwave == 0.0; });
    if (even) return {};
    const TiltedSky table;
    std::vector<float> tilt(job.facets);
    for_each_index(
        job.facets,
        [&](std::size_t f) {
            tilt[f] =
                float(table.excess(job.input.facets.normal[f].z(), job.input.sky_view.sky_view[f]));
        },
        4096);
    return tilt;
}

TemperatureField kept(const Job& job) {
    const auto every = std::max<std::size_t>(
        1, static_cast<std::size_t>(std::llround(job.options.keep_every / job.step)));
    TemperatureField field{.instant = {}, .facets = job.facets, .kelvin = {}};
    for (std::size_t i = 0; i < job.instant.size(); i += every) {
        field.instant.push_back(job.instant[i]);
        const auto row = job.kelvin.begin() + static_cast<std::ptrdiff_t>(i * job.facets);
        field.kelvin.insert(field.kelvin.end(), row, row + static_cast<std::ptrdiff_t>(job.facets));
    }
    return field;
}

}  // namespace

std::vector<Instant> step_instants(const SolveOptions& options) {
    const auto steps = std::max(1LL, std::llround(options.duration / options.step));
    std::vector<Instant> instants;
    for (long long i = 0; i <= steps; ++i) {
        instants.push_back(later(options.start, options.duration * double(i) / double(steps)));
    }
    return instants;
}

SolveResult solve(const SolveInput& given, const SolveOptions& options) {
    const auto begun = Clock::now();
    check(given, options);
    Weather weather = given.weather;
    if (std::any_of(weather.sample.begin(), weather.sample.end(),
                    [](const Forcing& f) { return std::isnan(f.longwave_down); })) {
        infer_cloud(weather, given.site, given.elevation, given.clear_sky);
    }
    const SolveInput input{.facets = given.facets,
                           .sky_view = given.sky_view,
                           .sun = given.sun,
                           .materials = given.materials,
                           .weather = weather,
                           .site = given.site,
                           .elevation = given.elevation,
                           .clear_sky = given.clear_sky};
    Job job{.input = input,
            .options = options,
            .instant = step_instants(options),
            .step = 0.0,
            .facets = input.facets.size(),
            .optics = {},
            .sky = {},
            .sunlight = {},
            .excess = {},
            .kelvin = {},
            .block = {}};
    job.step = options.duration / double(job.steps());
    job.optics = facet_optics(input.facets, input.materials);
    SunPath path(input.site);
    for (const Instant when : job.instant) {
        job.sky.push_back(
            sky_state(path.at(when), input.elevation, input.weather.at(when), input.clear_sky));
    }
    job.tilt = tilts(job);
    const std::vector<MaterialId> materials = group_by_material(job);
    Level fine = make_level(job, materials, 1, StepSetup{}.most_substeps);

    SolveReport report{.facets = job.facets, .steps = int(job.steps())};
    const auto shining = Clock::now();
    shine(job);
    find_jumps(job);
    report.shortwave_seconds = seconds_since(shining);

    job.kelvin.resize(job.instant.size() * job.facets);
    settle(job, fine);
    const bool exchanging =
        options.exchange && (!input.sky_view.exchange.facet.empty() ||
                             std::any_of(input.sky_view.below.begin(), input.sky_view.below.end(),
                                         [](float below) { return below > 0.0f; }));
    if (exchanging) job.excess.assign(job.instant.size() * job.facets, 0.0f);

    const auto exchange = [&](const Level& level) {
        const auto since = Clock::now();
        if (exchanging) report.exchange_change = exchange_longwave(job, level);
        report.exchange_seconds += seconds_since(since);
    };
    if (const std::size_t stride = coarse_stride(job); options.periodic && stride > 1) {
        // A day in hours, a few times, leaves a few tenths of a kelvin to the passes that count.
        const int coarse_passes = exchanging ? 4 : 2;
        const auto stepping = Clock::now();
        const double cpu = cpu_seconds();
        Level coarse = make_level(job, materials, stride, 1, &fine);
        for (int i = 0; i < coarse_passes; ++i) {
            exchange(coarse);
            set_films(job, coarse, i == 0 ? fine : coarse);
            pass(job, coarse, 0.0, 0.0);
            renew_matrices(job, coarse);
            correct(job, coarse, false);
            fill_between(job, job.kelvin, stride);
            if (exchanging) fill_between(job, job.excess, stride);
        }
        set_films(job, fine, coarse);
        for (Block& block : job.block) {
            block.move.clear();
            block.residual = 1e9;
        }
        report.step_seconds += seconds_since(stepping);
        report.step_cpu_seconds += cpu_seconds() - cpu;
    }

    ScenePoints points(job);
    constexpr double usual_passes = 3.0;
    while (!report.converged && report.passes < options.max_passes) {
        // The change just made tells how far the pass before was from its surroundings.
        exchange(fine);
        const auto stepping = Clock::now();
        const double cpu = cpu_seconds();
        const double done = std::min(0.95, report.passes / usual_passes);
        pass(job, fine, done, std::min(1.0, done + 1.0 / usual_passes));
        points.pass(job, fine);
        ++report.passes;
        if (options.periodic) {
            if (report.passes == 1) renew_matrices(job, fine);
            correct(job, fine, report.exchange_change < 0.01);
        }
        report.periodic_residual = report.estimated_error = 0.0;
        for (const Block& block : job.block) {
            if (!options.periodic) break;
            report.periodic_residual = std::max(report.periodic_residual, block.residual);
            report.estimated_error = std::max(report.estimated_error, block.largest_move);
        }
        const ScenePoints::Summary single = points.summary();
        report.periodic_residual = std::max(report.periodic_residual, single.residual);
        report.estimated_error = std::max(report.estimated_error, single.largest_move);
        report.step_seconds += seconds_since(stepping);
        report.step_cpu_seconds += cpu_seconds() - cpu;
        report.converged =
            report.periodic_residual <= options.tolerance && report.estimated_error <= 0.01 &&
            report.exchange_change <= settled_exchange && !(single.fresh && exchanging);
    }
    StepRecord record;
    for (const Block& block : job.block) record.merge(block.record);
    const ScenePoints::Summary single = points.summary();
    report.points = points.size();
    report.point_passes = single.worst_passes;
    report.limited = single.limited;
    report.worst_energy_closure = std::max(record.worst_closure, single.worst_closure);
    report.newton_iterations = double(record.iterations) / double(std::max(1LL, record.stages));
    report.worst_newton_iterations = record.worst_iterations;
    report.bisections = record.bisections;
    const auto [coldest, warmest] = std::minmax_element(job.kelvin.begin(), job.kelvin.end());
    report.coldest = *coldest;
    report.warmest = *warmest;
    SolveResult result{.temperature = kept(job), .report = report};
    result.report.seconds = seconds_since(begun);
    if (options.progress) options.progress(1.0);
    return result;
}

}  // namespace diurna
