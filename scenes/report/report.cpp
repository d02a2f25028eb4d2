#include "scenes/report/report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "materials/atmosphere/band_model.hpp"
#include "materials/base/files.hpp"
#include "materials/base/parallel.hpp"
#include "scenes/input/bands.hpp"
#include "scenes/report/contact_sheet.hpp"
#include "scenes/report/html.hpp"
#include "scenes/report/instrument_sheet.hpp"
#include "scenes/report/material_days.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

constexpr const char* style = R"(<style>
body{font:15px/1.5 system-ui,sans-serif;color:#1c2330;background:#fff;max-width:1180px;margin:2em auto;padding:0 1em}
h1{font-size:1.6em;margin-bottom:.1em}h2{margin-top:2em;border-bottom:1px solid #d5dae3;padding-bottom:.2em}
table{border-collapse:collapse;font-variant-numeric:tabular-nums}td,th{padding:.2em .8em;text-align:left;border-bottom:1px solid #e6e9ef}
td.n,th.n{text-align:right}.sheet{display:grid;grid-template-columns:repeat(4,1fr);gap:6px}.sheet figure{margin:0}
.sheet img{width:100%;display:block}figcaption{font-size:.8em;color:#566}.key{color:#566}
svg text{font:12px system-ui,sans-serif}svg .t{font-size:14px;font-weight:600}svg .e{text-anchor:end;fill:#566}
svg .m{text-anchor:middle;fill:#566}svg .g{stroke:#e3e7ee;fill:none}
</style>)";

/// "2026-07-15T05:00:00-04:00 (03:17 solar)"
std::string when(const Prepared& prepared, Instant instant) {
    return fmt::format("{} ({} solar)", format_local(instant, prepared.scene.time.utc_offset),
                       format_solar_time(prepared.world.site, instant));
}

std::string facts(const Prepared& prepared, const JobReport& report) {
    const Plan& plan = report.plan;
    const Site& site = prepared.world.site;
    const auto row = [](const std::string& key, const std::string& value) {
        return "<tr><td class=\"key\">" + key + "</td><td>" + value + "</td></tr>\n";
    };
    std::string out = "<table>\n";
    out +=
        row("place", fmt::format("{:.5f}° {}, {:.5f}° {}, {:.0f} m above the sea",
                                 std::abs(site.latitude_deg), site.latitude_deg < 0.0 ? 'S' : 'N',
                                 std::abs(site.longitude_deg), site.longitude_deg < 0.0 ? 'W' : 'E',
                                 prepared.world.sea_level_height));
    out += row("facets", fmt::format("{} ({} of the ground, from {} posts)", plan.facets,
                                     prepared.world.ground_facets, report.posts));
    out +=
        row("worst vertical error of the mesh",
            fmt::format("{:.3f} m (rms {:.3f} m, allowed {:g} m)", report.ground_check.worst_error,
                        report.ground_check.rms_error, prepared.scene.terrain.tolerance));
    for (const auto& [key, value] : report.heat) out += row(key, escaped(value));
    if (!report.not_converged.empty()) {
        out += row("<strong>not converged</strong>", escaped(report.not_converged));
    }
    if (!report.start.empty()) out += row("start of the heat balance", escaped(report.start));
    out += row("frames", fmt::format("{} instants", plan.frames.size()));
    for (const std::string& line : report.warnings) out += row("warning", escaped(line));
    for (const std::string& note : report.notes) out += row("modelled", escaped(note));
    return out + "</table>\n";
}

/// Of the pictures of an observer, those that a page has room for, the first and the last too.
constexpr std::size_t most_shown = 96;
std::vector<Instant> some_of(const std::vector<Instant>& frames) {
    if (frames.size() <= most_shown) return frames;
    std::vector<Instant> some;
    for (std::size_t i = 0; i < most_shown; ++i) {
        some.push_back(frames[i * (frames.size() - 1) / (most_shown - 1)]);
    }
    return some;
}

std::string timings(const JobReport& report) {
    const auto rays_of = [&](const std::string& stage) -> double {
        if (stage == "sky view") return static_cast<double>(report.plan.sky_rays);
        if (stage == "shadows") return static_cast<double>(report.plan.sun_rays);
        if (stage.starts_with("cast view")) return static_cast<double>(report.plan.view_rays);
        return 0.0;
    };
    std::string out =
        "<table>\n<tr><th>stage</th><th class=\"n\">seconds</th><th class=\"n\">rays, at most</th>"
        "<th class=\"n\">million rays a second</th></tr>\n";
    double sum = 0.0;
    for (const Progress::Stage& stage : report.stages) {
        sum += stage.seconds;
        const double rays = rays_of(stage.name);
        out += fmt::format(
            "<tr><td>{}</td><td class=\"n\">{:.2f}</td><td class=\"n\">{}</td>"
            "<td class=\"n\">{}</td></tr>\n",
            escaped(stage.name), stage.seconds, rays > 0 ? fmt::format("{:.3g}", rays) : "",
            rays > 0 ? fmt::format("{:.1f}", rays / stage.seconds / 1e6) : "");
    }
    return out +
           fmt::format("<tr><th>all, {} threads</th><th class=\"n\">{:.2f}</th></tr></table>\n",
                       thread_count(), sum);
}

std::string decisions(const Plan& plan) {
    std::string out =
        "<table>\n<tr><th></th><th>what</th><th>why</th><th class=\"n\">error</th></tr>\n";
    for (const Decision& decision : plan.decisions) {
        out +=
            fmt::format("<tr><td>{}</td><td>{}</td><td>{}</td><td class=\"n\">{:g} {}</td></tr>\n",
                        decision.computed ? "computed" : "skipped", escaped(decision.what),
                        escaped(decision.why), decision.error, decision.error_unit);
    }
    return out + "</table>\n";
}

}  // namespace

std::vector<std::pair<std::string, std::string>> heat_rows(const SolveReport& solve) {
    return {
        {"heat balance",
         fmt::format("{} steps, {} passes; periodic to {:.1e} K (estimated error {:.1e} K)",
                     solve.steps, solve.passes, solve.periodic_residual, solve.estimated_error)},
        {"worst energy closure",
         fmt::format("{:.1e} of the heat moved, any facet and step", solve.worst_energy_closure)},
        {"Newton iterations", fmt::format("{:.2f} a stage, at most {}", solve.newton_iterations,
                                          solve.worst_newton_iterations)}};
}

void write_report(const fs::path& folder, const Prepared& prepared, const JobReport& report,
                  const TemperatureField& field) {
    const std::vector<DiurnalCurve> curves =
        diurnal_curves(field, prepared.world.surfaces(), prepared.scene.materials);
    std::string html = fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta "
        "charset=\"utf-8\"><title>{0}</title>{1}</head>"
        "<body>\n<h1>{0}</h1>\n<p class=\"key\">diurna {2}, scene {3}, {4} to {5}; the sun stands "
        "highest at 12:00 solar time</p>\n",
        escaped(prepared.scene.title), style, DIURNA_VERSION,
        escaped(prepared.scene.file.filename().string()), when(prepared, report.plan.steps.front()),
        when(prepared, report.plan.steps.back()));
    html += "<h2>What was computed</h2>\n" + facts(prepared, report);
    html += "<h2>The course of each material</h2>\n" +
            curves_chart(prepared, field.instant, curves) +
            curves_table(field.instant, curves, prepared.scene.terrain.default_material,
                         prepared.scene.time.utc_offset);
    html += "<h2>Pictures</h2>\n";
    for (const ObserverInput& observer : prepared.scene.observers) {
        for (const std::string& band : observer.bands) {
            if (observer.frames.size() > most_shown) {
                html += fmt::format("<p>{} of {} pictures of {}, evenly chosen:</p>\n", most_shown,
                                    observer.frames.size(), escaped(observer.name));
            }
            html += contact_sheet(
                folder, observer.name, named_band(prepared.scene.bands, band, bin_edges_um()),
                some_of(observer.frames), [&](Instant instant) { return when(prepared, instant); });
            for (const InstrumentInput& input : prepared.scene.instruments) {
                if (input.observer != observer.name || input.band != band) continue;
                html += instrument_sheet(folder, observer.name, band, input.instrument.name,
                                         some_of(observer.frames),
                                         [&](Instant instant) { return when(prepared, instant); });
            }
        }
    }
    html += "<h2>Time of this run</h2>\n" + timings(report);
    html += "<h2>Plan: computed and skipped</h2>\n" + decisions(report.plan);
    write_whole_file(folder / "report.html", html + "</body></html>\n");
}

}  // namespace diurna
