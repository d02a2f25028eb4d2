#pragma once

#include <cmath>

#include "materials/matter/material.hpp"
#include "thermal/column/plate_column.hpp"
#include "thermal/steppers/step_record.hpp"
#include "thermal/surface/surface_flux.hpp"

namespace diurna {

// The two surface balances of a thin plate, solved together with the response of its modes.

/// The air on the two faces; the back's normal is reversed.
struct TwoAirs {
    const AirFilm& air;
    double emissivity[2];
    double arriving;  // [W m⁻²] absorbed_of_air of the back

    TwoAirs(const ThermalSurface& surface, const AirFilm& given)
        : air(given),
          emissivity{surface.emissivity, surface.back->emissivity},
          arriving(absorbed_of_air(given, surface.back->emissivity)) {}
};

/// Heat into one face [W m⁻²], without `heat` on the front, and d/dT.
template <FilmKind Kind, bool Wet>
[[gnu::always_inline]] inline void face_flux(const AirFilm& air, const NaturalFilm& natural,
                                             double emissivity, double t, double& flux,
                                             double& slope) {
    const SurfaceFlux into =
        surface_flux<Kind, Wet>(air, natural, emissivity * stefan_boltzmann, 0.0, t);
    flux = into.flux;
    slope = into.slope;
}

/// A plate's two equations u = F(T) + heat + film θ, θ = base + response u.
struct Faces {
    double base[2];      // [K] θ without the step's own drive
    double heat[2];      // [W m⁻²]
    double response[3];  // front, across, back
};

inline constexpr double plate_settled = 1e-8;  // [K] of the last correction, which has been applied
inline constexpr int plate_newton_steps = 12;
/// Template arguments for a plate's faces: the kind of film, evaporation in front and
/// behind.
template <FilmKind Kind, bool Wet, bool WetBehind>
struct FaceKinds {
    static constexpr FilmKind kind = Kind;
    static constexpr bool wet = Wet, wet_behind = WetBehind;
};

/// By nested bisection: each face's balance decreases with its own temperature and increases with
/// the other's.
template <class Kinds>
void solve_slowly(const TwoAirs& airs, const NaturalFilm& natural, const PlateStep& step,
                  const Faces& faces, double drive[2]) {
    const double* const r = faces.response;
    const double* const film = step.film.data();
    const double reference = step.reference;
    const double scale = 1.0 / (r[0] * r[2] - r[1] * r[1]);
    const NaturalFilm sides[2]{natural, turned_over(natural)};
    const auto balance = [&](int k, const double t[2]) {
        double flux, slope;
        if (k == 0) {
            face_flux<Kinds::kind, Kinds::wet>(airs.air, sides[0], airs.emissivity[0], t[0], flux,
                                               slope);
        } else {
            face_flux<Kinds::kind, Kinds::wet_behind>(airs.air, sides[1], airs.emissivity[1], t[1],
                                                      flux, slope);
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
template <class Kinds>
void solve_faces(const TwoAirs& airs, const NaturalFilm& natural, const PlateStep& step,
                 const Faces& faces, double drive[2], StepRecord& record) {
    const double* const r = faces.response;
    const double* const film = step.film.data();
    const double reference = step.reference;
    const NaturalFilm behind = turned_over(natural);
    for (int i = 0; i < plate_newton_steps; ++i) {
        const double front = faces.base[0] + r[0] * drive[0] + r[1] * drive[1];
        const double back = faces.base[1] + r[1] * drive[0] + r[2] * drive[1];
        double flux[2], slope[2];
        face_flux<Kinds::kind, Kinds::wet>(airs.air, natural, airs.emissivity[0], front + reference,
                                           flux[0], slope[0]);
        face_flux<Kinds::kind, Kinds::wet_behind>(airs.air, behind, airs.emissivity[1],
                                                  back + reference, flux[1], slope[1]);
        const double g0 = slope[0] + film[0], g1 = slope[1] + film[1];
        const double left0 = flux[0] + faces.heat[0] + film[0] * front - drive[0];
        const double left1 = flux[1] + faces.heat[1] + film[1] * back - drive[1];
        const double scale = 1.0 / ((1.0 - g0 * r[0]) * (1.0 - g1 * r[2]) - g0 * g1 * r[1] * r[1]);
        const double more0 = scale * ((1.0 - g1 * r[2]) * left0 + g0 * r[1] * left1);
        const double more1 = scale * ((1.0 - g0 * r[0]) * left1 + g1 * r[1] * left0);
        drive[0] += more0;
        drive[1] += more1;
        if (std::abs(r[0] * more0 + r[1] * more1) + std::abs(r[1] * more0 + r[2] * more1) <=
            plate_settled) {
            return;
        }
    }
    ++record.bisections;
    solve_slowly<Kinds>(airs, natural, step, faces, drive);
}

}  // namespace diurna
