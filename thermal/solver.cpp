#include "thermal/solver.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <optional>

#include "materials/error.hpp"
#include "terrain/parallel.hpp"
#include "thermal/batch.hpp"
#include "thermal/surroundings.hpp"

namespace diurna {

namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
}

/// Terrain longwave still changing by less than this is settled: what is left of it is a tenth.
constexpr double settled_exchange = 0.5;  // [W m⁻²]

/// Up to `lanes` facets of one material and their state at the start of the span.
struct Block {
    std::size_t material;  // index into Job::material
    std::vector<std::size_t> facet;
    std::vector<NaturalFilm> natural;
    std::vector<double> start, change;  // [node][lane] relative; change over the last pass
    std::vector<double> move, planned;  // [node][lane] of the start after the pass before: what
                                        // was done, and what the material's matrix alone would do
    double residual = 1e9;              // [K] largest of `change`
    double heat_change = 1e9;           // [W m⁻²] of the terrain's longwave since the last run
    double largest_move = 1e9;          // [K] of `move`
    bool rests = false;                 // left out of the last pass
    StepRecord record;                  // of the last run
    std::vector<double> slope;          // (step, substep, stage) Σ over facets, of the last run

    /// Running it again would change nothing that counts: 0.05 W/m² of longwave are 3 mK.
    bool settled(double tolerance) const { return residual <= tolerance && heat_change <= 0.05; }
};

struct StageForcing {
    AirFilm air;
    double sky_longwave;
};

/// One material of the scene with the forcing its facets share.
struct Kind {
    MaterialColumn column;
    std::vector<StageForcing> forcing;  // (step, substep, stage)
    std::vector<double> slope;          // (step, substep, stage) mean surface slope, last pass
    std::size_t facets = 0;
    /// (I − M)⁻¹ of the linearised period.
    std::optional<Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>> period{};
};

/// A way to step the span: every `stride` instants at once.
struct Level {
    std::size_t stride = 1;
    std::vector<Kind> kind;
};

struct Job {
    const SolveInput& input;
    const SolveOptions& options;
    std::vector<Instant> instant;
    double step;  // [s]
    std::size_t facets;
    FacetOptics optics;
    std::vector<SkyState> sky;    // (instant)
    std::vector<float> sunlight;  // (instant, facet) incident
    std::vector<float> excess;    // (instant, facet) terrain longwave; empty without exchange
    std::vector<float> kelvin;    // (instant, facet)
    std::vector<Block> block;

    std::size_t steps() const { return instant.size() - 1; }
    std::span<float> row(std::vector<float>& field, std::size_t i) const {
        return {field.data() + i * facets, facets};
    }
};

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
        if (is_new || job.block[open[m]].facet.size() == lanes) {
            open[m] = job.block.size();
            job.block.emplace_back().material = m;
        }
        Block& block = job.block[open[m]];
        block.facet.push_back(f);
        block.natural.push_back(natural_film(job.input.facets.normal[f].z()));
    }
    return materials;
}

Level make_level(const Job& job, const std::vector<MaterialId>& materials, std::size_t stride,
                 int most_substeps) {
    const Weather& weather = job.input.weather;
    const double step = job.step * double(stride);
    Level level{.stride = stride, .kind = std::vector<Kind>(materials.size())};
    for_each_index(
        materials.size(),
        [&](std::size_t m) {
            Kind& kind = level.kind[m];
            kind.column =
                material_column(job.input.materials[materials[m]].thermal,
                                {.step = step,
                                 .wind_height = weather.wind_height,
                                 .air_height = weather.air_height,
                                 .reference = weather.at(job.options.start).air.temperature,
                                 .most_substeps = most_substeps,
                                 .refinement = job.options.refinement,
                                 .grid = {}});
            const int substeps = kind.column.substeps;
            for (std::size_t i = 0; i < job.steps(); i += stride) {
                for (int s = 0; s < substeps; ++s) {
                    for (const double share : stage_share) {
                        const Instant when = later(job.instant[i], (s + share) / substeps * step);
                        const Forcing forcing = weather.at(when);
                        const SkyState sky = sky_state(job.input.site, job.input.elevation, when,
                                                       forcing, job.input.clear_sky);
                        kind.forcing.push_back({air_film(kind.column.surface, kind.column.louis,
                                                         forcing.air, forcing.wind_speed),
                                                sky.longwave_down});
                    }
                }
            }
            kind.slope.assign(kind.forcing.size(), 0.0);
        },
        1);
    for (const Block& block : job.block) level.kind[block.material].facets += block.facet.size();
    return level;
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

/// Renews the terrain's longwave from the temperatures of the last pass. Returns its largest change
/// and tells each block its own.
double exchange_longwave(Job& job) {
    std::vector<float> leaving(job.kelvin.size()), change(job.facets, 0.0f);
    for_each_index(
        job.instant.size(),
        [&](std::size_t i) {
            leaving_longwave(job.optics, job.sky[i].longwave_down, job.row(job.kelvin, i),
                             job.row(job.excess, i), job.row(leaving, i));
        },
        1);
    for_each_block(job.facets, 2048, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = 0; i < job.instant.size(); ++i) {
            arriving_longwave(job.input.sky_view, job.row(leaving, i), begin, end,
                              job.row(job.excess, i), change);
        }
    });
    for (Block& block : job.block) {
        double most = 0.0;
        for (const std::size_t f : block.facet) {
            most = std::max(most, double(change[f]));
        }
        block.heat_change += most;
    }
    return *std::max_element(change.begin(), change.end());
}

/// Heat at a step's end that differs from facet to facet: sun, terrain longwave, internal.
void facet_heat(const Job& job, const Block& block, const Kind& kind, std::size_t i, double* heat) {
    const ThermalSurface& surface = kind.column.surface;
    const double measured = job.sky[i].albedo;
    const double absorptance = std::isnan(measured)
                                   ? kind.column.absorptance()
                                   : std::max(0.0, 1.0 - measured - surface.solar_transmittance);
    for (std::size_t l = 0; l < block.facet.size(); ++l) {
        const std::size_t at = i * job.facets + block.facet[l];
        heat[l] = absorptance * job.sunlight[at] + surface.internal_heat;
        if (!job.excess.empty()) heat[l] += surface.emissivity * job.excess[at];
    }
}

/// First guess: every facet's steady state under its mean forcing over the span.
void settle(Job& job, const Level& level, Block& block) {
    const Kind& kind = level.kind[block.material];
    const std::size_t count = block.facet.size();
    AirFilm mean = kind.forcing.front().air;
    double sky = 0.0, sums[5] = {};
    for (const StageForcing& forcing : kind.forcing) {
        sky += forcing.sky_longwave;
        sums[0] += forcing.air.air_temperature;
        sums[1] += forcing.air.neutral;
        sums[2] += forcing.air.instability;
        sums[3] += forcing.air.vapour_pressure;
    }
    const double n = double(kind.forcing.size());
    mean.air_temperature = sums[0] / n;
    mean.neutral = sums[1] / n;
    mean.instability = sums[2] / n;
    mean.vapour_pressure = sums[3] / n;
    double heat[lanes] = {}, at[lanes];
    for (std::size_t i = 0; i < job.steps(); ++i) {
        facet_heat(job, block, kind, i, at);
        for (std::size_t l = 0; l < count; ++l) heat[l] += at[l] / double(job.steps());
    }
    for (std::size_t l = 0; l < count; ++l) {
        heat[l] += kind.column.surface.emissivity * sky / n;
    }
    Batch batch;
    batch.resize(kind.column.grid.size(), count);
    std::copy(block.natural.begin(), block.natural.end(), batch.natural.begin());
    settle(kind.column, mean, heat, batch);
    block.start = batch.state;
    for (std::size_t i = 0; i < job.instant.size(); ++i) {
        for (std::size_t l = 0; l < count; ++l) {
            job.kelvin[i * job.facets + block.facet[l]] = float(batch.temperature[l]);
        }
    }
}

/// Runs one block over the span; writes its temperatures, change and mean surface slopes.
void run(Job& job, const Level& level, Block& block) {
    const Kind& kind = level.kind[block.material];
    const int substeps = kind.column.substeps;
    const std::size_t count = block.facet.size();
    const double emissivity = kind.column.surface.emissivity;
    Batch batch;
    batch.resize(kind.column.grid.size(), count);
    batch.state = block.start;
    std::copy(block.natural.begin(), block.natural.end(), batch.natural.begin());
    block.slope.assign(kind.forcing.size(), 0.0);
    StepRecord record;

    double before[lanes], after[lanes], heat[2][lanes];
    facet_heat(job, block, kind, 0, before);
    for (std::size_t l = 0; l < count; ++l) {
        batch.temperature[l] = batch.state[l] + kind.column.reference;
        job.kelvin[block.facet[l]] = float(batch.temperature[l]);
    }
    std::size_t stage = 0;
    for (std::size_t i = level.stride; i <= job.steps(); i += level.stride) {
        facet_heat(job, block, kind, i, after);
        for (int s = 0; s < substeps; ++s, stage += 2) {
            for (int k = 0; k < 2; ++k) {
                const double share = (s + stage_share[k]) / substeps;
                const double sky = emissivity * kind.forcing[stage + k].sky_longwave;
                for (std::size_t l = 0; l < count; ++l) {
                    heat[k][l] = before[l] + share * (after[l] - before[l]) + sky;
                }
            }
            advance(kind.column, {kind.forcing[stage].air, kind.forcing[stage + 1].air},
                    {heat[0], heat[1]}, batch, record);
            block.slope[stage] = record.slope[0];
            block.slope[stage + 1] = record.slope[1];
        }
        float* row = job.kelvin.data() + i * job.facets;
        for (std::size_t l = 0; l < count; ++l) row[block.facet[l]] = float(batch.temperature[l]);
        std::swap(before, after);
    }
    block.record = record;
    block.residual = block.heat_change = 0.0;
    block.change.resize(batch.state.size());
    for (std::size_t i = 0; i < kind.column.grid.size(); ++i) {
        for (std::size_t l = 0; l < count; ++l) {
            const std::size_t at = i * lanes + l;
            block.change[at] = batch.state[at] - block.start[at];
            block.residual = std::max(block.residual, std::abs(block.change[at]));
        }
    }
}

/// Factors I − M, M the derivative of the period map with the mean slopes of this material.
void linearise(Kind& kind) {
    const auto n = static_cast<Eigen::Index>(kind.column.grid.size());
    Eigen::MatrixXd map = Eigen::MatrixXd::Identity(n, n);
    for (std::size_t stage = 0; stage < kind.slope.size(); stage += 2) {
        linear_step(kind.column.grid, kind.column.stage, kind.slope[stage], kind.slope[stage + 1],
                    map);
    }
    kind.period.emplace();
    // A column that loses nothing keeps its heat for ever; its mean is then left as it is.
    kind.period->setThreshold(1e-9);
    kind.period->compute(Eigen::MatrixXd::Identity(n, n) - map);
}

/// Moves a block's start by (I − M)⁻¹ times its change. The matrix
/// belongs to the material's mean facet; Broyden's update by the move before fits it to each.
/// `secant`: whether that move's effect is all that has changed since.
void correct(const Kind& kind, Block& block, bool secant) {
    const auto n = static_cast<Eigen::Index>(kind.column.grid.size());
    const auto count = static_cast<Eigen::Index>(block.facet.size());
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    using Strided = Eigen::Map<Rows, 0, Eigen::OuterStride<>>;
    const Eigen::OuterStride<> stride{Eigen::Index(lanes)};
    const bool update = secant && !block.move.empty();
    block.move.resize(block.start.size());
    block.planned.resize(block.start.size());
    Strided start(block.start.data(), n, count, stride);
    Strided done(block.move.data(), n, count, stride);
    Strided planned(block.planned.data(), n, count, stride);
    const Eigen::MatrixXd change = Strided(block.change.data(), n, count, stride);
    const Eigen::MatrixXd plan = kind.period->solve(change);
    Eigen::MatrixXd move = plan;
    for (Eigen::Index l = 0; update && l < count; ++l) {
        // Of the move `done` the matrix explains `explained`.
        const Eigen::VectorXd explained = planned.col(l) - plan.col(l);
        const double along = done.col(l).dot(explained);
        // Not `<`: a facet that has arrived did not move, and 0 < 0 would let 0 / 0 through.
        if (!(along > 0.1 * done.col(l).squaredNorm())) continue;
        move.col(l) += (done.col(l) - explained) * (done.col(l).dot(plan.col(l)) / along);
    }
    start += move;
    done = move;
    planned = plan;
    block.largest_move = move.cwiseAbs().maxCoeff();
}

/// One pass over the span for all blocks that have not settled.
void pass(Job& job, Level& level, double progress_from, double progress_to) {
    constexpr std::size_t slices = 8;
    for (std::size_t slice = 0; slice < slices; ++slice) {
        const std::size_t from = job.block.size() * slice / slices;
        const std::size_t to = job.block.size() * (slice + 1) / slices;
        for_each_index(
            to - from,
            [&](std::size_t b) {
                Block& block = job.block[from + b];
                block.rests = block.settled(job.options.tolerance);
                if (!block.rests) run(job, level, block);
            },
            4);
        if (job.options.progress) {
            job.options.progress(progress_from +
                                 (progress_to - progress_from) * double(slice + 1) / slices);
        }
    }
}

/// Mean surface slopes of each material over the last pass, and the period's matrix from them.
void renew_matrices(const Job& job, Level& level) {
    for (Kind& kind : level.kind) std::fill(kind.slope.begin(), kind.slope.end(), 0.0);
    for (const Block& block : job.block) {
        Kind& kind = level.kind[block.material];
        for (std::size_t i = 0; i < kind.slope.size(); ++i) {
            kind.slope[i] += block.slope[i] / double(kind.facets);
        }
    }
    for_each_index(
        level.kind.size(), [&](std::size_t k) { linearise(level.kind[k]); }, 1);
}

/// Corrects the start of every block that ran.
void correct(Job& job, const Level& level, bool secant) {
    for_each_index(
        job.block.size(),
        [&](std::size_t b) {
            Block& block = job.block[b];
            if (!block.rests) correct(level.kind[block.material], block, secant);
        },
        16);
}

/// Temperatures at the instants a coarse level steps over, on the line between those it lands on.
void fill_between(Job& job, std::size_t stride) {
    for_each_index(
        job.steps() / stride,
        [&](std::size_t s) {
            const auto a = job.row(job.kelvin, s * stride),
                       b = job.row(job.kelvin, (s + 1) * stride);
            for (std::size_t i = 1; i < stride; ++i) {
                const float share = float(i) / float(stride);
                const auto between = job.row(job.kelvin, s * stride + i);
                for (std::size_t f = 0; f < job.facets; ++f) {
                    between[f] = a[f] + share * (b[f] - a[f]);
                }
            }
        },
        1);
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
    for (const Instant when : job.instant) {
        job.sky.push_back(
            sky_state(input.site, input.elevation, when, input.weather.at(when), input.clear_sky));
    }
    const std::vector<MaterialId> materials = group_by_material(job);
    Level fine = make_level(job, materials, 1, StepSetup{}.most_substeps);

    SolveReport report{.facets = job.facets, .steps = int(job.steps())};
    const auto shining = Clock::now();
    shine(job);
    report.shortwave_seconds = seconds_since(shining);

    job.kelvin.resize(job.instant.size() * job.facets);
    for_each_index(
        job.block.size(), [&](std::size_t b) { settle(job, fine, job.block[b]); }, 4);
    const bool exchanging =
        options.exchange && (!input.sky_view.exchange.facet.empty() ||
                             std::any_of(input.sky_view.below.begin(), input.sky_view.below.end(),
                                         [](float below) { return below > 0.0f; }));
    if (exchanging) job.excess.assign(job.instant.size() * job.facets, 0.0f);

    const auto exchange = [&] {
        const auto since = Clock::now();
        if (exchanging) report.exchange_change = exchange_longwave(job);
        report.exchange_seconds += seconds_since(since);
    };
    if (const std::size_t stride = coarse_stride(job); options.periodic && stride > 1) {
        // A day in hours, twice, leaves a few tenths of a kelvin to the passes that count.
        const auto stepping = Clock::now();
        Level coarse = make_level(job, materials, stride, 1);
        for (int i = 0; i < 3; ++i) {
            exchange();
            pass(job, coarse, 0.0, 0.0);
            renew_matrices(job, coarse);
            correct(job, coarse, false);
            fill_between(job, stride);
        }
        for (Block& block : job.block) {
            block.move.clear();
            block.residual = 1e9;
        }
        report.step_seconds += seconds_since(stepping);
    }

    constexpr double usual_passes = 3.0;
    while (!report.converged && report.passes < options.max_passes) {
        // The change just made tells how far the pass before was from its surroundings.
        exchange();
        const auto stepping = Clock::now();
        const double done = std::min(0.95, report.passes / usual_passes);
        pass(job, fine, done, std::min(1.0, done + 1.0 / usual_passes));
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
        report.step_seconds += seconds_since(stepping);
        report.converged = report.periodic_residual <= options.tolerance &&
                           report.estimated_error <= 0.01 &&
                           report.exchange_change <= settled_exchange;
    }
    StepRecord record;
    for (const Block& block : job.block) record.merge(block.record);
    report.worst_energy_closure = record.worst_closure;
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
