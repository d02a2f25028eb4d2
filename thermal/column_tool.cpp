#include "thermal/column_tool.hpp"

#include <fmt/format.h>

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <iterator>

#include "materials/error.hpp"
#include "materials/units.hpp"
#include "thermal/batch.hpp"

namespace diurna {

namespace {

constexpr double day = 86400.0;

/// What drives the facet at one instant.
struct Drive {
    AirFilm air;
    double absorbed_solar;  // [W m⁻²]
    double sky_longwave;    // [W m⁻²]
};

class Facet {
 public:
    explicit Facet(const ColumnJob& job) : job_(job) {
        StepSetup setup{.step = job.longest_step,
                        .wind_height = job.weather.wind_height,
                        .air_height = job.weather.air_height,
                        .reference = job.weather.at(job.start).air.temperature,
                        .most_substeps = 1,
                        // Fine enough for minutes, and never cut off: the span may be a year.
                        .grid = {.first = 0.005, .growth = 0.1, .deepest = 1e9}};
        column = material_column(job.surface, setup);
        // A facet whose surroundings are as warm as itself only loses to the sky it sees.
        const double hidden = 1.0 - job.sky_view, emissivity = job.surface.emissivity;
        self_view_ = 1.0 - hidden * (1.0 - emissivity);
        column.surface.emissivity = self_view_ > 0.0 ? emissivity * job.sky_view / self_view_ : 0.0;
        normal_ = direction(job.aspect_deg, 90.0 - job.slope_deg);
        batch.resize(column.grid.size(), 1);
        batch.natural[0] = natural_film(normal_.z());
    }

    Drive drive(Instant when) const {
        const Forcing forcing = job_.weather.at(when);
        const SkyState sky = sky_state(job_.site, job_.elevation, when, forcing, job_.clear_sky);
        double sunlight = sky.plane_of_array;
        if (std::isnan(sunlight)) {
            const double albedo = std::isnan(sky.albedo) ? job_.surface.albedo : sky.albedo;
            const double cosine = normal_.dot(sky.to_sun);
            sunlight = facet_sunlight(sky, cosine, 1.0, job_.sky_view) +
                       (1.0 - job_.sky_view) * albedo * sky.global_horizontal();
        }
        const double reflected = std::isnan(sky.albedo) ? job_.surface.albedo : sky.albedo;
        const double absorptance =
            std::max(0.0, 1.0 - reflected - job_.surface.solar_transmittance);
        return {.air = air_film(column.surface, column.louis, forcing.air, forcing.wind_speed),
                .absorbed_solar = absorptance * sunlight,
                .sky_longwave = sky.longwave_down};
    }

    ColumnRow row(Instant when, const Drive& now) const {
        const double t = batch.temperature[0], emissivity = job_.surface.emissivity;
        const double black = stefan_boltzmann * power4(t);
        const double incoming =
            self_view_ > 0.0
                ? (job_.sky_view * now.sky_longwave + (1.0 - job_.sky_view) * emissivity * black) /
                      self_view_
                : black;
        const HeatBalance balance =
            heat_balance(now.air, batch.natural[0], emissivity, now.absorbed_solar, incoming,
                         job_.surface.internal_heat, t);
        const std::size_t last = column.grid.size() - 1;
        return {.instant = when,
                .surface_temperature = t,
                .absorbed_solar = balance.absorbed_solar,
                .longwave_in = balance.longwave_in,
                .longwave_out = balance.longwave_out,
                .sensible = balance.sensible,
                .latent = balance.latent,
                // The ground takes what the other terms leave over.
                .conducted = -balance.sum(),
                .back_temperature = batch.state[last * lanes] + column.reference};
    }

    double heat(const Drive& d) const {
        return d.absorbed_solar + column.surface.emissivity * d.sky_longwave +
               job_.surface.internal_heat;
    }

    MaterialColumn column;
    Batch batch;

 private:
    const ColumnJob& job_;
    Eigen::Vector3d normal_;
    double self_view_ = 1.0;
};

/// One integration step: its length and what drives its stages.
struct Step {
    double length;
    std::array<AirFilm, 2> air;
    std::array<double, 2> heat;
};

/// The steps from `from` to `to`, equally long and at most the job's longest; `gently`: the first
/// ones grow from half a second, because after a sudden start heat has gone nowhere yet.
std::vector<Step> steps_between(const Facet& facet, const ColumnJob& job, Instant from, Instant to,
                                bool gently) {
    std::vector<double> edge{0.0};
    const double span = seconds_between(from, to);
    if (gently) {
        double step = 0.5;
        while (step < job.longest_step && edge.back() + 2.0 * step < span) {
            edge.push_back(edge.back() + step);
            step *= 1.25;
        }
    }
    const double rest = span - edge.back(), begin = edge.back();
    const auto count = static_cast<int>(std::ceil(rest / job.longest_step - 1e-9));
    for (int i = 1; i <= count; ++i) edge.push_back(begin + rest * i / count);

    std::vector<Step> steps;
    Drive before = facet.drive(from);
    for (std::size_t i = 1; i < edge.size(); ++i) {
        const double length = edge[i] - edge[i - 1];
        const Drive after = facet.drive(later(from, edge[i]));
        const Forcing inner = job.weather.at(later(from, edge[i - 1] + sdirk_gamma * length));
        const double first = facet.heat(before), last = facet.heat(after);
        steps.push_back(
            {length,
             {air_film(facet.column.surface, facet.column.louis, inner.air, inner.wind_speed),
              after.air},
             {first + sdirk_gamma * (last - first), last}});
        before = after;
    }
    return steps;
}

/// Takes the steps; with `map`, carries the linearised period along.
void take(Facet& facet, const std::vector<Step>& steps, StepRecord& record,
          Eigen::MatrixXd* map = nullptr) {
    Stage& stage = facet.column.stage;
    for (const Step& step : steps) {
        if (std::abs(stage.tau - sdirk_gamma * step.length) > 1e-9 * stage.tau) {
            stage =
                make_stage(facet.column.grid, sdirk_gamma * step.length, facet.column.reference);
        }
        advance(facet.column, step.air, {&step.heat[0], &step.heat[1]}, facet.batch, record);
        if (map) {
            linear_step(facet.column.grid, stage, record.slope[0], record.slope[1], *map);
        }
    }
}

/// Finds the state that a span of steps leads back to itself. Returns the passes taken.
int make_periodic(Facet& facet, const std::vector<Step>& steps, double& residual) {
    constexpr int most_passes = 30;
    constexpr double tolerance = 1e-6;  // [K]
    const auto n = static_cast<Eigen::Index>(facet.column.grid.size());
    StepRecord record;
    residual = 0.0;
    for (int passes = 1; passes <= most_passes; ++passes) {
        const std::vector<double> start = facet.batch.state;
        Eigen::MatrixXd map = Eigen::MatrixXd::Identity(n, n);
        take(facet, steps, record, &map);
        Eigen::VectorXd change(n);
        for (Eigen::Index i = 0; i < n; ++i) {
            change[i] = facet.batch.state[i * Eigen::Index(lanes)] - start[i * Eigen::Index(lanes)];
        }
        residual = change.cwiseAbs().maxCoeff();
        if (residual <= tolerance) return passes;
        Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> period;
        period.setThreshold(1e-9);  // a column that loses nothing keeps its mean
        period.compute(Eigen::MatrixXd::Identity(n, n) - map);
        const Eigen::VectorXd move = period.solve(change);
        for (Eigen::Index i = 0; i < n; ++i) {
            facet.batch.state[i * Eigen::Index(lanes)] = start[i * Eigen::Index(lanes)] + move[i];
        }
        facet.batch.temperature[0] = facet.batch.state[0] + facet.column.reference;
    }
    return most_passes;
}

void start_uniform(Facet& facet, double temperature) {
    for (std::size_t i = 0; i < facet.column.grid.size(); ++i) {
        facet.batch.state[i * lanes] = temperature - facet.column.reference;
    }
    facet.batch.temperature[0] = temperature;
}

double initial_temperature(const ColumnJob& job) {
    if (!std::isnan(job.initial_temperature)) return job.initial_temperature;
    if (const auto* fixed = std::get_if<FixedTemperature>(&job.surface.bottom)) {
        return fixed->temperature;
    }
    return job.weather.at(job.start).air.temperature;
}

}  // namespace

ColumnResult run_column(const ColumnJob& given) {
    ColumnJob job = given;
    const bool longwave_missing =
        std::any_of(job.weather.sample.begin(), job.weather.sample.end(),
                    [](const Forcing& f) { return std::isnan(f.longwave_down); });
    if (longwave_missing) infer_cloud(job.weather, job.site, job.elevation, job.clear_sky);

    Facet facet(job);
    ColumnResult result;
    result.note = job.weather.note;
    result.has_back = job.surface.back.has_value();
    start_uniform(facet, initial_temperature(job));
    if (job.spin_up != SpinUp::none) {
        const Instant end =
            job.spin_up == SpinUp::periodic ? job.end : std::min(job.end, later(job.start, day));
        result.passes = make_periodic(facet, steps_between(facet, job, job.start, end, false),
                                      result.periodic_residual);
    }

    const auto rows =
        static_cast<long long>(std::floor(seconds_between(job.start, job.end) / job.step + 1e-9));
    result.row.push_back(facet.row(job.start, facet.drive(job.start)));
    StepRecord record;
    for (long long i = 0; i < rows; ++i) {
        const Instant from = later(job.start, double(i) * job.step);
        const Instant to = later(job.start, double(i + 1) * job.step);
        const bool gently = i == 0 && job.spin_up == SpinUp::none;
        take(facet, steps_between(facet, job, from, to, gently), record);
        result.row.push_back(facet.row(to, facet.drive(to)));
    }
    result.worst_energy_closure = record.worst_closure;
    return result;
}

std::string column_csv(const ColumnResult& result) {
    fmt::memory_buffer text;
    const auto out = std::back_inserter(text);
    if (!result.note.empty()) fmt::format_to(out, "# {}\n", result.note);
    fmt::format_to(out,
                   "time,surface_temperature_K,absorbed_solar_W_m2,longwave_in_W_m2,"
                   "longwave_out_W_m2,sensible_W_m2,latent_W_m2,conducted_W_m2{}\n",
                   result.has_back ? ",back_temperature_K" : "");
    for (const ColumnRow& r : result.row) {
        fmt::format_to(out, "{},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f},{:.4f}",
                       format_instant(r.instant), r.surface_temperature, r.absorbed_solar,
                       r.longwave_in, r.longwave_out, r.sensible, r.latent, r.conducted);
        if (result.has_back) fmt::format_to(out, ",{:.4f}", r.back_temperature);
        fmt::format_to(out, "\n");
    }
    return fmt::to_string(text);
}

}  // namespace diurna
