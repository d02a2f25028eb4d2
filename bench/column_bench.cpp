// Time against error of the heat balance, every method and setting, on facets of the default scene
// under its own horizons and weather: a periodic day, its start included, shadow edges at their
// instants. Time is of the processor, on one thread, without exchange between facets and without
// what is done once whatever the method (sunlight, shadows). The reference is layered, in steps of
// 5 s on a grid four times as fine. Peers (bench/column_peers.hpp) take the same columns and the
// same forcing: CVODE once with the periodic start for nothing, once after 20 days from 295 K, as
// the plain column has them.

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <map>
#include <numeric>

#include "bench/column_peers.hpp"
#include "materials/base/parallel.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/job.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/solve/shadow_edges.hpp"
#include "thermal/solve/solver.hpp"

using namespace diurna;

namespace {

double cpu_seconds() { return double(std::clock()) / CLOCKS_PER_SEC; }

/// Every so-manieth facet of the default scene, seen from where it stands.
struct Sample {
    const Prepared& prepared;
    std::vector<std::size_t> from;  // (facet) in the scene
    FacetSet facets{};
    FacetViews view{};
    SunExposure sun{};

    Sample(const Prepared& scene, const FacetViews& whole, std::size_t wanted) : prepared(scene) {
        const FacetSet& all = scene.world.facets;
        for (std::size_t k = 0; k < wanted; ++k) {
            const std::size_t f = k * all.size() / wanted;
            from.push_back(f);
            facets.centroid.push_back(all.centroid[f]);
            facets.normal.push_back(all.normal[f]);
            facets.area.push_back(all.area[f]);
            facets.material.push_back(all.material[f]);
            view.sky.push_back(whole.sky[f]);
            view.below.push_back(whole.below[f]);
            view.shares.push_back(whole.shares[f]);
        }
        facets.object.assign(wanted, ObjectId{0});  // ground: none has another side
        view.others.row.assign(wanted + 1, 0);
        std::vector<std::uint32_t> asked;
        std::vector<float> answer(all.size(), 0.0f);
        const auto fraction_at = [&](Instant when, std::span<const std::uint32_t> chosen,
                                     std::span<float> fraction) {
            asked.clear();
            for (const std::uint32_t k : chosen) {
                asked.push_back(static_cast<std::uint32_t>(from[k]));
            }
            sun_fraction(all, scene.rays, sun_direction(sun_position(scene.world.site, when)),
                         asked, answer);
            for (const std::uint32_t k : chosen) fraction[k] = answer[from[k]];
        };
        sun.instant = step_instants(options());
        std::vector<std::uint32_t> everyone(wanted);
        std::iota(everyone.begin(), everyone.end(), 0u);
        for (std::size_t i = 0; i < sun.instant.size(); ++i) {
            sun.fraction.resize((i + 1) * wanted);
            fraction_at(sun.instant[i], everyone, std::span(sun.fraction).last(wanted));
        }
        find_edges(sun, fraction_at);
    }

    SolveOptions options() const {
        SolveOptions o;
        o.start = prepared.scene.time.start;
        o.keep_every = o.step;
        o.exchange = false;
        return o;
    }

    /// The same facets over and over, for a scene's size.
    void repeat(std::size_t times) {
        const std::size_t n = facets.size();
        const SunExposure once = sun;
        sun.fraction.clear();
        sun.edge.clear();
        for (std::size_t k = n; k < n * times; ++k) {
            facets.centroid.push_back(facets.centroid[k % n]);
            facets.normal.push_back(facets.normal[k % n]);
            facets.area.push_back(facets.area[k % n]);
            facets.material.push_back(facets.material[k % n]);
            view.sky.push_back(view.sky[k % n]);
            view.below.push_back(view.below[k % n]);
            view.shares.push_back(view.shares[k % n]);
        }
        facets.object.assign(n * times, ObjectId{0});
        view.others.row.assign(n * times + 1, 0);
        for (std::size_t i = 0; i < once.instant.size(); ++i) {
            const auto row = once.fraction.begin() + std::ptrdiff_t(i * n);
            for (std::size_t k = 0; k < times; ++k) {
                sun.fraction.insert(sun.fraction.end(), row, row + std::ptrdiff_t(n));
            }
        }
        for (const ShadowEdge& edge : once.edge) {
            for (std::size_t k = 0; k < times; ++k) {
                sun.edge.push_back({edge.step, std::uint32_t(edge.facet + k * n), edge.share});
            }
        }
    }

    SolveResult run(const SolveOptions& o) const {
        ClearSky clear;
        clear.longwave_by_direction = false;  // as the peers have it
        return solve({.facets = facets,
                      .views = view,
                      .sun = sun,
                      .materials = prepared.scene.materials,
                      .weather = prepared.weather,
                      .site = prepared.world.site,
                      .elevation = prepared.world.sea_level_height,
                      .clear_sky = clear},
                     o);
    }
};

struct Error {
    double sum = 0.0, worst = 0.0;
    std::size_t count = 0;
    void add(double difference) {
        sum += difference * difference;
        worst = std::max(worst, std::abs(difference));
        ++count;
    }
    double rms() const { return std::sqrt(sum / double(count)); }
};

void print(const std::string& method, const std::string& setting, std::size_t facets,
           double seconds, const Error& error) {
    for (const bool worst : {false, true}) {
        fmt::print("column_day,{},{},{},1,{:.4f},{:.4f},{}\n", method, setting, facets, seconds,
                   worst ? error.worst : error.rms(), worst ? "K worst" : "K rms");
    }
    std::fflush(stdout);
}

/// The forcing of one facet as the peers take it.
FacetDay facet_day(const Sample& sample, std::size_t f, const MaterialColumn& column,
                   const std::vector<StageForcing>& air) {
    const SolveOptions o = sample.options();
    const SunExposure& sun = sample.sun;
    const std::size_t n = sample.facets.size();
    const Eigen::Vector3d normal = sample.facets.normal[f].cast<double>();
    ClearSky clear;
    clear.longwave_by_direction = false;
    std::vector<SkyState> sky;
    FacetDay day{.column = &column,
                 .air = &air,
                 .natural = facet_film(column.surface.convection, normal.z(), {}),
                 .step = o.step,
                 .heat = {},
                 .jump = {}};
    const OpenSky open = open_sky(sky_of(sample.view, sample.facets, f));
    const auto light = [&](std::size_t i, double fraction) {
        return facet_sunlight(sky[i], normal.dot(sky[i].to_sun), fraction, open);
    };
    for (std::size_t i = 0; i < sun.instant.size(); ++i) {
        sky.push_back(sky_state(sample.prepared.world.site, sample.prepared.world.sea_level_height,
                                sun.instant[i], sample.prepared.weather.at(sun.instant[i]), clear));
        day.heat.push_back(column.absorptance() * light(i, sun.fraction[i * n + f]) +
                           column.surface.internal_heat);
    }
    for (const ShadowEdge& edge : sun.edge) {
        if (edge.facet != f) continue;
        const std::size_t i = edge.step;
        const double change =
            double(sun.fraction[(i + 1) * n + f]) - double(sun.fraction[i * n + f]);
        const double at_0 = light(i, 1.0) - light(i, 0.0);
        const double at_1 = light(i + 1, 1.0) - light(i + 1, 0.0);
        day.jump.push_back(
            {i, edge.share, column.absorptance() * change * (at_0 + edge.share * (at_1 - at_0))});
    }
    return day;
}

/// The sample's day by layered columns in steps of 5 s on a grid four times as fine.
TemperatureField exact_day(const Sample& sample) {
    SolveOptions exact = sample.options();
    exact.method = Method::layered;
    exact.refinement = 120;
    exact.tolerance = 1e-5;
    exact.max_passes = 20;
    exact.grid = {.first = 0.0125, .growth = 0.08};
    return sample.run(exact).temperature;
}

/// The least time of five runs.
Error solve_row(const Sample& sample, const TemperatureField& reference, const SolveOptions& o,
                const std::string& setting) {
    SolveResult result;
    double seconds = 1e9;
    for (int again = 0; again < 5; ++again) {
        result = sample.run(o);
        seconds = std::min(seconds, result.report.step_cpu_seconds);
    }
    Error error;
    for (std::size_t i = 0; i < reference.kelvin.size(); ++i) {
        error.add(double(result.temperature.kelvin[i]) - reference.kelvin[i]);
    }
    print(o.method == Method::modes ? "modes" : "layered",
          fmt::format("{} passes {}", setting, result.report.passes), sample.facets.size(), seconds,
          error);
    return error;
}

/// Every method and setting. Returns errors by the modes' error, of whole steps.
std::map<double, Error> solve_rows(const Sample& sample, const TemperatureField& reference) {
    std::map<double, Error> coarse_error;
    for (const Method method : {Method::layered, Method::modes}) {
        for (const int refinement : {1, 2, 4}) {
            for (const double mode_error : {0.03, 0.004}) {
                for (const double tolerance : {1e-2, 1e-4}) {
                    if (method == Method::layered && mode_error != 0.004) continue;
                    SolveOptions o = sample.options();
                    o.method = method;
                    o.refinement = refinement;
                    o.mode_error = mode_error;
                    o.tolerance = tolerance;
                    const Error error = solve_row(sample, reference, o,
                                                  fmt::format("steps/{} modes {} tolerance {:.0e}",
                                                              refinement, mode_error, tolerance));
                    if (method == Method::modes && refinement == 1) {
                        coarse_error[mode_error] = error;
                    }
                }
            }
        }
    }
    return coarse_error;
}

/// Facets of each material in turn as the peers take them; not plates with air behind, which they
/// do not know.
struct Peers {
    std::map<std::size_t, MaterialColumn> column, thirty;
    std::map<std::size_t, std::vector<StageForcing>> air;
    std::vector<std::size_t> asked;
    std::vector<FacetDay> day, day_of_thirty;
    std::vector<std::vector<double>> start;

    explicit Peers(const Sample& sample) {
        take_materials(sample);
        take_days(sample);
    }
    void take_materials(const Sample& sample) {
        const Prepared& prepared = sample.prepared;
        const SolveOptions plain = sample.options();
        for (std::size_t f = 0; f < sample.facets.size(); f += 43) {
            if (!prepared.scene.materials[sample.facets.material[f]].thermal.back)
                asked.push_back(f);
        }
        for (const std::size_t f : asked) {
            const MaterialId id = sample.facets.material[f];
            const ThermalSurface& surface = prepared.scene.materials[id].thermal;
            const StepSetup setup{.step = plain.step,
                                  .wind_height = prepared.weather.wind_height,
                                  .air_height = prepared.weather.air_height,
                                  .reference = 295.0,
                                  .grid = {}};
            if (column.contains(index(id))) continue;
            column.emplace(index(id), material_column(surface, setup));
            StepSetup coarse = setup;
            coarse.grid = {.first = 0.04, .growth = 0.14};
            thirty.emplace(index(id), material_column(surface, coarse));
            std::vector<StageForcing>& minutes = air[index(id)];
            for (int m = 0; m <= 1440; ++m) {
                const Instant when = later(plain.start, 60.0 * m);
                const Forcing forcing = prepared.weather.at(when);
                minutes.push_back(
                    {air_film(surface, column.at(index(id)).louis, forcing.air, forcing.wind_speed),
                     sky_state(prepared.world.site, prepared.world.sea_level_height, when, forcing)
                         .longwave_down});
            }
        }
    }
    void take_days(const Sample& sample) {
        for (const std::size_t f : asked) {
            const std::size_t id = index(sample.facets.material[f]);
            day.push_back(facet_day(sample, f, column.at(id), air.at(id)));
            day_of_thirty.push_back(facet_day(sample, f, thirty.at(id), air.at(id)));
            start.push_back(periodic_start(day.back()));
        }
    }
};

template <class Day>
void peer_row(const Peers& peers, const TemperatureField& reference, std::size_t n,
              const std::string& method, const std::string& setting, const Day& solve_day) {
    Error error;
    double seconds = 0.0;
    for (std::size_t k = 0; k < peers.asked.size(); ++k) {
        const double since = cpu_seconds();
        const std::vector<double> surface = solve_day(k);
        seconds += cpu_seconds() - since;
        for (std::size_t i = 0; i < surface.size(); ++i) {
            error.add(surface[i] - reference.kelvin[i * n + peers.asked[k]]);
        }
    }
    print(method, setting, peers.asked.size(), seconds, error);
}

void peer_rows(const Sample& sample, const TemperatureField& reference) {
    const Peers peers(sample);
    const auto peer = [&](const std::string& method, const std::string& setting, auto&& day) {
        peer_row(peers, reference, sample.facets.size(), method, setting, day);
    };
    for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7, 1e-8}) {
        peer("cvode", fmt::format("rtol {:.0e} start given", tolerance), [&](std::size_t k) {
            std::vector<double> state = peers.start[k];
            return cvode_day(peers.day[k], state, tolerance);
        });
    }
    for (const double tolerance : {1e-3, 1e-4, 1e-5, 1e-6}) {
        peer("cvode", fmt::format("rtol {:.0e} 20 days", tolerance), [&](std::size_t k) {
            std::vector<double> state(peers.start[k].size(), 295.0);
            for (int d = 0; d < 20; ++d) cvode_day(peers.day[k], state, tolerance);
            return cvode_day(peers.day[k], state, tolerance);
        });
    }
    peer("backward_euler", "30 nodes 600 s 20 days",
         [&](std::size_t k) { return euler_days(peers.day_of_thirty[k], 20); });
}

/// A scene's size: 262 144 facets, 8 192 of the scene 32 times.
void large_rows(const Prepared& prepared, const FacetViews& whole,
                const std::map<double, Error>& coarse_error) {
    Sample large(prepared, whole, 8192);
    large.repeat(32);
    for (const double mode_error : {0.03, 0.004}) {
        for (const double tolerance : {1e-2, 1e-4}) {
            SolveOptions o = large.options();
            o.mode_error = mode_error;
            o.tolerance = tolerance;
            o.keep_every = 3600.0;
            const SolveResult result = large.run(o);
            print("modes",
                  fmt::format("whole scene modes {} tolerance {:.0e} passes {}", mode_error,
                              tolerance, result.report.passes),
                  large.facets.size(), result.report.step_cpu_seconds, coarse_error.at(mode_error));
        }
    }
}

/// The default scene with surfaces that hold no water: dew is no matter of columns, and the peers
/// know none (bench/wet_bench.cpp measures it).
Prepared dry_scene() {
    Scene scene = read_scene(std::string(DIURNA_SOURCE_DIR) + "/scenes/jacksboro/scene.toml");
    for (const std::string& name : scene.materials.names()) {
        Material dry = scene.materials[scene.materials.find(name)];
        dry.thermal.store = {};
        scene.materials.add(std::move(dry));
    }
    return prepare(std::move(scene));
}

}  // namespace

int main() {
    const Prepared prepared = dry_scene();
    const FacetViews whole = facet_views(prepared.world.facets, prepared.rays, {.rays = 16});
    const Sample sample(prepared, whole, 1024);
    set_thread_count(1);
    const TemperatureField reference = exact_day(sample);
    fmt::print("case,method,setting,facets,threads,cpu_s,error,unit\n");
    const std::map<double, Error> coarse_error = solve_rows(sample, reference);
    peer_rows(sample, reference);
    large_rows(prepared, whole, coarse_error);
    return 0;
}
