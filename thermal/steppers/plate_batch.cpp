#include "thermal/steppers/plate_batch.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

/// The air on the two faces: from behind, up is down.
struct TwoAirs {
    const AirFilm& air;
    double emissivity[2];
    double arriving;  // [W m⁻²] that the back absorbs of surroundings as warm as the air

    TwoAirs(const ThermalSurface& surface, const AirFilm& given)
        : air(given),
          emissivity{surface.emissivity, surface.back->emissivity},
          arriving(surface.back->emissivity * stefan_boltzmann * power4(given.air_temperature)) {}
};

/// Heat into one face [W m⁻²], all but `heat` on the front, and d/dT.
template <bool Plate, bool Wet>
[[gnu::always_inline]] inline void face_flux(const AirFilm& air, NaturalFilm natural,
                                             double emissivity, double t, double& flux,
                                             double& slope) {
    const Film film = Plate ? plate_film(air, natural, t) : ground_film(air, t);
    const double cube = emissivity * stefan_boltzmann * t * t * t;
    flux = -cube * t - film.h * (t - air.air_temperature);
    slope = -4.0 * cube - film.h - film.rise;
    if (Wet) {
        const LatentHeat latent = latent_heat(air, film, t);
        flux += latent.flux;
        slope += latent.slope;
    }
}

/// A plate's two equations u = F(T) + heat + film θ, θ = base + response u.
struct Faces {
    double base[2];      // [K] θ without the step's own drive
    double heat[2];      // [W m⁻²]
    double response[3];  // front, across, back
};

constexpr double near_enough = 1e-8;  // [K] of the last correction, which has been applied
constexpr int newton_steps = 12;
constexpr int steps_after_jump = 2;  // in parts

/// By halving within halving: every face's balance falls with its own temperature and rises with
/// the other's.
template <bool Plate, bool Wet>
void solve_slowly(const TwoAirs& airs, NaturalFilm natural, const double film[2], double reference,
                  const Faces& faces, double drive[2]) {
    const double* const r = faces.response;
    const double scale = 1.0 / (r[0] * r[2] - r[1] * r[1]);
    const NaturalFilm sides[2]{natural, {natural.cold, natural.warm}};
    const auto balance = [&](int k, const double t[2]) {
        double flux, slope;
        if (k == 0) {
            face_flux<Plate, Wet>(airs.air, sides[0], airs.emissivity[0], t[0], flux, slope);
        } else {
            face_flux<Plate, false>(airs.air, sides[1], airs.emissivity[1], t[1], flux, slope);
        }
        const double beyond[2]{t[0] - reference - faces.base[0], t[1] - reference - faces.base[1]};
        const double u = scale * (k == 0 ? r[2] * beyond[0] - r[1] * beyond[1]
                                         : r[0] * beyond[1] - r[1] * beyond[0]);
        return flux + faces.heat[k] + film[k] * (t[k] - reference) - u;
    };
    constexpr int halvings = 60;
    double t[2], low = 1.0, high = 5000.0;
    for (int i = 0; i < halvings; ++i) {
        t[0] = 0.5 * (low + high);
        double cold = 1.0, hot = 5000.0;
        for (int j = 0; j < halvings; ++j) {
            t[1] = 0.5 * (cold + hot);
            (balance(1, t) > 0.0 ? cold : hot) = t[1];
        }
        (balance(0, t) > 0.0 ? low : high) = t[0];
    }
    for (int k = 0; k < 2; ++k) {
        const double beyond[2]{t[0] - reference - faces.base[0], t[1] - reference - faces.base[1]};
        drive[k] = scale * (k == 0 ? r[2] * beyond[0] - r[1] * beyond[1]
                                   : r[0] * beyond[1] - r[1] * beyond[0]);
    }
}

/// One plate: drive in as a guess, out as the root.
template <bool Plate, bool Wet>
void solve_faces(const TwoAirs& airs, NaturalFilm natural, const double film[2], double reference,
                 const Faces& faces, double drive[2], StepRecord& record) {
    const double* const r = faces.response;
    const NaturalFilm behind{natural.cold, natural.warm};
    for (int i = 0; i < newton_steps; ++i) {
        const double front = faces.base[0] + r[0] * drive[0] + r[1] * drive[1];
        const double back = faces.base[1] + r[1] * drive[0] + r[2] * drive[1];
        double flux[2], slope[2];
        face_flux<Plate, Wet>(airs.air, natural, airs.emissivity[0], front + reference, flux[0],
                              slope[0]);
        face_flux<Plate, false>(airs.air, behind, airs.emissivity[1], back + reference, flux[1],
                                slope[1]);
        const double g0 = slope[0] + film[0], g1 = slope[1] + film[1];
        const double left0 = flux[0] + faces.heat[0] + film[0] * front - drive[0];
        const double left1 = flux[1] + faces.heat[1] + film[1] * back - drive[1];
        const double scale = 1.0 / ((1.0 - g0 * r[0]) * (1.0 - g1 * r[2]) - g0 * g1 * r[1] * r[1]);
        const double more0 = scale * ((1.0 - g1 * r[2]) * left0 + g0 * r[1] * left1);
        const double more1 = scale * ((1.0 - g0 * r[0]) * left1 + g1 * r[1] * left0);
        drive[0] += more0;
        drive[1] += more1;
        if (std::abs(r[0] * more0 + r[1] * more1) + std::abs(r[1] * more0 + r[2] * more1) <=
            near_enough) {
            return;
        }
    }
    ++record.bisections;
    solve_slowly<Plate, Wet>(airs, natural, film, reference, faces, drive);
}

/// The whole step of one plate whose heat jumps within it, from its state before.
template <bool Plate, bool Wet>
void split_plate(const PlateStep& step, const ThermalSurface& surface, const ModeForcing& forcing,
                 const HeatJump& jump, double* x, double drive[2], NaturalFilm natural,
                 StepRecord& record) {
    const std::size_t l = jump.lane, modes = step.modes();
    const double smooth = forcing.heat[l] - forcing.heat_before[l] - jump.heat;
    const double left = 1.0 - jump.share;
    double begin = 0.0;
    for (int part = 0; part <= parts_after_jump; ++part) {
        // Part 0 leads to the jump, the others from there to the step's end.
        const double end = jump.share + left * part_after_jump[part];
        const double length = (end - begin) * step.step;
        const AirFilm air = air_between(forcing.air_before, forcing.air, end);
        const TwoAirs airs(surface, air);
        if (part == 1) drive[0] += jump.heat;
        Faces faces{.base = {},
                    .heat = {forcing.heat_before[l] + end * smooth + (part > 0 ? jump.heat : 0.0),
                             airs.arriving},
                    .response = {}};
        double weight[most_modes];
        assert(modes <= most_modes);
        for (std::size_t m = 0; m < modes; ++m) {
            const StepWeights p = step_weights(step.rate[m] * length);
            const double f0 = step.face[0][m], f1 = step.face[1][m];
            x[m] = p.decay * x[m] + length * (p.first - p.second) * (f0 * drive[0] + f1 * drive[1]);
            weight[m] = length * p.second;
            faces.base[0] += f0 * x[m];
            faces.base[1] += f1 * x[m];
            faces.response[0] += weight[m] * f0 * f0;
            faces.response[1] += weight[m] * f0 * f1;
            faces.response[2] += weight[m] * f1 * f1;
        }
        solve_faces<Plate, Wet>(airs, natural, step.film.data(), step.reference, faces, drive,
                                record);
        for (std::size_t m = 0; m < modes; ++m) {
            x[m] += weight[m] * (step.face[0][m] * drive[0] + step.face[1][m] * drive[1]);
        }
        begin = end;
    }
}

template <bool Plate, bool Wet>
void advance(const PlateStep& step, const ThermalSurface& surface, const ModeForcing& forcing,
             PlateBatch& batch, StepRecord& record) {
    const std::size_t modes = step.modes(), count = batch.count;
    // Plates with a jump leave before the others' step writes over where they stand.
    struct Stray {
        std::size_t lane;
        double drive[2];
        std::vector<double> x;
    };
    std::vector<Stray> strays;
    std::vector<HeatJump> jumps(forcing.jumps.begin(), forcing.jumps.end());
    for (std::size_t l = 0; l < count; ++l) {
        if (batch.unsettled[l] == 0) continue;
        --batch.unsettled[l];
        jumps.push_back({l, 1e-3, 0.0});
    }
    for (const HeatJump& jump : forcing.jumps) {
        batch.unsettled[jump.lane] = steps_after_jump;
        // It may have come from the step before with parts of its own.
        const auto last =
            std::remove_if(jumps.begin() + std::ptrdiff_t(forcing.jumps.size()), jumps.end(),
                           [&](const HeatJump& other) { return other.lane == jump.lane; });
        jumps.erase(last, jumps.end());
    }
    for (const HeatJump& jump : jumps) {
        Stray& stray = strays.emplace_back();
        stray.lane = jump.lane;
        for (int k = 0; k < 2; ++k) stray.drive[k] = batch.drive[k][jump.lane];
        for (std::size_t m = 0; m < modes; ++m) {
            stray.x.push_back(batch.state[m * lanes + jump.lane]);
        }
        split_plate<Plate, Wet>(step, surface, forcing, jump, stray.x.data(), stray.drive,
                                batch.natural[jump.lane], record);
    }

    const AirFilm air = forcing.air;
    const TwoAirs airs(surface, air);
    const double film0 = step.film[0], film1 = step.film[1], reference = step.reference;
    const double r0 = step.response[0], r1 = step.response[1], r2 = step.response[2];
    const double emissivity0 = airs.emissivity[0], emissivity1 = airs.emissivity[1];
    const double arriving = airs.arriving;
    double* const u0 = batch.drive[0].data();
    double* const u1 = batch.drive[1].data();
    const NaturalFilm* const natural = batch.natural.data();
    alignas(64) double base0[lanes] = {}, base1[lanes] = {}, front[lanes], back[lanes],
                       flux0[lanes], flux1[lanes], slope0[lanes], slope1[lanes];
    for (std::size_t m = 0; m < modes; ++m) {
        const double decay = step.decay[m], from = step.from[m];
        const double f0 = step.face[0][m], f1 = step.face[1][m];
        double* const x = batch.state.data() + m * lanes;
#pragma omp simd
        for (std::size_t l = 0; l < lanes; ++l) {
            x[l] = decay * x[l] + from * (f0 * u0[l] + f1 * u1[l]);
            base0[l] += f0 * x[l];
            base1[l] += f1 * x[l];
        }
    }
    const double* const heat = forcing.heat;
    const double* const heat_before = forcing.heat_before;
#pragma omp simd
    for (std::size_t l = 0; l < lanes; ++l) u0[l] += heat[l] - heat_before[l];
    double largest;
    int iterations = 0;
    do {
        largest = 0.0;
#pragma omp simd
        for (std::size_t l = 0; l < lanes; ++l) {
            front[l] = base0[l] + r0 * u0[l] + r1 * u1[l];
            back[l] = base1[l] + r1 * u0[l] + r2 * u1[l];
            face_flux<Plate, Wet>(air, natural[l], emissivity0, front[l] + reference, flux0[l],
                                  slope0[l]);
            face_flux<Plate, false>(air, {natural[l].cold, natural[l].warm}, emissivity1,
                                    back[l] + reference, flux1[l], slope1[l]);
        }
#pragma omp simd reduction(max : largest)
        for (std::size_t l = 0; l < lanes; ++l) {
            const double g0 = slope0[l] + film0, g1 = slope1[l] + film1;
            const double left0 = flux0[l] + heat[l] + film0 * front[l] - u0[l];
            const double left1 = flux1[l] + arriving + film1 * back[l] - u1[l];
            const double scale = 1.0 / ((1.0 - g0 * r0) * (1.0 - g1 * r2) - g0 * g1 * r1 * r1);
            const double more0 = scale * ((1.0 - g1 * r2) * left0 + g0 * r1 * left1);
            const double more1 = scale * ((1.0 - g0 * r0) * left1 + g1 * r1 * left0);
            u0[l] += more0;
            u1[l] += more1;
            const double size =
                std::abs(r0 * more0 + r1 * more1) + std::abs(r1 * more0 + r2 * more1);
            // Comparisons with NaN are false: it counts as far away.
            const double known = size < 1e9 ? size : 1e9;
            largest = known > largest ? known : largest;
        }
        ++iterations;
    } while (largest > near_enough && iterations < newton_steps);
    ++record.stages;
    record.iterations += iterations;
    record.worst_iterations = std::max(record.worst_iterations, iterations);
    if (largest > near_enough) {
        for (std::size_t l = 0; l < count; ++l) {
            const Faces faces{.base = {base0[l], base1[l]},
                              .heat = {heat[l], arriving},
                              .response = {r0, r1, r2}};
            double drive[2]{heat[l], arriving};
            solve_faces<Plate, Wet>(airs, natural[l], step.film.data(), reference, faces, drive,
                                    record);
            u0[l] = drive[0];
            u1[l] = drive[1];
        }
    }
    for (std::size_t m = 0; m < modes; ++m) {
        const double to = step.to[m], f0 = step.face[0][m], f1 = step.face[1][m];
        double* const x = batch.state.data() + m * lanes;
#pragma omp simd
        for (std::size_t l = 0; l < lanes; ++l) x[l] += to * (f0 * u0[l] + f1 * u1[l]);
    }
    for (const Stray& stray : strays) {
        for (std::size_t m = 0; m < modes; ++m) batch.state[m * lanes + stray.lane] = stray.x[m];
        u0[stray.lane] = stray.drive[0];
        u1[stray.lane] = stray.drive[1];
    }

    double worst = 0.0;
    record.slope = {};
    for (std::size_t l = 0; l < count; ++l) {
        double theta[2] = {};
        for (std::size_t m = 0; m < modes; ++m) {
            theta[0] += step.face[0][m] * batch.state[m * lanes + l];
            theta[1] += step.face[1][m] * batch.state[m * lanes + l];
        }
        double flux[2], slope[2];
        face_flux<Plate, Wet>(air, natural[l], emissivity0, theta[0] + reference, flux[0],
                              slope[0]);
        face_flux<Plate, false>(air, {natural[l].cold, natural[l].warm}, emissivity1,
                                theta[1] + reference, flux[1], slope[1]);
        const double given[2]{heat[l], arriving};
        double left = 0.0, terms = 1.0;
        for (int k = 0; k < 2; ++k) {
            left += std::abs(flux[k] + given[k] + step.film[k] * theta[k] - batch.drive[k][l]);
            terms += std::abs(flux[k]) + std::abs(given[k]);
            batch.temperature[k][l] = theta[k] + reference;
            batch.slope[k][l] = slope[k];
            record.slope[k] += slope[k];
        }
        worst = std::max(worst, left / terms);
    }
    record.worst_closure = std::max(record.worst_closure, worst);
}

}  // namespace

AirFilm air_between(const AirFilm& before, const AirFilm& after, double share) {
    AirFilm air = after;
    const double back = 1.0 - share;
    air.air_temperature += back * (before.air_temperature - after.air_temperature);
    air.neutral += back * (before.neutral - after.neutral);
    air.instability += back * (before.instability - after.instability);
    air.heat_capacity += back * (before.heat_capacity - after.heat_capacity);
    air.vapour_pressure += back * (before.vapour_pressure - after.vapour_pressure);
    air.latent += back * (before.latent - after.latent);
    return air;
}

void PlateBatch::resize(std::size_t modes, std::size_t plates) {
    assert(plates > 0 && plates <= lanes);
    count = plates;
    state.assign(modes * lanes, 0.0);
}

void begin_plates(const PlateStep& step, const ThermalSurface& surface, const AirFilm& air,
                  const double* heat, PlateBatch& batch) {
    const TwoAirs airs(surface, air);
    for (std::size_t l = 0; l < lanes; ++l) {
        const double given[2]{heat[l], airs.arriving};
        const NaturalFilm natural = batch.natural[l];
        const NaturalFilm sides[2]{natural, {natural.cold, natural.warm}};
        for (int k = 0; k < 2; ++k) {
            double theta = 0.0;
            for (std::size_t m = 0; m < step.modes(); ++m) {
                theta += step.face[k][m] * batch.state[m * lanes + l];
            }
            const double t = theta + step.reference;
            double flux, slope;
            if (k == 0 && air.wetness > 0.0) {
                const auto wet = air.plate ? face_flux<true, true> : face_flux<false, true>;
                wet(air, sides[k], airs.emissivity[k], t, flux, slope);
            } else {
                const auto dry = air.plate ? face_flux<true, false> : face_flux<false, false>;
                dry(air, sides[k], airs.emissivity[k], t, flux, slope);
            }
            batch.temperature[k][l] = t;
            batch.slope[k][l] = slope;
            batch.drive[k][l] = flux + given[k] + step.film[k] * theta;
        }
    }
}

void advance_plates(const PlateStep& step, const ThermalSurface& surface,
                    const ModeForcing& forcing, PlateBatch& batch, StepRecord& record) {
    const bool wet = forcing.air.wetness > 0.0;
    if (forcing.air.plate) {
        (wet ? advance<true, true> : advance<true, false>)(step, surface, forcing, batch, record);
    } else {
        (wet ? advance<false, true> : advance<false, false>)(step, surface, forcing, batch, record);
    }
}

}  // namespace diurna
