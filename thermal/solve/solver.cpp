#include "thermal/solve/solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <map>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "terrain/place/sun_path.hpp"
#include "thermal/solve/longwave_exchange.hpp"
#include "thermal/solve/pass.hpp"
#include "thermal/solve/point_facets.hpp"

namespace diurna {

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
}
/// [s] of all threads of this process, so far
double cpu_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

void check(const SolveInput& input, const SolveOptions& options) {
    const std::size_t n = input.facets.size();
    if (n == 0) throw InputError("thermal solve", "the scene has no facets");
    if (!(options.step > 0.0) || !(options.duration > 0.0)) {
        throw InputError("thermal solve", "step and duration must be more than zero");
    }
    if (input.views.sky.size() != n || input.views.below.size() != n ||
        input.views.others.row.size() != n + 1) {
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

/// The largest number of steps that divides the span and takes an hour at most.
std::size_t coarse_stride(const Job& job) {
    auto stride = static_cast<std::size_t>(std::max(1.0, std::floor(3600.0 / job.step + 1e-9)));
    while (job.steps() % stride != 0) --stride;
    return stride;
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
                           .views = given.views,
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
    const bool neighbours = options.exchange && exchanging(input);
    if (neighbours) job.excess.assign(job.instant.size() * job.facets, 0.0f);

    const auto exchange = [&](const Level& level) {
        const auto since = Clock::now();
        const ExchangeChange change = neighbours ? exchange_longwave(job, level) : ExchangeChange{};
        report.exchange_seconds += seconds_since(since);
        return change;
    };
    if (const std::size_t stride = coarse_stride(job); options.periodic && stride > 1) {
        // A day in hours, a few times, leaves a few tenths of a kelvin to the passes that count.
        const int coarse_passes = neighbours ? 4 : 2;
        const auto stepping = Clock::now();
        const double cpu = cpu_seconds(), exchanged = report.exchange_seconds;
        Level coarse = make_level(job, materials, stride, 1, &fine);
        exchange(coarse);
        for (int i = 0; i < coarse_passes; ++i) {
            set_films(job, coarse, i == 0 ? fine : coarse);
            pass(job, coarse, 0.0, 0.0);
            renew_matrices(job, coarse, job.block);
            correct(job, coarse);
            exchange(coarse);
        }
        fill_between(job, job.kelvin, stride);
        if (neighbours) fill_between(job, job.excess, stride);
        set_films(job, fine, coarse);
        for (Block& block : job.block) {
            block.move.clear();
            block.residual = 1e9;
            block.period.reset();
        }
        report.step_seconds += seconds_since(stepping) - (report.exchange_seconds - exchanged);
        report.step_cpu_seconds += cpu_seconds() - cpu;
    } else {
        exchange(fine);
    }

    ScenePoints points(job);
    constexpr double usual_passes = 3.0;
    while (!report.converged && report.passes < options.max_passes) {
        const auto stepping = Clock::now();
        const double cpu = cpu_seconds();
        const double done = std::min(0.95, report.passes / usual_passes);
        pass(job, fine, done, std::min(1.0, done + 1.0 / usual_passes));
        ++report.passes;
        if (report.passes == 1) renew_matrices(job, fine, job.block);
        if (options.periodic) correct(job, fine);
        points.pass(job, fine);
        report.step_seconds += seconds_since(stepping);
        report.step_cpu_seconds += cpu_seconds() - cpu;
        // What the neighbours send by now tells how far the pass was from its surroundings.
        const ExchangeChange change = exchange(fine);
        report.exchange_change = change.heat;
        report.periodic_residual = 0.0;
        report.estimated_error = change.warmer;
        for (const Block& block : job.block) {
            if (!options.periodic) break;
            report.periodic_residual = std::max(report.periodic_residual, block.residual);
            report.estimated_error =
                std::max(report.estimated_error, block.largest_move + change.warmer);
        }
        const ScenePoints::Summary single = points.summary();
        report.periodic_residual = std::max(report.periodic_residual, single.residual);
        report.estimated_error = std::max(report.estimated_error, single.largest_move);
        report.converged = report.periodic_residual <= options.tolerance &&
                           report.estimated_error <= 0.01 && !(single.fresh && neighbours);
    }
    points.put(job);
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
