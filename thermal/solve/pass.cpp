#include "thermal/solve/pass.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"

namespace diurna {

Eigen::VectorXd steady_states(const Kind& kind) {
    if (!kind.modes) {
        const std::vector<double> share = steady_column(kind.column.grid).share;
        return Eigen::VectorXd::Map(share.data(), Eigen::Index(share.size()));
    }
    const ReducedColumn& column = kind.modes->reduced;
    const ClosedColumn closed = close_column(column, 1.0);
    // Steady conductance to what lies below: the modes' own, so that they stay where they are.
    const bool open = column.below > 0.0;
    const double conductance = open ? 1.0 / impedance(column, 0.0).real() : 0.0;
    return closed.turn *
           ((conductance + closed.film) * closed.surface.cwiseQuotient(closed.rate)).eval();
}

namespace {

/// Of plates in modes, whose faces answer a shadow's edge within minutes.
constexpr GridOptions plate_grid{.first = 0.02, .growth = 0.15};
constexpr double usual_film = 25.0;  // [W m⁻² K⁻¹] radiation and air together

void settle_block(Job& job, const Level& level, Block& block) {
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
    std::vector<double> heat(block.stride, kind.column.surface.emissivity * sky / n),
        at(block.stride);
    for (std::size_t i = 0; i < job.steps(); ++i) {
        facet_heat(job, block, kind, i, at.data());
        for (std::size_t l = 0; l < count; ++l) heat[l] += at[l] / double(job.steps());
    }
    const Eigen::VectorXd steady = kind.modes ? steady_states(kind) : Eigen::VectorXd();
    const std::size_t states = kind.modes ? std::size_t(steady.size()) : kind.column.grid.size();
    block.start.assign(states * block.stride, 0.0);
    block.film = 0.0;
    for (std::size_t first = 0; first < count; first += lanes) {
        Batch batch;
        batch.resize(kind.column.grid.size(), std::min(lanes, count - first));
        std::copy_n(block.natural.begin() + std::ptrdiff_t(first), batch.count,
                    batch.natural.begin());
        block.film += settle(kind.column, mean, heat.data() + first, batch);
        for (std::size_t l = 0; l < batch.count; ++l) {
            const double t = batch.temperature[l];
            for (std::size_t m = 0; m < states; ++m) {
                block.start[m * block.stride + first + l] =
                    kind.modes ? steady[Eigen::Index(m)] * (t - kind.modes->reduced.reference)
                               : batch.state[m * lanes + l];
            }
            for (std::size_t i = 0; i < job.instant.size(); ++i) {
                job.kelvin[i * job.facets + block.facet[first + l]] = float(t);
            }
        }
    }
}

ModeColumn mode_column(const Job& job, const ThermalSurface& surface, double reference) {
    ReductionOptions options{.largest_error = job.options.mode_error};
    // Of a span that repeats nothing is slower than the span but its mean.
    if (job.options.periodic) options.longest = std::min(options.longest, job.options.duration);
    ModeColumn modes{.reduced = reduce_column(surface.layers, surface.bottom, reference, options),
                     .probe = {}};
    const Eigen::MatrixXd& profile = modes.reduced.profile;
    constexpr Eigen::Index places = 10;
    const Eigen::Index last = profile.rows() - 1;
    modes.probe.resize(places, profile.cols());
    for (Eigen::Index i = 0; i < places; ++i) {
        modes.probe.row(i) = profile.row(i * last / (places - 1));
    }
    return modes;
}

}  // namespace

double absorptance_at(const Job& job, const Kind& kind, std::size_t i) {
    const double measured = job.sky[i].albedo;
    return std::isnan(measured)
               ? kind.column.absorptance()
               : std::max(0.0, 1.0 - measured - kind.column.surface.solar_transmittance);
}

void facet_heat(const Job& job, const Block& block, const Kind& kind, std::size_t i, double* heat) {
    const ThermalSurface& surface = kind.column.surface;
    const double absorptance = absorptance_at(job, kind, i);
    const double tilted = surface.emissivity * job.sky[i].tilted_longwave;
    for (std::size_t l = 0; l < block.facet.size(); ++l) {
        const std::size_t at = i * job.facets + block.facet[l];
        heat[l] = absorptance * job.sunlight[at] + surface.internal_heat;
        if (!job.excess.empty()) heat[l] += surface.emissivity * job.excess[at];
        if (!job.tilt.empty()) heat[l] += tilted * job.tilt[block.facet[l]];
    }
    std::fill(heat + block.facet.size(), heat + block.stride, heat[0]);
}

std::span<const HeatJump> edges_of(const Level& level, const Block& block, std::size_t i) {
    if (level.stride != 1 || block.jumps.empty()) return {};
    return std::span(block.jump).subspan(block.jumps[i - 1], block.jumps[i] - block.jumps[i - 1]);
}

Level make_level(const Job& job, const std::vector<MaterialId>& materials, std::size_t stride,
                 int most_substeps, const Level* finer) {
    const Weather& weather = job.input.weather;
    const double step = job.step * double(stride);
    Level level{.stride = stride, .kind = std::vector<Kind>(materials.size())};
    for_each_index(
        materials.size(),
        [&](std::size_t m) {
            Kind& kind = level.kind[m];
            const ThermalSurface& surface = job.input.materials[materials[m]].thermal;
            const bool thin = job.options.method == Method::modes && surface.back;
            kind.column =
                material_column(surface,
                                {.step = step,
                                 .wind_height = weather.wind_height,
                                 .air_height = weather.air_height,
                                 .reference = weather.at(job.options.start).air.temperature,
                                 .most_substeps = most_substeps,
                                 .refinement = job.options.refinement,
                                 .grid = thin ? plate_grid : job.options.grid},
                                finer ? &finer->kind[m].column.louis : nullptr);
            const auto add = [&](Instant when) {
                const Forcing forcing = weather.at(when);
                // Its longwave needs no sun; to find that one costs more than a step of the facets.
                const SkyState sky = sky_state(SunPosition{0.0, -90.0, 1.0}, job.input.elevation,
                                               forcing, job.input.clear_sky);
                kind.forcing.push_back({air_film(kind.column.surface, kind.column.louis,
                                                 forcing.air, forcing.wind_speed),
                                        sky.longwave_down});
            };
            if (in_modes(job.options, kind.column.surface)) {
                kind.modes = finer ? finer->kind[m].modes
                                   : mode_column(job, kind.column.surface, kind.column.reference);
                add(job.instant[0]);
            }
            // A plate of more nodes than that is no thin plate: it goes layered.
            const bool plate = thin && kind.column.grid.size() <= most_modes;
            if (plate) {
                set_plate_films(kind, usual_film, usual_film, step);
                add(job.instant[0]);
            }
            const int substeps = kind.column.substeps;
            for (std::size_t i = 0; i < job.steps(); i += stride) {
                for (int s = 0; s < substeps; ++s) {
                    if (kind.modes || kind.plate) {
                        add(later(job.instant[i], (s + 1.0) / substeps * step));
                        continue;
                    }
                    for (const double share : stage_share) {
                        add(later(job.instant[i], (s + share) / substeps * step));
                    }
                }
            }
            kind.slope.assign(kind.forcing.size(), 0.0);
            kind.back_slope.assign(kind.plate ? kind.forcing.size() : 0, 0.0);
        },
        1);
    for (const Block& block : job.block) level.kind[block.material].facets += block.facet.size();
    return level;
}

void settle(Job& job, Level& level) {
    for_each_index(
        job.block.size(), [&](std::size_t b) { settle_block(job, level, job.block[b]); }, 4);
    std::vector<double> film(level.kind.size());
    for (const Block& block : job.block) film[block.material] += block.film;
    for (std::size_t k = 0; k < level.kind.size(); ++k) {
        Kind& kind = level.kind[k];
        const double front = film[k] / double(kind.facets);
        if (kind.modes) set_film(kind, front, level_step(job, level));
        if (kind.plate) set_plate_films(kind, front, front, level_step(job, level));
    }
}

double typical_film(const Kind& kind) {
    double sum = 0.0;
    for (const double slope : kind.slope) sum -= slope;
    if (sum > 0.0) return sum / double(kind.slope.size());
    if (kind.plate) return kind.plate->film[0];
    return kind.modes ? kind.modes->closed.film : usual_film;
}

double typical_back_film(const Kind& kind) {
    double sum = 0.0;
    for (const double slope : kind.back_slope) sum -= slope;
    if (sum > 0.0) return sum / double(kind.back_slope.size());
    return kind.plate ? kind.plate->film[1] : usual_film;
}

void set_films(const Job& job, Level& level, const Level& known) {
    for (std::size_t k = 0; k < level.kind.size(); ++k) {
        Kind& kind = level.kind[k];
        const Kind& like = known.kind[k];
        const double step = level_step(job, level);
        if (kind.modes) set_film(kind, typical_film(like), step);
        if (kind.plate) set_plate_films(kind, typical_film(like), typical_back_film(like), step);
    }
}

void pass(Job& job, const Level& level, double progress_from, double progress_to) {
    constexpr std::size_t slices = 8;
    for (std::size_t slice = 0; slice < slices; ++slice) {
        const std::size_t from = job.block.size() * slice / slices;
        const std::size_t to = job.block.size() * (slice + 1) / slices;
        for_each_index(
            to - from,
            [&](std::size_t b) {
                Block& block = job.block[from + b];
                block.rests = block.settled(job.options.tolerance);
                if (block.rests) return;
                if (level.kind[block.material].modes) {
                    run_modes(job, level, block);
                } else if (level.kind[block.material].plate) {
                    run_plates(job, level, block);
                } else {
                    run_layered(job, level, block);
                }
            },
            4);
        if (job.options.progress) {
            job.options.progress(progress_from +
                                 (progress_to - progress_from) * double(slice + 1) / slices);
        }
    }
}

void fill_between(const Job& job, std::vector<float>& field, std::size_t stride) {
    for_each_index(
        job.steps() / stride,
        [&](std::size_t s) {
            const auto a = job.row(field, s * stride), b = job.row(field, (s + 1) * stride);
            for (std::size_t i = 1; i < stride; ++i) {
                const float share = float(i) / float(stride);
                const auto between = job.row(field, s * stride + i);
                for (std::size_t f = 0; f < job.facets; ++f) {
                    between[f] = a[f] + share * (b[f] - a[f]);
                }
            }
        },
        1);
}

}  // namespace diurna
