#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>

#include "materials/base/units.hpp"
#include "thermal/point/point_job.hpp"
#include "thermal/point/run_column.hpp"

using namespace diurna;

namespace {

constexpr int cases = 2000, dimensions = 20;
constexpr unsigned seed = 20260320;
const Instant begin = parse_instant("2026-03-20T00:00:00Z");

double logarithmic(double unit, double least, double most) {
    return least * std::pow(most / least, unit);
}

/// A Latin hypercube: in every dimension, each of `cases` equal slices is drawn from once.
std::vector<std::array<double, dimensions>> hypercube() {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    std::vector<std::array<double, dimensions>> sample(cases);
    std::vector<int> order(cases);
    for (int d = 0; d < dimensions; ++d) {
        std::iota(order.begin(), order.end(), 0);
        std::shuffle(order.begin(), order.end(), random);
        for (int i = 0; i < cases; ++i) {
            sample[std::size_t(i)][std::size_t(d)] = (order[std::size_t(i)] + unit(random)) / cases;
        }
    }
    return sample;
}

enum class Kind { plain, wet, store, big_leaf, two_source, snow, freezing, plate };
constexpr int kinds = 8;

struct Extreme {
    PointJob job;
    Kind kind;
    double warmest, coldest;  // what every flux pulls towards lies between them
    bool still;               // sun, wind and rain do not change
    bool shines;              // emits more than a watt
};

/// 100 Pa, or what saturates colder air over ice (Murray 1967); and the frost point of that.
double vapour(double air) {
    return std::min(100.0, 610.78 * std::exp(21.8745584 * (air - 273.16) / (air - 7.66)));
}
double frost_point(double air) { return std::min(252.87, air); }

ThermalSurface surface_of(const std::array<double, dimensions>& x, Kind kind) {
    ThermalSurface surface;
    const double conductivity = logarithmic(x[0], 0.01, 400.0);
    const double contrast = logarithmic(x[1], 1e-4, 1e4);
    surface.layers = {{logarithmic(x[2], 1e-4, 10.0), conductivity, logarithmic(x[3], 30.0, 8000.0),
                       400.0 + 3000.0 * x[4]},
                      {logarithmic(x[5], 1e-4, 1.0),
                       std::clamp(conductivity * contrast, 0.01, 400.0), 1500.0, 1000.0}};
    // The ends themselves are among the cases.
    const auto ends = [](double unit) { return std::clamp(1.2 * unit - 0.1, 0.0, 1.0); };
    surface.albedo = ends(x[6]);
    surface.emissivity = ends(x[7]);
    surface.roughness_length = 0.02;
    surface.heat_roughness_length = 0.0005;
    const int film = int(x[8] * 5.0);
    if (film == 1) surface.convection = Tarp{};
    if (film == 2) surface.convection = Mowitt{};
    if (film == 3) surface.convection = ConstantFilm{20.0 * x[9]};
    if (film == 4) surface.convection = BodyFilm{.length = logarithmic(x[9], 0.01, 100.0)};
    if (x[16] > 0.5 && kind != Kind::two_source) surface.internal_heat = 500.0 * (x[16] - 0.5);
    switch (kind) {
        case Kind::plain:
            break;
        case Kind::wet:
            surface.evaporation = {.minimum_resistance = 200.0 * x[18], .wetness = 1.0};
            break;
        case Kind::store:
            surface.store = {.capacity_mm = logarithmic(x[18], 0.02, 5.0), .wet_albedo = x[4]};
            break;
        case Kind::big_leaf:
            surface.canopy = BigLeaf{logarithmic(x[18], 0.1, 100.0)};
            break;
        case Kind::two_source:
            surface.canopy = TwoSource{.leaf_area = 6.0 * x[18], .leaf_resistance = 200.0 * x[4]};
            break;
        case Kind::snow:
            surface.layers[0].law = Melting{.held = 0.2 * x[18]};
            break;
        case Kind::freezing:
            surface.layers[0].law = Freezing{
                .water = logarithmic(x[18], 1.0, 900.0),
                .frozen_conductivity = std::min(400.0, conductivity * (0.5 + 4.0 * x[4])),
                .frozen_heat_capacity = surface.layers[0].heat_capacity * (0.4 + 0.6 * x[4])};
            break;
        case Kind::plate:
            surface.layers.resize(1);
            surface.layers[0].thickness = logarithmic(x[2], 1e-4, 0.05);
            surface.back = ExposedBack{ends(x[18]), 0.9};
            break;
    }
    return surface;
}

Extreme job_of(const std::array<double, dimensions>& x) {
    Extreme e;
    e.kind = static_cast<Kind>(std::max(0, int(x[10] * 12.0) - 4));  // plain: five of twelve
    PointJob& job = e.job;
    job.surface = surface_of(x, e.kind);
    job.start = begin;
    job.spin_up = SpinUp::none;
    // Instants are whole milliseconds, thirds of the step too.
    job.step = 0.003 * std::round(logarithmic(x[11], 1.0, 10800.0) / 0.003);
    job.end = later(begin, std::max(6.0 * job.step, 60.0));
    // Above 373 K water boils. Snow is never warmer than its melting.
    job.initial_temperature = 230.0 + 180.0 * x[12];
    if (e.kind == Kind::snow) job.initial_temperature = 200.0 + 73.15 * x[12];
    const double air = 230.0 + 90.0 * x[13];
    const double sky = x[14] < 0.1 ? 0.0 : 400.0 * x[14];
    double below = job.initial_temperature;
    if (x[17] > 0.8) {
        below = 250.0 + 50.0 * x[19];
        job.surface.bottom = FixedTemperature{below};
    } else if (x[17] > 0.6) {
        below = 270.0 + 40.0 * x[19];
        job.surface.bottom = Interior{below, 10.0 * x[19]};
    }
    if (e.kind == Kind::plate) below = air;
    const double sun = 900.0;
    const bool polar_night = x[15]<0.2, polar_day = x[15]> 0.8;
    const double brightest = polar_night ? 0.0 : polar_day ? 300.0 : sun;
    const bool windy = x[9] >= 0.07;
    const double span = seconds_between(job.start, job.end);
    for (int i = 0; i <= 12; ++i) {
        Forcing f;
        f.air = {.temperature = air, .pressure = 9e4, .vapour_pressure = vapour(air)};
        f.wind_speed = i % 4 < 2 ? 60.0 * x[9] * x[9] : 0.3;
        f.shortwave_down = polar_night || polar_day ? brightest : (i % 3 == 0 ? sun : 0.0);
        f.longwave_down = sky;
        f.rain_mm_h = i % 5 == 0 ? 20.0 : 0.0;
        job.weather.instant.push_back(later(begin, span * i / 12.0));
        job.weather.sample.push_back(f);
    }
    // Every flux pulls towards a temperature of its own: air, start, below, what radiation would
    // settle at, and for vapour the frost point.
    const ThermalSurface& s = job.surface;
    const double albedo =
        s.store.capacity_mm > 0.0 ? std::min(s.albedo, s.store.wet_albedo) : s.albedo;
    const double warming = (1.0 - albedo) * brightest + s.internal_heat;
    double hot = 5000.0;
    if (s.emissivity > 0.0) {
        hot = std::min(hot, std::pow((warming / s.emissivity + sky) / stefan_boltzmann, 0.25));
    } else if (warming == 0.0) {
        hot = air;
    }
    const double cold = s.emissivity > 0.0 ? std::pow(sky / stefan_boltzmann, 0.25) : air;
    e.warmest = std::max({air, job.initial_temperature, below, hot});
    e.coldest = std::min({air, job.initial_temperature, below, cold});
    if (e.kind == Kind::wet || e.kind == Kind::store || e.kind == Kind::two_source) {
        e.warmest = std::max(e.warmest, frost_point(air));
        e.coldest = std::min(e.coldest, frost_point(air));
    }
    e.still = (polar_night || polar_day) && !windy && e.kind != Kind::store;
    e.shines = s.emissivity > 0.02;
    return e;
}

struct Outcome {
    std::array<int, kinds> met{};
    int limited = 0, unbounded = 0, open = 0, infinite = 0, tied = 0, zigzags = 0, boiled = 0;
    int shining = 0, tight = 0;  // cases of more than a watt; closed to 1e-12
    double worst_closure = 0.0, worst_cadence = 0.0;
    std::string first;  // case that broke something

    void say(bool broken, int index, const char* what, int& count) {
        if (!broken) return;
        if (count++ == 0) first += fmt::format("case {}: {}; ", index, what);
    }
};

/// Constant forcing leaves one turn at most, where heat from below comes late: more is a zigzag.
int turns(const std::vector<PointRow>& row) {
    int count = 0;
    for (std::size_t k = 2; k < row.size(); ++k) {
        const double a = row[k - 1].surface_temperature - row[k - 2].surface_temperature;
        const double b = row[k].surface_temperature - row[k - 1].surface_temperature;
        if (a * b < 0.0 && std::min(std::abs(a), std::abs(b)) > 0.01) ++count;
    }
    return count;
}

Outcome take_all() {
    const auto samples = hypercube();
    Outcome o;
    for (int i = 0; i < cases; ++i) {
        const Extreme extreme = job_of(samples[std::size_t(i)]);
        const PointResult result = run_column(extreme.job);
        ++o.met[std::size_t(extreme.kind)];
        if (extreme.kind == Kind::wet && extreme.job.initial_temperature > 373.15) ++o.boiled;
        o.say(result.limited > 0, i, "limited", o.limited);
        o.worst_closure = std::max(o.worst_closure, result.worst_energy_closure);
        if (extreme.shines) {
            ++o.shining;
            if (result.worst_energy_closure < 1e-12) ++o.tight;
        }
        o.say(result.worst_energy_closure > 1e-8, i, "open", o.open);
        for (const PointRow& row : result.row) {
            const bool thaws = extreme.kind == Kind::snow && row.surface_temperature > zero_celsius;
            o.say(thaws, i, "snow above melting", o.unbounded);
            for (const double t :
                 {row.surface_temperature, row.ground_temperature, row.back_temperature}) {
                o.say(!std::isfinite(t), i, "infinite", o.infinite);
                o.say(t > extreme.warmest + 0.01 || t < extreme.coldest - 0.01, i, "unbounded",
                      o.unbounded);
            }
        }
        o.say(extreme.still && turns(result.row) > 1, i, "zigzag", o.zigzags);
        if (i % 8 == 0) {
            PointJob finer = extreme.job;
            finer.step /= 3.0;
            const PointResult other = run_column(finer);
            const double apart =
                std::abs(other.row[18].surface_temperature - result.row[6].surface_temperature);
            o.worst_cadence = std::max(o.worst_cadence, apart);
            o.say(apart > 0.05, i, "tied to its cadence", o.tied);
        }
    }
    return o;
}

const Outcome& outcome() {
    static const Outcome once = take_all();
    return once;
}

}  // namespace

TEST_CASE("nothing a scene may say makes a facet unstable", "[thermal][stress][by_extreme]") {
    CAPTURE(seed);
    const Outcome& o = outcome();
    INFO(o.first);
    WARN(
        fmt::format("{} cases: {} limited, worst closure {:.1e}, {} of {} that carry a watt "
                    "below 1e-12, cadence {:.4f} K",
                    cases, o.limited, o.worst_closure, o.tight, o.shining, o.worst_cadence));
    CHECK(o.infinite == 0);
    CHECK(o.unbounded == 0);
    CHECK(o.zigzags == 0);
    CHECK(o.tied == 0);
    CHECK(o.limited == 0);
    for (const int met : o.met) CHECK(met > 100);
    CHECK(o.boiled >= 20);
}

// 1.1e-9 at worst, where nothing flows and a milliwatt is the measure: there the last digit of a
// temperature shows. Where more than a watt flows nearly all are below 1e-12.
TEST_CASE("extreme columns close their energy to 1e-8, most to 1e-12",
          "[thermal][stress][by_extreme][by_trace]") {
    const Outcome& o = outcome();
    INFO(o.first);
    CHECK(o.open == 0);
    CHECK(o.worst_closure <= 1e-8);
    CHECK(o.tight >= 0.9 * o.shining);
}

TEST_CASE("half a millimetre of steel on foam takes a switched sun",
          "[thermal][stress][by_extreme]") {
    PointJob job;
    job.surface.albedo = 0.1;
    job.surface.emissivity = 0.9;
    job.surface.convection = ConstantFilm{10.0};
    job.surface.layers = {{0.0005, 50.0, 7800.0, 500.0}, {0.05, 0.03, 40.0, 1200.0}};
    job.start = begin;
    job.end = later(begin, 86400.0);
    job.spin_up = SpinUp::none;
    job.initial_temperature = 290.0;
    job.step = 3600.0;
    for (int i = 0; i <= 48; ++i) {
        for (const double edge : {0.0, 1799.0}) {
            Forcing f;
            f.air.temperature = 290.0;
            f.shortwave_down = i % 2 == 0 ? 900.0 : 0.0;
            f.longwave_down = 300.0;
            job.weather.instant.push_back(later(begin, 1800.0 * i + edge));
            job.weather.sample.push_back(f);
        }
    }
    const PointResult result = run_column(job);
    // Balance 810 + 0.9 · 300 = 0.9 σ T⁴ + 10 (T − 290), by bisection, bounds it.
    double low = 290.0, high = 400.0;
    for (int i = 0; i < 60; ++i) {
        const double t = 0.5 * (low + high);
        const double lost = 0.9 * (stefan_boltzmann * power4(t) - 300.0) + 10.0 * (t - 290.0);
        (lost < 810.0 ? low : high) = t;
    }
    for (const PointRow& row : result.row) {
        CHECK(row.surface_temperature <= high + 0.01);
        CHECK(row.surface_temperature >= 275.0);
    }
    CHECK(result.limited == 0);
}
