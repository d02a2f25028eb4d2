#include "thermal/solve/time_level.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "thermal/weather/sky_by_height.hpp"

namespace diurna {

namespace {

/// Of plates in modes, whose faces answer a shadow's edge within minutes.
constexpr GridOptions plate_grid{.first = 0.02, .growth = 0.15};
constexpr double usual_film = 25.0;  // [W m⁻² K⁻¹] radiation and air together

ModeColumn mode_column(const SolveState& solve, const ThermalSurface& surface, double reference) {
    ReductionOptions options{.largest_error = solve.options.mode_error};
    // Of a span that repeats nothing is slower than the span but its mean.
    if (solve.options.periodic && !solve.options.goes_on) {
        options.longest = std::min(options.longest, solve.options.duration);
    }
    ModeColumn modes{.reduced = reduce_column(surface.layers, surface.bottom, reference, options),
                     .probe = {},
                     .quick = solve.options.quick};
    const Eigen::MatrixXd& profile = modes.reduced.profile;
    constexpr Eigen::Index places = 10;
    const Eigen::Index last = profile.rows() - 1;
    modes.probe.resize(places, profile.cols());
    for (Eigen::Index i = 0; i < places; ++i) {
        modes.probe.row(i) = profile.row(i * last / (places - 1));
    }
    return modes;
}

/// Air and sky over a material at some times and all tiers.
void drive(const SolveState& solve, const std::vector<Instant>& when, Kind& kind) {
    const Weather& weather = solve.series.weather();
    kind.times = when.size();
    kind.forcing.resize(solve.tiers.size() * kind.times);
    for (std::size_t i = 0; i < kind.times; ++i) {
        const Forcing now = weather.at(when[i]);
        const SkyState sky = solve.series.dark(when[i]);
        for (std::size_t tier = 0; tier < solve.tiers.size(); ++tier) {
            const double height = solve.tiers.height[tier];
            const bool flat = solve.tiers.flat();
            const AirByHeight* const rule = solve.input.by_height;
            const AirState air = flat ? now.air : air_at_height(*rule, now.air, height);
            kind.forcing[tier * kind.times + i] = {
                air_film(kind.column.surface, kind.column.louis, air, now.wind_speed),
                flat ? sky.longwave_down
                     : sky_at_height(sky, now, air, *rule, height, solve.input.clear_sky)
                           .longwave_down};
        }
    }
}

/// The same air over a material's facets in the lee.
void drive_in_lee(Kind& kind) {
    kind.in_lee = kind.forcing;
    for (StageForcing& forcing : kind.in_lee) forcing.air.kind = FilmKind::sheltered_ground;
}

}  // namespace

Level make_level(const SolveState& solve, const std::vector<KindOf>& kinds, std::size_t stride,
                 int most_substeps, const Level* finer) {
    const Weather& weather = solve.series.weather();
    const double step = solve.step * double(stride);
    const double reference = solve.input.from ? solve.input.from->reference
                                              : weather.at(solve.options.start).air.temperature;
    Level level{.stride = stride, .kind = std::vector<Kind>(kinds.size())};
    for_each_index(
        kinds.size(),
        [&](std::size_t m) {
            Kind& kind = level.kind[m];
            ThermalSurface surface = solve.input.materials[kinds[m].material].thermal;
            if (kinds[m].closed) surface.emissivity = 0.0;
            kind.measured_share = measured_share(solve.input, kinds[m].material);
            const bool thin = solve.options.method == Method::modes && surface.back;
            kind.column = material_column(surface,
                                          {.step = step,
                                           .wind_height = weather.wind_height,
                                           .air_height = weather.air_height,
                                           .reference = reference,
                                           .most_substeps = most_substeps,
                                           .refinement = solve.options.refinement,
                                           .grid = thin ? plate_grid : solve.options.grid},
                                          finer ? &finer->kind[m].column.louis : nullptr);
            std::vector<Instant> when;
            const auto add = [&](Instant time) { when.push_back(time); };
            if (in_modes(solve.options, kind.column.surface)) {
                kind.modes = finer ? finer->kind[m].modes
                                   : mode_column(solve, kind.column.surface, kind.column.reference);
                add(solve.instant[0]);
            }
            // A plate of more nodes than that is no thin plate: it goes layered.
            const bool plate = thin && kind.column.grid.size() <= most_modes;
            if (plate) {
                set_plate_films(kind, usual_film, usual_film, step);
                add(solve.instant[0]);
            }
            const int substeps = kind.column.substeps;
            for (std::size_t i = 0; i < solve.steps(); i += stride) {
                for (int s = 0; s < substeps; ++s) {
                    if (kind.modes || kind.plate) {
                        add(later(solve.instant[i], (s + 1.0) / substeps * step));
                        continue;
                    }
                    for (const double share : stage_share) {
                        add(later(solve.instant[i], (s + share) / substeps * step));
                    }
                }
            }
            drive(solve, when, kind);
            kind.slope.assign(kind.times, 0.0);
            kind.back_slope.assign(kind.plate ? kind.times : 0, 0.0);
        },
        1);
    for (const Block& block : solve.block) {
        Kind& kind = level.kind[block.material];
        kind.facets += block.facet.size();
        if (block.sheltered && kind.in_lee.empty()) drive_in_lee(kind);
    }
    return level;
}

void set_film(Kind& kind, double film, double step) {
    ModeColumn& modes = *kind.modes;
    modes.closed = close_column(modes.reduced, std::max(1.0, film));
    modes.step = make_mode_step(modes.reduced, modes.closed, step / kind.column.substeps);
    modes.step.quick = modes.quick;
}

void set_plate_films(Kind& kind, double front, double back, double step) {
    kind.plate = make_plate_step(kind.column.grid, kind.column.reference, std::max(1.0, front),
                                 std::max(1.0, back), step / kind.column.substeps);
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

void set_films(const SolveState& solve, Level& level, const Level& known) {
    for (std::size_t k = 0; k < level.kind.size(); ++k) {
        Kind& kind = level.kind[k];
        const Kind& like = known.kind[k];
        const double step = level_step(solve, level);
        if (kind.modes) set_film(kind, typical_film(like), step);
        if (kind.plate) set_plate_films(kind, typical_film(like), typical_back_film(like), step);
    }
}

PackedField filled_between(const SolveState& solve, const PackedField& field, std::size_t stride) {
    PackedField fine = PackedField::of_steps(solve.instant.size(), 1, solve.facets);
    for_each_block(solve.facets, 256, [&](std::size_t begin, std::size_t end) {
        std::vector<float> given(field.slots()), values(fine.slots());
        for (std::size_t f = begin; f < end; ++f) {
            field.get(f, given.data());
            for (std::size_t k = 0; k < values.size(); ++k) {
                const std::size_t s = k / stride, next = std::min(s + 1, given.size() - 1);
                const float share = float(k % stride) / float(stride);
                values[k] = given[s] + share * (given[next] - given[s]);
            }
            fine.put(f, values.data());
        }
    });
    return fine;
}

}  // namespace diurna
