#include "scenes/report/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "materials/atmosphere/band_model.hpp"
#include "materials/base/files.hpp"
#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "render/picture/exr.hpp"
#include "render/picture/quicklook.hpp"
#include "scenes/input/bands.hpp"
#include "scenes/report/chart.hpp"

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

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '&')
            out += "&amp;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

std::string base64(std::span<const std::byte> bytes) {
    constexpr const char* digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t block = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            block = (block << 8) |
                    (i + k < bytes.size() ? static_cast<std::uint32_t>(bytes[i + k]) : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            out += i + k <= bytes.size() ? digits[(block >> (18 - 6 * k)) & 63u] : '=';
        }
    }
    return out;
}

/// Colours of the materials that many scenes have, and of air; the others take theirs in turn.
std::string colour_of(const std::string& material, std::size_t turn = 0) {
    static const std::map<std::string, std::string> known = {
        {"grass", "#4c9f38"}, {"forest", "#14532d"},        {"bare_soil", "#a0622d"},
        {"rock", "#7a7a7a"},  {"asphalt", "#1c2330"},       {"concrete", "#c08a00"},
        {"water", "#1f77d0"}, {"painted_steel", "#d62728"}, {"glass", "#17a2b8"},
        {"air", "#9467bd"}};
    static constexpr std::array others = {"#e377c2", "#6b8e23", "#ff7f0e", "#5b5bd6",
                                          "#b8405e", "#2aa198", "#8c564b", "#9aa3b2"};
    const auto colour = known.find(material);
    return colour != known.end() ? colour->second : others[turn % others.size()];
}

/// Hours of the day in the offset the scene's start was written in are not kept; UTC is.
double hour(const std::vector<Instant>& instants, std::size_t i) {
    return seconds_between(instants.front(), instants[i]) / 3600.0;
}

std::string facts(const Prepared& prepared, const JobReport& report) {
    const Plan& plan = report.plan;
    const auto row = [](const std::string& key, const std::string& value) {
        return "<tr><td class=\"key\">" + key + "</td><td>" + value + "</td></tr>\n";
    };
    std::string out = "<table>\n";
    out += row("place",
               fmt::format("{:.5f}° N, {:.5f}° E, {:.0f} m above the sea",
                           prepared.world.site.latitude_deg, prepared.world.site.longitude_deg,
                           prepared.world.sea_level_height));
    out += row("facets", fmt::format("{} ({} of the ground, from {} posts)", plan.facets,
                                     prepared.world.ground_facets, report.posts));
    out +=
        row("worst vertical error of the mesh",
            fmt::format("{:.3f} m (rms {:.3f} m, allowed {:g} m)", report.ground_check.worst_error,
                        report.ground_check.rms_error, prepared.scene.terrain.tolerance));
    if (report.solved) {
        const SolveReport& solve = report.solve;
        out += row(
            "heat balance",
            fmt::format("{} steps, {} passes; periodic to {:.1e} K (estimated error {:.1e} K)",
                        solve.steps, solve.passes, solve.periodic_residual, solve.estimated_error));
        out +=
            row("worst energy closure", fmt::format("{:.1e} of the heat moved, any facet and step",
                                                    solve.worst_energy_closure));
        out += row("Newton iterations",
                   fmt::format("{:.2f} a stage, at most {}", solve.newton_iterations,
                               solve.worst_newton_iterations));
    } else {
        out += row("heat balance", "temperatures kept from an earlier run");
    }
    out += row("frames", fmt::format("{} instants, {} rendered in this run", plan.frames.size(),
                                     report.frames_rendered));
    for (const std::string& note : report.notes) out += row("modelled", escaped(note));
    return out + "</table>\n";
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

std::string curves_chart(const Prepared& prepared, const std::vector<Instant>& instants,
                         const std::vector<DiurnalCurve>& curves) {
    Chart chart{.title = "Surface temperature by material, mean over area",
                .x_title = "hours after " + format_instant(instants.front()),
                .y_title = "°C",
                .x_last = hour(instants, instants.size() - 1),
                .x_tick = 2.0,
                .lines = {}};
    ChartLine air{.name = "air", .colour = colour_of("air"), .x = {}, .y = {}, .dashed = true};
    for (std::size_t i = 0; i < instants.size(); ++i) {
        air.x.push_back(hour(instants, i));
        air.y.push_back(celsius(prepared.weather.at(instants[i]).air.temperature));
    }
    for (const DiurnalCurve& curve : curves) {
        ChartLine line{.name = curve.material,
                       .colour = colour_of(curve.material, chart.lines.size()),
                       .x = air.x,
                       .y = {}};
        for (const double kelvin : curve.mean) line.y.push_back(celsius(kelvin));
        chart.lines.push_back(std::move(line));
    }
    chart.lines.push_back(std::move(air));
    return svg(chart);
}

std::string curves_table(const std::vector<Instant>& instants,
                         const std::vector<DiurnalCurve>& curves, const std::string& background) {
    const auto reference = std::find_if(curves.begin(), curves.end(), [&](const DiurnalCurve& c) {
        return c.material == background;
    });
    std::string out =
        "<table>\n<tr><th>material</th><th class=\"n\">facets</th><th class=\"n\">hectares</th>"
        "<th class=\"n\">coldest mean °C</th><th class=\"n\">warmest mean °C</th>"
        "<th class=\"n\">spread (10 to 90 %) at the warmest, K</th><th>crossover with " +
        escaped(background) + ", UTC</th></tr>\n";
    for (const DiurnalCurve& curve : curves) {
        const auto [low, high] = std::minmax_element(curve.mean.begin(), curve.mean.end());
        const auto warmest = static_cast<std::size_t>(high - curve.mean.begin());
        std::string crossed;
        if (reference != curves.end() && &*reference != &curve) {
            for (const Instant instant : crossovers(instants, curve, *reference)) {
                crossed += (crossed.empty() ? "" : ", ") + format_instant(instant).substr(11, 5);
            }
            if (crossed.empty()) crossed = "none";
        }
        out += fmt::format(
            "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{:.2f}</td><td "
            "class=\"n\">{:.1f}</td><td class=\"n\">{:.1f}</td><td class=\"n\">{:.1f}</td>"
            "<td>{}</td></tr>\n",
            escaped(curve.material), curve.facets, curve.area / 1e4, celsius(*low), celsius(*high),
            curve.ninetieth[warmest] - curve.tenth[warmest], crossed);
    }
    return out + "</table>\n";
}

/// All frames of an observer in a band, on one colour scale.
std::string contact_sheet(const fs::path& folder, const std::string& observer, const Band& band,
                          const std::vector<Instant>& frames) {
    const std::string plane = shown_plane(band);
    std::vector<Frame> pictures(frames.size());
    for_each_index(
        frames.size(),
        [&](std::size_t i) {
            Frame named;
            named.observer = observer;
            named.instant = frames[i];
            Frame whole = read_exr(folder / "frames" / (frame_name(named, band.name) + ".exr"));
            pictures[i] = whole;
            pictures[i].planes = {whole[plane]};
            if (const Plane* solid = whole.find("temperature")) {
                pictures[i].planes.push_back(*solid);
            }
        },
        1);
    ColourScale scale{1e9, -1e9};
    for (const Frame& picture : pictures) {
        const ColourScale own = colour_scale(picture, plane);
        scale = {std::min(scale.low, own.low), std::max(scale.high, own.high)};
    }
    std::vector<std::string> figures(frames.size());
    for_each_index(
        frames.size(),
        [&](std::size_t i) {
            const std::vector<std::byte> png = encode_thumbnail(pictures[i], plane, scale, 2);
            figures[i] = fmt::format(
                "<figure><img alt=\"{0}\" "
                "src=\"data:image/png;base64,{1}\"/><figcaption>{0}</figcaption>"
                "</figure>\n",
                format_instant(frames[i]), base64(png));
        },
        1);
    const bool radiance = plane.starts_with("radiance");
    std::string out = fmt::format(
        "<h3>{}, {}, {:g} to {:g} µm: {} {:.3g} to {:.3g} {}</h3>\n<div class=\"sheet\">\n",
        escaped(observer), escaped(band.name), band.from_um(), band.to_um(),
        radiance ? "radiance" : "apparent temperature", scale.low, scale.high,
        colour_unit(pictures.front()[plane]));
    for (const std::string& figure : figures) out += figure;
    return out + "</div>\n";
}

}  // namespace

void write_report(const fs::path& folder, const Prepared& prepared, const JobReport& report,
                  const std::vector<Instant>& instants, const std::vector<DiurnalCurve>& curves) {
    std::string html = fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta "
        "charset=\"utf-8\"><title>{0}</title>{1}</head>"
        "<body>\n<h1>{0}</h1>\n<p class=\"key\">diurna {2}, scene {3}, {4} to {5}</p>\n",
        escaped(prepared.scene.title), style, DIURNA_VERSION,
        escaped(prepared.scene.file.filename().string()), format_instant(report.plan.steps.front()),
        format_instant(report.plan.steps.back()));
    html += "<h2>What was computed</h2>\n" + facts(prepared, report);
    html += "<h2>The day of each material</h2>\n" + curves_chart(prepared, instants, curves) +
            curves_table(instants, curves, prepared.scene.terrain.default_material);
    html += "<h2>Pictures</h2>\n";
    for (const ObserverInput& observer : prepared.scene.observers) {
        for (const std::string& band : observer.bands) {
            html += contact_sheet(folder, observer.name,
                                  named_band(prepared.scene.bands, band, bin_edges_um()),
                                  report.plan.frames);
        }
    }
    html += "<h2>Time</h2>\n" + timings(report);
    html += "<h2>Plan: computed and skipped</h2>\n" + decisions(report.plan);
    write_whole_file(folder / "report.html", html + "</body></html>\n");
}

}  // namespace diurna
