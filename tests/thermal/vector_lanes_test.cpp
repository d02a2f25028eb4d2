#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "materials/base/units.hpp"
#include "thermal/kernels/mode_loops.hpp"
#include "thermal/kernels/surface_kernel.hpp"
#include "thermal/surface/heat_balance.hpp"
#include "thermal/surface/surface_flux.hpp"

// The balance of a surface is evaluated in four ways: a facet at a time (heat_balance,
// surface_flux), and in loops over lanes as this unit's options compile them, for AVX2 and for
// AVX-512. They are the same sums, but the loops fuse other products into them and cut the
// exponential in two; what may differ is counted in ulp of the largest that cancels, below.

using namespace diurna;

namespace {

constexpr double ulp = 0x1p-52;
// Of the sum of the terms' magnitudes. A body's film is a chain of two cube roots, five square
// roots and two divisions, where the fused products add up.
double most_ulp(FilmKind kind) { return kind == FilmKind::body ? 8.0 : 4.0; }

/// The loops that this machine runs, and those of this unit's own options.
struct Variant {
    const char* name;
    ModeKernel modes;
    SurfaceKernel nodes;
};
std::vector<Variant> variants() {
    std::vector<Variant> all{{"plain", {advance_all, nullptr, balance_all}, {solve}},
                             {"AVX2", modes_avx2, surface_avx2}};
    if (wide_vectors()) {
        all.push_back({"AVX-512", modes_avx512, surface_avx512});
    } else {
        WARN("this processor has no AVX-512: that variant is not run");
    }
    return all;
}

/// Air over any surface, from polar nights to re-entry, dry or wet, a plate or ground.
struct Stress {
    std::mt19937 random{20260722};
    double between(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    }
    ThermalSurface surface;
    AirFilm air(int trial) {
        surface = {};
        surface.roughness_length = std::pow(10.0, between(-5.0, 0.0));
        surface.heat_roughness_length = surface.roughness_length * between(0.01, 1.0);
        const int kind = trial % 8;
        if (kind == 1) surface.convection = Tarp{};
        if (kind == 2) surface.convection = Mowitt{between(1.0, 2.17)};
        if (kind == 3) surface.convection = ConstantFilm{between(0.0, 100.0)};
        if (kind >= 4 && kind < 7) surface.convection = BodyFilm{BodyShape(kind - 4)};
        surface.evaporation = {.minimum_resistance = between(0.0, 2000.0),
                               .wetness = trial % 3 == 0 ? 0.0 : between(0.0, 1.0)};
        AirFilm film = air_film(
            surface, louis_form(surface.roughness_length, surface.heat_roughness_length, 10.0, 2.0),
            {.temperature = between(180.0, 340.0),
             .pressure = between(3e4, 1.1e5),
             .vapour_pressure = between(0.0, 7000.0)},
            between(0.0, 60.0));
        if (kind == 7) film.kind = FilmKind::sheltered_ground;
        return film;
    }
    /// A facet of that surface, as large and as windy as any.
    NaturalFilm facet() {
        const auto size = [&] { return float(std::pow(10.0, between(-3.0, 3.0))); };
        return facet_film(surface.convection, between(-1.0, 1.0),
                          {.rise = size(),
                           .breadth = size(),
                           .chord = size(),
                           .across = size(),
                           .wind = float(between(0.2, 1.5))});
    }
};

/// A lane one facet at a time, and the magnitudes of all that is added up in it.
struct Scalar {
    double flux, slope, flux_terms, slope_terms;
};
Scalar scalar(const AirFilm& air, NaturalFilm natural, double radiation, double t) {
    const HeatBalance b = heat_balance(air, natural, radiation / stefan_boltzmann, {}, t);
    const Film film = film_of(air, natural, t);
    const DryLoss dry = dry_loss(air, film, radiation, t);
    Scalar s{b.sum(), -dry.slope, std::abs(b.longwave_out) + std::abs(b.sensible),
             dry.slope - film.rise + std::abs(film.rise)};
    if (air.wetness > 0.0) {
        double steep;
        const double wet = saturation_over_water(t, steep), vapour = air.vapour_pressure;
        const LatentHeat latent = latent_heat(air, film, t);
        s.slope += latent.slope;
        // At saturation the difference of the two pressures, and so the latent heat, is nothing.
        const VapourPath path = vapour_path(air, film, wet > vapour ? air.resistance : 0.0);
        const double share = air.latent * (wet > vapour ? air.wetness : 1.0);
        s.flux_terms += share * path.conductance * (wet + vapour);
        s.slope_terms +=
            share * (path.conductance * steep + std::abs(path.steeper) * (wet + vapour));
    }
    return s;
}

/// How far apart, in ulp of the terms' magnitudes; not a number: far.
double off(double a, double b, double terms) {
    const double by = std::abs(a - b);
    return by == 0.0 ? 0.0 : by < HUGE_VAL ? by / (ulp * terms) : HUGE_VAL;
}

}  // namespace

TEST_CASE("lanes side by side and one facet alone agree to 4 ulp of their terms, 8 of bodies",
          "[thermal][kernels][ulp]") {
    for (const Variant& variant : variants()) {
        CAPTURE(variant.name);
        double worst_flux = 0.0, worst_slope = 0.0;
        Stress stress;
        for (int trial = 0; trial < 4000; ++trial) {
            CAPTURE(trial);
            const AirFilm air = stress.air(trial);
            const double radiation = stress.between(0.0, 1.0) * stefan_boltzmann;
            NaturalFilm natural[lanes];
            double t[lanes], flux[lanes], slope[lanes];
            for (std::size_t l = 0; l < lanes; ++l) {
                natural[l] = stress.facet();
                // About the air's temperature, anywhere, and as warm as the air to the last bit.
                t[l] = l % 3 == 0   ? air.air_temperature + stress.between(-20.0, 20.0)
                       : l % 3 == 1 ? stress.between(40.0, 3000.0)
                                    : air.air_temperature * (1.0 + 1e-16 * stress.between(-9, 9));
            }
            const auto compare = [&](const double* fluxes, const double* slopes) {
                for (std::size_t l = 0; l < lanes; ++l) {
                    const Scalar s = scalar(air, natural[l], radiation, t[l]);
                    const double most = most_ulp(air.kind);
                    worst_flux = std::max(worst_flux, off(fluxes[l], s.flux, s.flux_terms) / most);
                    worst_slope =
                        std::max(worst_slope, off(slopes[l], s.slope, s.slope_terms) / most);
                }
                REQUIRE(worst_flux <= 1.0);
                REQUIRE(worst_slope <= 1.0);
            };
            variant.modes.balance(air, natural, radiation, t, flux, slope);
            compare(flux, slope);
            // Newton over ground so stiff that it stays where it is reports its flux as well.
            std::fill_n(t, lanes, t[std::size_t(trial) % lanes]);
            const double reference = t[0], nothing[lanes] = {};
            variant.nodes.solve(air, {.count = lanes,
                                      .heat = nothing,
                                      .natural = natural,
                                      .a = nothing,
                                      .b = 1e40,
                                      .reference = reference,
                                      .emissivity = radiation / stefan_boltzmann,
                                      .temperature = t,
                                      .flux = flux,
                                      .slope = slope});
            REQUIRE(t[0] == reference);
            compare(flux, slope);
        }
    }
}
