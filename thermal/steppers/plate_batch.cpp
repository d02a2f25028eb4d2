#include "thermal/steppers/plate_batch.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "thermal/kernels/mode_kernel.hpp"
#include "thermal/steppers/plate_faces.hpp"

namespace diurna {

namespace {

constexpr int steps_after_jump = 2;  // in parts

/// A plate that goes the step by itself.
struct Outlier {
    HeatJump jump;
    bool on_back;
    NaturalFilm natural;
    const double *behind_before, *behind;  // of PlateBatch
    double drive[2];
    std::vector<double> x;  // (mode)
};

/// The whole step of one plate with a jump of heat within it, from its state before.
template <class Kinds>
void split_plate(const PlateStep& step, const ThermalSurface& surface, const ModeForcing& forcing,
                 Outlier& stray, StepRecord& record) {
    const HeatJump& jump = stray.jump;
    double* const x = stray.x.data();
    double* const drive = stray.drive;
    const std::size_t l = jump.lane, modes = step.modes();
    const double rise[2]{stray.on_back ? 0.0 : jump.heat, stray.on_back ? jump.heat : 0.0};
    const double smooth[2]{forcing.heat[l] - forcing.heat_before[l] - rise[0],
                           stray.behind ? stray.behind[l] - stray.behind_before[l] - rise[1] : 0.0};
    const double left = 1.0 - jump.share;
    double begin = 0.0;
    for (int part = 0; part <= parts_after_jump; ++part) {
        // Part 0 leads to the jump, the others from there to the step's end.
        const double end = jump.share + left * part_after_jump[part];
        const double length = (end - begin) * step.step;
        const AirFilm air = air_between(forcing.air_before.low, forcing.air.low, end);
        const TwoAirs airs(surface, air);
        if (part == 1) {
            drive[0] += rise[0];
            drive[1] += rise[1];
        }
        Faces faces{.base = {},
                    .heat = {forcing.heat_before[l] + end * smooth[0] + (part > 0 ? rise[0] : 0.0),
                             stray.behind ? stray.behind_before[l] + end * smooth[1] +
                                                (part > 0 ? rise[1] : 0.0)
                                          : airs.arriving},
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
        solve_faces<Kinds>(airs, stray.natural, step, faces, drive, record);
        for (std::size_t m = 0; m < modes; ++m) {
            x[m] += weight[m] * (step.face[0][m] * drive[0] + step.face[1][m] * drive[1]);
        }
        begin = end;
    }
}

/// Takes the plates whose heat jumps in this step, or did in the last, out of the batch before the
/// others' step writes over where they stand, and goes their step.
template <class Kinds>
std::vector<Outlier> run_outliers(const PlateStep& step, const ThermalSurface& surface,
                                  const ModeForcing& forcing, PlateBatch& batch,
                                  StepRecord& record) {
    std::vector<HeatJump> jumps(forcing.jumps.begin(), forcing.jumps.end());
    // Where both faces jump, the back's is drawn out over the step.
    for (const HeatJump& jump : batch.behind_jumps) {
        const bool both =
            std::any_of(forcing.jumps.begin(), forcing.jumps.end(),
                        [&](const HeatJump& other) { return other.lane == jump.lane; });
        if (!both) jumps.push_back(jump);
    }
    const std::size_t fresh = jumps.size();
    for (std::size_t l = 0; l < batch.count; ++l) {
        if (batch.unsettled[l] == 0) continue;
        --batch.unsettled[l];
        jumps.push_back({l, 1e-3, 0.0});
    }
    for (std::size_t k = 0; k < fresh; ++k) {
        const std::size_t lane = jumps[k].lane;
        batch.unsettled[lane] = steps_after_jump;
        // It may have come from the step before with parts of its own.
        const auto last = std::remove_if(jumps.begin() + std::ptrdiff_t(fresh), jumps.end(),
                                         [&](const HeatJump& other) { return other.lane == lane; });
        jumps.erase(last, jumps.end());
    }
    std::vector<Outlier> outliers;
    for (std::size_t k = 0; k < jumps.size(); ++k) {
        const HeatJump& jump = jumps[k];
        Outlier& stray = outliers.emplace_back(
            Outlier{.jump = jump,
                    .on_back = k >= forcing.jumps.size() && k < fresh,
                    .natural = batch.natural[jump.lane],
                    .behind_before = batch.behind_before,
                    .behind = batch.behind,
                    .drive = {batch.drive[0][jump.lane], batch.drive[1][jump.lane]},
                    .x = {}});
        for (std::size_t m = 0; m < step.modes(); ++m) {
            stray.x.push_back(batch.state[m * lanes + jump.lane]);
        }
        split_plate<Kinds>(step, surface, forcing, stray, record);
    }
    return outliers;
}

/// What the backs take in at a step's end [lane].
struct alignas(64) Behind {
    double heat[lanes];
    Behind(const TwoAirs& airs, const PlateBatch& batch) {
        for (std::size_t l = 0; l < lanes; ++l) {
            heat[l] = batch.behind ? batch.behind[l] : airs.arriving;
        }
    }
};

/// θ of the faces without the step's own drive [face][lane]; the modes decay.
struct alignas(64) Bases {
    double of[2][lanes] = {};
};
Bases decay_modes(const PlateStep& step, PlateBatch& batch) {
    Bases base;
    double* const u0 = batch.drive[0].data();
    double* const u1 = batch.drive[1].data();
    for (std::size_t m = 0; m < step.modes(); ++m) {
        const double decay = step.decay[m], from = step.from[m];
        const double f0 = step.face[0][m], f1 = step.face[1][m];
        double* const x = batch.state.data() + m * lanes;
#pragma omp simd
        for (std::size_t l = 0; l < lanes; ++l) {
            x[l] = decay * x[l] + from * (f0 * u0[l] + f1 * u1[l]);
            base.of[0][l] += f0 * x[l];
            base.of[1][l] += f1 * x[l];
        }
    }
    return base;
}

/// Newton for all plates' drives side by side; whether it has settled them.
template <class Kinds>
bool solve_drives(const PlateStep& step, const TwoAirs& airs, const ModeForcing& forcing,
                  const Bases& base, PlateBatch& batch, StepRecord& record) {
    const Behind behind(airs, batch);
    // Values of its own, which no store through a pointer can change, let the loops become vectors.
    const AirFilm air = forcing.air.low;
    const double film0 = step.film[0], film1 = step.film[1], reference = step.reference;
    const double r0 = step.response[0], r1 = step.response[1], r2 = step.response[2];
    const double emissivity0 = airs.emissivity[0], emissivity1 = airs.emissivity[1];
    const double* const arriving = behind.heat;
    double* const u0 = batch.drive[0].data();
    double* const u1 = batch.drive[1].data();
    const double *const base0 = base.of[0], *const base1 = base.of[1];
    const NaturalFilm* const natural = batch.natural.data();
    const double* const heat = forcing.heat;
    const double* const heat_before = forcing.heat_before;
    alignas(64) double front[lanes], back[lanes], flux0[lanes], flux1[lanes], slope0[lanes],
        slope1[lanes];
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
            face_flux<Kinds::kind, Kinds::wet>(air, natural[l], emissivity0, front[l] + reference,
                                               flux0[l], slope0[l]);
            face_flux<Kinds::kind, Kinds::wet_behind>(air, turned_over(natural[l]), emissivity1,
                                                      back[l] + reference, flux1[l], slope1[l]);
        }
#pragma omp simd reduction(max : largest)
        for (std::size_t l = 0; l < lanes; ++l) {
            const double g0 = slope0[l] + film0, g1 = slope1[l] + film1;
            const double left0 = flux0[l] + heat[l] + film0 * front[l] - u0[l];
            const double left1 = flux1[l] + arriving[l] + film1 * back[l] - u1[l];
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
    } while (largest > plate_settled && iterations < plate_newton_steps);
    record.count(iterations, 0);
    return largest <= plate_settled;
}

/// Each plate by itself.
template <class Kinds>
void solve_one_by_one(const PlateStep& step, const TwoAirs& airs, const double* heat,
                      const Bases& base, PlateBatch& batch, StepRecord& record) {
    const Behind behind(airs, batch);
    for (std::size_t l = 0; l < batch.count; ++l) {
        const Faces faces{.base = {base.of[0][l], base.of[1][l]},
                          .heat = {heat[l], behind.heat[l]},
                          .response = {step.response[0], step.response[1], step.response[2]}};
        double drive[2]{heat[l], behind.heat[l]};
        solve_faces<Kinds>(airs, batch.natural[l], step, faces, drive, record);
        batch.drive[0][l] = drive[0];
        batch.drive[1][l] = drive[1];
    }
}

/// The drives' own part into the modes, and the outliers back to their places.
void take_drives(const PlateStep& step, const std::vector<Outlier>& outliers, PlateBatch& batch) {
    double* const u0 = batch.drive[0].data();
    double* const u1 = batch.drive[1].data();
    for (std::size_t m = 0; m < step.modes(); ++m) {
        const double to = step.to[m], f0 = step.face[0][m], f1 = step.face[1][m];
        double* const x = batch.state.data() + m * lanes;
#pragma omp simd
        for (std::size_t l = 0; l < lanes; ++l) x[l] += to * (f0 * u0[l] + f1 * u1[l]);
    }
    for (const Outlier& stray : outliers) {
        const std::size_t l = stray.jump.lane;
        for (std::size_t m = 0; m < step.modes(); ++m) batch.state[m * lanes + l] = stray.x[m];
        u0[l] = stray.drive[0];
        u1[l] = stray.drive[1];
    }
}

/// Temperatures, slopes and closure at the step's end, from the modes.
template <class Kinds>
void tell_faces(const PlateStep& step, const TwoAirs& airs, const double* heat, PlateBatch& batch,
                StepRecord& record) {
    const Behind behind(airs, batch);
    double worst = 0.0;
    record.slope = {};
    for (std::size_t l = 0; l < batch.count; ++l) {
        double theta[2] = {};
        for (std::size_t m = 0; m < step.modes(); ++m) {
            theta[0] += step.face[0][m] * batch.state[m * lanes + l];
            theta[1] += step.face[1][m] * batch.state[m * lanes + l];
        }
        double flux[2], slope[2];
        face_flux<Kinds::kind, Kinds::wet>(airs.air, batch.natural[l], airs.emissivity[0],
                                           theta[0] + step.reference, flux[0], slope[0]);
        face_flux<Kinds::kind, Kinds::wet_behind>(airs.air, turned_over(batch.natural[l]),
                                                  airs.emissivity[1], theta[1] + step.reference,
                                                  flux[1], slope[1]);
        const double given[2]{heat[l], behind.heat[l]};
        double left = 0.0, terms = 1.0;
        for (int k = 0; k < 2; ++k) {
            left += std::abs(flux[k] + given[k] + step.film[k] * theta[k] - batch.drive[k][l]);
            terms += std::abs(flux[k]) + std::abs(given[k]);
            batch.temperature[k][l] = theta[k] + step.reference;
            batch.slope[k][l] = slope[k];
            record.slope[k] += slope[k];
        }
        worst = std::max(worst, left / terms);
    }
    record.worst_closure = std::max(record.worst_closure, worst);
}

template <class Kinds>
void advance(const PlateStep& step, const ThermalSurface& surface, const ModeForcing& forcing,
             PlateBatch& batch, StepRecord& record) {
    const std::vector<Outlier> outliers =
        run_outliers<Kinds>(step, surface, forcing, batch, record);
    const TwoAirs airs(surface, forcing.air.low);
    const Bases base = decay_modes(step, batch);
    if (!solve_drives<Kinds>(step, airs, forcing, base, batch, record)) {
        solve_one_by_one<Kinds>(step, airs, forcing.heat, base, batch, record);
    }
    take_drives(step, outliers, batch);
    tell_faces<Kinds>(step, airs, forcing.heat, batch, record);
}

}  // namespace

void PlateBatch::resize(std::size_t modes, std::size_t plates) {
    assert(plates > 0 && plates <= lanes);
    count = plates;
    state.assign(modes * lanes, 0.0);
}

void begin_plates(const PlateStep& step, const ThermalSurface& surface, const AirFilm& air,
                  const double* heat, PlateBatch& batch) {
    const TwoAirs airs(surface, air);
    const Behind behind(airs, batch);
    for (std::size_t l = 0; l < lanes; ++l) {
        const double given[2]{heat[l], behind.heat[l]};
        const NaturalFilm natural = batch.natural[l];
        const NaturalFilm sides[2]{natural, turned_over(natural)};
        for (int k = 0; k < 2; ++k) {
            double theta = 0.0;
            for (std::size_t m = 0; m < step.modes(); ++m) {
                theta += step.face[k][m] * batch.state[m * lanes + l];
            }
            const double t = theta + step.reference;
            double flux, slope;
            const bool wet = air.wetness > 0.0 && (k == 0 || batch.wet_behind);
            by_kind(air.kind, wet, [&]<FilmKind Kind, bool Wet>() {
                face_flux<Kind, Wet>(air, sides[k], airs.emissivity[k], t, flux, slope);
            });
            batch.temperature[k][l] = t;
            batch.slope[k][l] = slope;
            batch.drive[k][l] = flux + given[k] + step.film[k] * theta;
        }
    }
}

void advance_plates(const PlateStep& step, const ThermalSurface& surface,
                    const ModeForcing& forcing, PlateBatch& batch, StepRecord& record) {
    const bool wet = forcing.air.low.wetness > 0.0, both = wet && batch.wet_behind;
    by_kind(forcing.air.low.kind, wet, [&]<FilmKind Kind, bool Wet>() {
        if (Wet && both) {
            advance<FaceKinds<Kind, Wet, Wet>>(step, surface, forcing, batch, record);
        } else {
            advance<FaceKinds<Kind, Wet, false>>(step, surface, forcing, batch, record);
        }
    });
}

}  // namespace diurna
