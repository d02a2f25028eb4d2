#include "scenes/products/report/group_days.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "materials/base/units.hpp"
#include "scenes/charts/chart_figure.hpp"
#include "scenes/charts/html.hpp"
#include "scenes/charts/time_axis.hpp"
#include "scenes/products/report/page.hpp"

namespace diurna {

namespace {

/// Lines that a chart has room for; a table has more.
constexpr std::size_t most_lines = 24, most_rows = 200;

constexpr std::array others = {"#e377c2", "#6b8e23", "#ff7f0e", "#5b5bd6", "#b8405e", "#2aa198",
                               "#8c564b", "#7d8797", "#0b7a75", "#c2185b", "#9e7b00", "#4b6cb7"};

/// Whether a curve is that of what is around, or of the same material: crossings of what differs
/// by less than a camera's noise tell nothing.
bool is_around(const GroupDays& days, const DiurnalCurve& curve) {
    constexpr double same = 0.1;  // [K]
    for (std::size_t i = 0; i < curve.mean.size(); ++i) {
        if (std::abs(curve.mean[i] - days.around->mean[i]) > same) return false;
    }
    return true;
}

std::vector<Instant> crossings_of(const GroupDays& days, const DiurnalCurve& curve) {
    if (!days.around || is_around(days, curve)) return {};
    return crossovers(days.instants, curve, *days.around);
}

double mean_at(const std::vector<Instant>& instants, const DiurnalCurve& curve, Instant when) {
    const auto after = static_cast<std::size_t>(
        std::upper_bound(instants.begin(), instants.end(), when) - instants.begin());
    if (after == 0) return curve.mean.front();
    if (after == instants.size()) return curve.mean.back();
    const double share = seconds_between(instants[after - 1], when) /
                         seconds_between(instants[after - 1], instants[after]);
    return curve.mean[after - 1] + share * (curve.mean[after] - curve.mean[after - 1]);
}

/// A line, the dots where it crosses, and its row of their times.
void add_line(const GroupDays& days, const TimeAxis& axis, const DiurnalCurve& curve,
              const std::vector<double>& x, Chart& chart) {
    const std::size_t turn = chart.lines.size();
    ChartLine line{.name = curve.name,
                   .colour = colour_of(curve.name, turn),
                   .x = x,
                   .y = {},
                   .dashed = turn >= others.size()};
    for (const double kelvin : curve.mean) line.y.push_back(celsius(kelvin));
    ChartRow row{.name = curve.name, .colour = line.colour, .event = {}};
    for (const Instant when : crossings_of(days, curve)) {
        row.event.emplace_back(axis.x(when), axis.says(when));
        chart.marks.push_back(
            {.line = turn,
             .x = axis.x(when),
             .y = celsius(mean_at(days.instants, curve, when)),
             .says = curve.name + " crosses " + days.around->name + " at " + axis.says(when)});
    }
    chart.lines.push_back(std::move(line));
    if (!row.event.empty()) chart.rows.push_back(std::move(row));
}

std::string chart_of(const GroupDays& days, const std::string& title,
                     const std::vector<DiurnalCurve>& curves) {
    const TimeAxis axis =
        time_axis(days.instants.front(), days.instants.back(), days.prepared.scene.time.utc_offset);
    Chart chart{.title = title,
                .x_title = axis.title,
                .y_title = "°C",
                .x_last = axis.hours,
                .lines = {},
                .ticks = axis.ticks,
                .rows_title = days.around ? "is as warm as " + days.around->name + " at" : "",
                .outliers_apart = true};
    ChartLine air{.name = "air", .colour = colour_of("air"), .x = {}, .y = {}, .dashed = true};
    for (const Instant when : days.instants) {
        air.x.push_back(axis.x(when));
        air.y.push_back(celsius(days.prepared.weather.at(when).air.temperature));
    }
    for (std::size_t i = 0; i < std::min(curves.size(), most_lines); ++i) {
        add_line(days, axis, curves[i], air.x, chart);
    }
    chart.lines.push_back(std::move(air));
    std::string out = chart_figure(chart);
    if (curves.size() > most_lines) {
        out += fmt::format("<p class=\"key\">The first {} of {}.</p>\n", most_lines, curves.size());
    }
    return out;
}

std::string area_of(double area) {
    return area < 1e4 ? fmt::format("{:.{}f} m²", area, area < 100.0 ? 1 : 0)
                      : fmt::format("{:.1f} ha", area / 1e4);
}

std::string table_of(const GroupDays& days, const std::string& what,
                     const std::vector<DiurnalCurve>& curves) {
    const TimeAxis axis =
        time_axis(days.instants.front(), days.instants.back(), days.prepared.scene.time.utc_offset);
    std::string out = fmt::format(
        "<table class=\"figures\">\n<tr><th>{}</th><th class=\"n\">facets</th><th "
        "class=\"n\">area</th>"
        "<th class=\"n\">coldest<br>mean °C</th><th>at</th><th class=\"n\">warmest<br>mean °C</th>"
        "<th>at</th><th class=\"n\">spread at the<br>warmest instant,<br>10 to 90 %, "
        "K</th><th>{}</th></tr>\n",
        what, days.around ? "as warm as " + escaped(days.around->name) + " at" : "");
    for (std::size_t i = 0; i < std::min(curves.size(), most_rows); ++i) {
        const DiurnalCurve& curve = curves[i];
        std::string crossed;
        for (const Instant when : crossings_of(days, curve)) {
            crossed += (crossed.empty() ? "" : ", ") + axis.says(when);
        }
        const bool itself =
            days.around && curve.facets == days.around->facets && curve.area == days.around->area;
        if (days.around && crossed.empty() && !itself) {
            crossed = is_around(days, curve) ? "the whole time, within 0.1 K" : "never";
        }
        out += fmt::format(
            "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{:.1f}"
            "</td><td>{}</td><td class=\"n\">{:.1f}</td><td>{}</td><td class=\"n\">{:.1f}</td>"
            "<td>{}</td></tr>\n",
            escaped(curve.name), curve.facets, area_of(curve.area),
            celsius(curve.mean[curve.coldest()]), axis.says(days.instants[curve.coldest()]),
            celsius(curve.mean[curve.warmest()]), axis.says(days.instants[curve.warmest()]),
            curve.ninetieth - curve.tenth, crossed);
    }
    out = wide(out + "</table>");
    if (curves.size() > most_rows) {
        out += fmt::format("<p class=\"key\">The first {} of {}.</p>\n", most_rows, curves.size());
    }
    return out;
}

}  // namespace

std::string colour_of(const std::string& name, std::size_t turn) {
    static const std::map<std::string, std::string> known = {
        {"grass", "#4c9f38"}, {"forest", "#14532d"},        {"bare_soil", "#a0622d"},
        {"rock", "#7a7a7a"},  {"asphalt", "#1c2330"},       {"concrete", "#c08a00"},
        {"water", "#1f77d0"}, {"painted_steel", "#d62728"}, {"glass", "#17a2b8"},
        {"air", "#9467bd"}};
    const auto colour = known.find(name);
    return colour != known.end() ? colour->second : others[turn % others.size()];
}

std::string between_instants(const std::vector<Instant>& instants) {
    double widest = 0.0;
    for (std::size_t i = 1; i < instants.size(); ++i) {
        widest = std::max(widest, seconds_between(instants[i - 1], instants[i]) / 3600.0);
    }
    if (widest == 0.0) return "";
    if (widest <= 0.5) {
        return fmt::format(
            "<p class=\"key\">Times of equal temperature are interpolated linearly between stored "
            "instants, {:.3g} min apart; <code>diurna crossover</code> computes them to the "
            "second.</p>\n",
            60.0 * widest);
    }
    return fmt::format(
        "<p class=\"key\">Temperatures are interpolated linearly between {} stored instants, up to "
        "{:.3g} h apart: extremes and crossovers between them may be missed.</p>\n",
        instants.size(), widest);
}

std::string group_days(const GroupDays& days, const std::string& title, const std::string& what,
                       const std::vector<DiurnalCurve>& curves) {
    return chart_of(days, title, curves) + table_of(days, what, curves);
}

}  // namespace diurna
