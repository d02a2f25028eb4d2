#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

#include "materials/base/units.hpp"
#include "materials/matter/library.hpp"
#include "materials/matter/read_library.hpp"
#include "tests/support/measured_days.hpp"
#include "tests/support/thermal_cases.hpp"
#include "thermal/point/point_job.hpp"
#include "thermal/point/run_column.hpp"

/// Rows of the validation table about the column and its surface: cases of
/// reference/thermal/analytic_cases.md and measured days. What needs data that are not part of the
/// repository says so where they are absent.
namespace thermal_rows {

using namespace diurna;

struct Case {
    std::string claim, reference, peers;
    std::function<std::string()> measure;
};

constexpr double day = 86400.0, pi = std::numbers::pi;

inline std::filesystem::path shared(const std::string& inside) {
    const char* named = std::getenv("DIURNA_SHARED");
    return std::filesystem::path(named ? named : DIURNA_SOURCE_DIR "/../shared") / inside;
}

/// A horizontal facet over `layers` that only exchanges by film and radiation.
inline PointJob facet(std::vector<Layer> layers, double film, double emissivity) {
    PointJob job;
    job.surface.albedo = 0.0;
    job.surface.emissivity = emissivity;
    job.surface.convection = ConstantFilm{film};
    job.surface.layers = std::move(layers);
    job.surface.bottom = FixedFlux{0.0};
    job.start = parse_instant("2020-06-01T00:00:00Z");
    job.end = later(job.start, day);
    job.spin_up = SpinUp::periodic;
    return job;
}
inline const Layer half_space{4.0, 1.0, 2000.0, 1000.0};  // k = 1, C = 2e6

using Series = std::function<double(double)>;
inline Series constant(double value) {
    return [value](double) { return value; };
}
inline Series wave(double mean, double amplitude, int order = 1) {
    return [=](double t) { return mean + amplitude * std::cos(2.0 * pi * order * t / day); };
}

inline void drive(PointJob& job, const Series& sun, const Series& air, double longwave,
                  double every = 300.0) {
    job.weather = {};
    for (double t = 0.0; t <= day + 1.0; t += every) {
        Forcing forcing;
        forcing.air.temperature = air(t);
        forcing.shortwave_down = sun(t);
        forcing.longwave_down = longwave;
        job.weather.instant.push_back(later(job.start, t));
        job.weather.sample.push_back(forcing);
    }
}

template <class Value>
std::complex<double> harmonic(const PointResult& result, int order, const Value& value) {
    std::complex<double> sum = 0.0;
    const std::size_t n = result.row.size() - 1;
    for (std::size_t i = 0; i < n; ++i) {
        sum += value(result.row[i]) *
               std::polar(2.0 / double(n), -2.0 * pi * order * double(i) / double(n));
    }
    return sum;
}
inline double surface(const PointRow& row) { return row.surface_temperature; }

inline std::string a1() {
    PointJob job = facet({half_space}, 1e4, 0.0);
    job.step = 600.0;
    drive(job, constant(0.0), wave(293.15, 10.0), 0.0, 60.0);
    const auto flux = harmonic(run_column(job), 1, [](const PointRow& r) { return -r.conducted; });
    return fmt::format("{:.2f} % in flux, {:.0f} s in phase",
                       100.0 * std::abs(std::abs(flux) / 120.6002091 - 1.0),
                       std::abs(std::arg(flux) / (2.0 * pi) * day - 10800.0));
}

inline std::string a2() {
    double worst = 0.0;
    for (const auto& [film, amplitude] :
         {std::pair{5.0, 6.253404513}, {15.0, 3.995923739}, {30.0, 2.534198955}}) {
        PointJob job = facet({half_space}, film, 0.0);
        job.step = 600.0;
        drive(job, wave(100.0, 100.0), constant(290.0), 0.0);
        const double found = std::abs(harmonic(run_column(job), 1, surface));
        worst = std::max(worst, std::abs(found - amplitude));
    }
    return fmt::format("{:.4f} K", worst);
}

inline std::string a3() {
    double worst = 0.0;
    for (const auto& [order, amplitude] :
         {std::pair{1, 3.844736725}, {4, 2.53084319}, {24, 1.287797341}}) {
        PointJob job = facet(
            {{0.10, 1.2, 2100.0, 1000.0}, {0.30, 0.8, 1600.0, 1000.0}, {5.0, 1.0, 2000.0, 1000.0}},
            15.0, 0.0);
        job.step = 300.0;
        drive(job, wave(100.0, 100.0, order), constant(290.0), 0.0, 60.0);
        const double found = std::abs(harmonic(run_column(job), order, surface));
        worst = std::max(worst, std::abs(found - amplitude));
    }
    return fmt::format("{:.4f} K", worst);
}

/// From a uniform start; the worst over (s, K) of the surface.
inline double from_start(PointJob job, double start, double sun, double air, double longwave,
                         const std::vector<std::pair<double, double>>& expected) {
    job.spin_up = SpinUp::none;
    job.initial_temperature = start;
    job.step = 60.0;
    drive(job, constant(sun), constant(air), longwave);
    const PointResult result = run_column(job);
    double worst = 0.0;
    for (const auto& [t, kelvin] : expected) {
        worst = std::max(worst, std::abs(surface(result.row[std::size_t(t / 60.0)]) - kelvin));
    }
    return worst;
}

inline std::string a4() {
    const double flux = from_start(
        facet({half_space}, 0.0, 0.0), 300.0, 400.0, 300.0, 0.0,
        {{60, 302.472154893}, {600, 307.81764019}, {3600, 319.14922946}, {21600, 346.90584114}});
    const double film = from_start(facet({half_space}, 20.0, 0.0), 300.0, 0.0, 301.0, 0.0,
                                   {{60, 300.1125290806},
                                    {600, 300.2962095709},
                                    {3600, 300.5271940959},
                                    {86400, 300.8679046715}});
    const double slab =
        from_start(facet({{0.1, 1.2, 2100.0, 1000.0}}, 0.0, 0.0), 300.0, 400.0, 300.0, 0.0,
                   {{60, 302.202370623}, {600, 306.96450742}, {3600, 317.08089675}});
    return fmt::format("{:.4f} K", std::max({flux, film, slab}));
}

inline std::string a5() {
    // The contact 1 m down, the surface far from it; 2 h.
    PointJob job = facet({{1.0, 1.2, 2100.0, 1000.0}, {1.0, 0.25, 1200.0, 1000.0}}, 0.0, 0.0);
    std::vector<Layer> cut;
    for (const Layer& layer : job.surface.layers) {
        for (int i = 0; i < 400; ++i) {
            cut.push_back(layer);
            cut.back().thickness = layer.thickness / 400;
        }
    }
    job.surface.layers = cut;
    job.spin_up = SpinUp::none;
    job.end = later(job.start, 7200.0);
    job.step = 7200.0;
    // The node in the contact holds half a cell of each side: 340 · 2.1 and 290 · 1.2 over 3.3.
    job.initial_profile = {{0.9976, 340.0}, {1.0, 321.8181818}, {1.0024, 290.0}};
    drive(job, constant(0.0), constant(300.0), 0.0);
    const PointResult result = run_column(job);
    double found = 0.0;
    for (std::size_t i = 0; i < result.depth.size(); ++i) {
        if (std::abs(result.depth[i] - 1.0) < 1e-6) found = result.final_profile[i];
    }
    return fmt::format("{:.4f} K", std::abs(found - 327.173815208));
}

inline std::string a7() {
    return fmt::format("{:.4f} K", from_start(facet({{0.001, 50.0, 7800.0, 500.0}}, 0.0, 0.9),
                                              320.0, 0.0, 290.0, 0.0,
                                              {{60, 312.16703788},
                                               {600, 264.45027229},
                                               {3600, 179.86967163},
                                               {36000, 88.478156542}}));
}

inline std::string a8() {
    double worst = 0.0;
    for (const auto& [sun, sky, film, air, root] :
         {std::array{750.0, 330.0, 10.0, 300.0, 336.929171003},
          {0.0, 250.0, 5.0, 280.0, 270.132016844},
          {900.0, 400.0, 30.0, 310.0, 331.089448651},
          {100.0, 300.0, 0.0, 290.0, 290.757781764}}) {
        PointJob job = facet({{0.001, 50.0, 7800.0, 500.0}}, film, 0.95);
        drive(job, constant(sun), constant(air), sky);
        worst = std::max(worst, std::abs(surface(run_column(job).row.back()) - root));
    }
    return fmt::format("{:.1e} K", worst);
}

inline std::string a10() {
    const double a = from_start(facet({half_space}, 0.0, 1.0), 300.0, 0.0, 290.0, 0.0,
                                {{60, 297.24270688},
                                 {600, 291.77910574},
                                 {3600, 281.96186568},
                                 {21600, 264.2939807},
                                 {86400, 244.8719008}});
    const double b = from_start(facet({half_space}, 0.0, 0.95), 290.0, 750.0, 290.0, 0.0,
                                {{60, 292.22306254},
                                 {600, 296.65228186},
                                 {3600, 304.5128263},
                                 {21600, 317.2655035},
                                 {86400, 327.6878541}});
    // √(kC) of 55: a lunar sunrise from 100 K.
    const double c =
        from_start(facet({{4.0, 3.025e-3, 1000.0, 1000.0}}, 0.0, 0.95), 100.0, 1200.0, 290.0, 0.0,
                   {{60, 262.696156}, {600, 352.699094}, {3600, 373.764205}, {36000, 382.504688}});
    return fmt::format("{:.4f}, {:.4f}, {:.4f} K", a, b, c);
}

inline std::string a11() {
    return fmt::format("order {:.3f} in space, {:.3f} in time", manufactured::order_in_space(),
                       manufactured::order_in_time());
}

inline std::string a6() {
    const FreezingFront front = freezing_front(0.001);
    return fmt::format("{:.2f} % after an hour, {:.2f} % after a day", 100.0 * front.hour,
                       100.0 * front.day);
}

inline std::string b1() {
    const auto curve = shared("reference/thermal/b1_lunar_equator_240.txt");
    if (!std::filesystem::exists(curve)) return "data absent";
    const LunarDay lunar = lunar_day(curve);
    return fmt::format("{:.3f} K rms, {:.2f} worst, {} nodes", lunar.rms, lunar.worst, lunar.nodes);
}

inline std::string b2() {
    PointJob job = facet({half_space}, 10.0, 0.95);
    job.step = 1800.0;
    drive(
        job, [](double t) { return 750.0 * std::max(0.0, -std::cos(2.0 * pi * t / day)); },
        [](double t) { return 298.15 + 8.0 * std::cos(2.0 * pi * (t - 54000.0) / day); }, 330.0);
    const PointResult result = run_column(job);
    double worst = 0.0;
    for (const auto& [hour, kelvin] : std::vector<std::pair<double, double>>{
             {1, 294.1009},  {3, 292.5792},    {5, 292.0031},    {6, 292.0728},  {6.5, 293.8714},
             {7, 296.6394},  {8, 303.1838},    {9, 309.9751},    {10, 316.1945}, {11, 321.2634},
             {12, 324.7690}, {12.5, 325.8470}, {13, 326.4450},   {14, 326.1607}, {15, 323.9119},
             {16, 319.8125}, {18, 307.0559},   {18.5, 304.8424}, {19, 303.3794}, {20, 301.1737},
             {21, 299.3915}, {22, 297.8266},   {24, 295.1737}}) {
        worst = std::max(worst, std::abs(surface(result.row[std::size_t(hour * 2)]) - kelvin));
    }
    return fmt::format("{:.3f} K worst, {} passes, energy to {:.0e}", worst, result.passes,
                       result.worst_energy_closure);
}

inline std::string deep() {
    PointJob job = facet({{10.0, 1.2, 1700.0, 1200.0}}, 10.0, 0.95);
    job.step = 1800.0;
    drive(
        job, [](double t) { return 750.0 * std::max(0.0, -std::cos(2.0 * pi * t / day)); },
        constant(295.0), 330.0);
    job.initial_temperature = 262.0;
    const PointResult cold = run_column(job);
    job.initial_temperature = 322.0;
    const PointResult warm = run_column(job);
    double apart = 0.0;
    for (std::size_t i = 0; i < cold.row.size(); ++i) {
        apart = std::max(apart, std::abs(surface(cold.row[i]) - surface(warm.row[i])));
    }
    return fmt::format("{:.4f} K apart, {} passes", apart, std::max(cold.passes, warm.passes));
}

/// A measured day or season, with a material of the library.
inline std::string measured_days(const char* folder,
                                 const std::function<measured::Series(std::filesystem::path)>& read,
                                 const char* material, double cadence) {
    const auto place = shared(std::string("data/thermal/") + folder);
    if (!std::filesystem::exists(place)) return "data absent";
    const measured::Series series = read(place);
    const MaterialLibrary library = default_material_library();
    const PointJob job = measured::job_of(series, library[library.find(material)].thermal, cadence);
    const PointResult result = run_column(job);
    double sum = 0.0, bias = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < series.when.size() && series.when[i] <= job.end; ++i, ++count) {
        const double at = seconds_between(job.start, series.when[i]) / cadence;
        const auto k =
            static_cast<std::size_t>(std::clamp(at, 0.0, double(result.row.size()) - 2.0));
        const double share = std::clamp(at - double(k), 0.0, 1.0);
        const double e =
            std::lerp(surface(result.row[k]), surface(result.row[k + 1]), share) - series.skin[i];
        sum += e * e;
        bias += e;
    }
    return fmt::format("{:.2f} K rms, bias {:+.2f}", std::sqrt(sum / double(count)),
                       bias / double(count));
}

inline std::vector<Case> cases() {
    return {
        {"A1 flux into a half-space under a periodic surface temperature", "Carslaw & Jaeger 2.6",
         "", a1},
        {"A2 half-space under a periodic flux of 100 W/m², films of 5, 15, 30 W/m²K",
         "Carslaw & Jaeger 2.6", "0.7 % a 15-node column (first cell 0.1 skin depths)", a2},
        {"A3 layered road, harmonics 1, 4, 24", "thermal quadrupoles", "", a3},
        {"A4 steps of flux and air, half-space and slab", "Carslaw & Jaeger", "", a4},
        {"A5 two half-spaces in contact, 340 on 290 K", "Carslaw & Jaeger", "", a5},
        {"A6 water freezes downward, 1 mm cells", "Neumann's front", "", a6},
        {"A7 plate that radiates to 0 K, ten hours", "closed form", "", a7},
        {"A8 steady balance of sun, sky, film", "roots of the quartic", "", a8},
        {"A10 half-space that radiates (a, b) and a lunar sunrise from 100 K (c), 60 s on",
         "Abel/Volterra equation, 8 digits", "linearised steps overshoot in (c)", a10},
        {"A11 manufactured solution", "order 2", "", a11},
        {"B1 day of the moon's equator, 240 steps", "CVODE, extrapolated",
         "0.023 K rms, 0.21 worst the finite-volume grid of 21 layers, converged in time", b1},
        {"B2 desert day, periodic, 30-minute output", "CVODE method of lines, extrapolated",
         "0.069 K an 18-layer finite-volume column", b2},
        {"periodic day of a 10 m column from 262 and from 322 K", "each other", "years of spin-up",
         deep},
        {"basalt cinder, Arizona, two September days", "measured (Woodhouse Mesa 2022)",
         "2.5 K a layered column with literature parameters",
         [] {
             return measured_days("woodhouse_mesa_2022", measured::woodhouse, "basalt_cinder",
                                  600.0);
         }},
        {"high desert, Colorado, a January day", "measured (SURFRAD Alamosa 2016)",
         "2.7 K the same",
         [] {
             return measured_days("surfrad_alamosa_20160101", measured::alamosa, "semi_desert",
                                  600.0);
         }},
        {"cropland, Illinois, January to July", "measured (Bondville 1998)",
         "1.1 to 1.9 K by month the same; 2.26 K Noah",
         [] {
             return measured_days("bondville_1998", measured::bondville_1998, "crop_stubble",
                                  1800.0);
         }},
        {"grass, Illinois, an overcast May day", "measured (SURFRAD Bondville 1995)",
         "1.1 K the same",
         [] {
             return measured_days("surfrad_bondville_19950510", measured::bondville_1995, "grass",
                                  600.0);
         }},
        {"alpine snow, November to January; without the sun in its sky's measurement",
         "measured (Weissfluhjoch 1995)", "",
         [] {
             const auto snow = [](double sun_in_sky) {
                 const auto read = [=](const std::filesystem::path& folder) {
                     return measured::weissfluhjoch(folder, sun_in_sky);
                 };
                 return measured_days("weissfluhjoch_mst96", read, "snow", 1800.0);
             };
             return snow(0.0) + "; " + snow(0.13);
         }},
    };
}

}  // namespace thermal_rows
