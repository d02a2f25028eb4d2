#include "scenes/report/material_days.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "materials/base/units.hpp"
#include "scenes/report/chart.hpp"
#include "scenes/report/html.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

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

double hour(const std::vector<Instant>& instants, std::size_t i) {
    return seconds_between(instants.front(), instants[i]) / 3600.0;
}

/// [h] between the marks of so many hours: at most 13, whole days of long spans.
double tick(double hours) {
    for (const double every : {1.0, 2.0, 3.0, 6.0, 12.0, 24.0}) {
        if (hours <= 12.0 * every) return every;
    }
    return 24.0 * std::ceil(hours / (12.0 * 24.0));
}

/// What curves of so few instants are, where more than half an hour lies between some.
std::string between_instants(const std::vector<Instant>& instants) {
    double widest = 0.0;
    for (std::size_t i = 1; i < instants.size(); ++i) {
        widest = std::max(widest, seconds_between(instants[i - 1], instants[i]) / 3600.0);
    }
    if (widest <= 0.5) return "";
    return fmt::format(
        "<p class=\"key\">Straight between the {} instants kept, up to {:.3g} h apart: "
        "extremes and crossovers in between are not in it.</p>\n",
        instants.size(), widest);
}

}  // namespace

std::string curves_chart(const Prepared& prepared, const std::vector<Instant>& instants,
                         const std::vector<DiurnalCurve>& curves) {
    Chart chart{
        .title = "Surface temperature by material, mean over area",
        .x_title = "hours after " + format_local(instants.front(), prepared.scene.time.utc_offset),
        .y_title = "°C",
        .x_last = hour(instants, instants.size() - 1),
        .x_tick = tick(hour(instants, instants.size() - 1)),
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
                         const std::vector<DiurnalCurve>& curves, const std::string& background,
                         double utc_offset) {
    const auto reference = std::find_if(curves.begin(), curves.end(), [&](const DiurnalCurve& c) {
        return c.material == background;
    });
    // Of more days than one the date too: "07-06 05:12".
    const bool days = seconds_between(instants.front(), instants.back()) > 86400.0;
    const auto crossing = [&](const std::string& when) {
        return (days ? when.substr(5, 5) + " " : "") + when.substr(11, 5);
    };
    std::string out =
        "<table>\n<tr><th>material</th><th class=\"n\">facets</th><th class=\"n\">hectares</th>"
        "<th class=\"n\">coldest mean °C</th><th class=\"n\">warmest mean °C</th>"
        "<th class=\"n\">spread (10 to 90 %) at the warmest, K</th><th>crossover with " +
        escaped(background) + ", scene's clock</th></tr>\n";
    for (const DiurnalCurve& curve : curves) {
        const auto [low, high] = std::minmax_element(curve.mean.begin(), curve.mean.end());
        const auto warmest = static_cast<std::size_t>(high - curve.mean.begin());
        std::string crossed;
        if (reference != curves.end() && &*reference != &curve) {
            for (const Instant instant : crossovers(instants, curve, *reference)) {
                crossed +=
                    (crossed.empty() ? "" : ", ") + crossing(format_local(instant, utc_offset));
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
    return out + "</table>\n" + between_instants(instants);
}

}  // namespace diurna
