#include "scenes/studies/detection_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "render/detection/resolvable.hpp"
#include "render/detection/task_metric.hpp"
#include "scenes/studies/study_files.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::array<const char*, 3> chance_colours{"#1b7837", "#2166ac", "#b2182b"};

OrderedJson ranges_of(const DetectionInput& input,
                      const std::array<std::vector<double>, 3>& range) {
    OrderedJson all = OrderedJson::object();
    for (std::size_t t = 0; t < 3; ++t) {
        OrderedJson of_task = OrderedJson::object();
        for (std::size_t p = 0; p < input.probabilities.size(); ++p) {
            of_task[fmt::format("{:g}", input.probabilities[p])] = range[t][p];
        }
        all[std::string(tasks[t].name)] = std::move(of_task);
    }
    return all;
}

/// Up to where any line of them is above a hundredth [km].
double shown_to(const DetectionCurve& curve) {
    double to = curve.range.front();
    for (std::size_t k = 0; k < curve.range.size(); ++k) {
        for (std::size_t t = 0; t < 3; ++t) {
            if (curve.johnson[t][k] > 0.01 || curve.metric[t][k] > 0.01) to = curve.range[k];
        }
    }
    return to / 1000.0;
}

double round_tick(double span) {
    double tick = 0.01;
    for (int i = 0; tick * 8.0 < span; ++i) tick *= i % 3 == 1 ? 2.5 : 2.0;
    return tick;
}

Chart chart_of(const DetectionInput& input, const DetectionCurve& curve, double utc_offset) {
    Chart chart{
        .title = fmt::format("{} at {}: {:.2f} K, {:.1f} m2; dashed: Johnson's criteria",
                             input.studied.object, format_local(curve.target.when, utc_offset),
                             curve.target.contrast, curve.target.area),
        .x_title = "range, km",
        .y_title = "probability",
        .x_first = 0.0,
        .x_last = shown_to(curve),
        .lines = {}};
    chart.x_tick = round_tick(chart.x_last);
    for (std::size_t t = 0; t < 3; ++t) {
        for (const bool johnson : {false, true}) {
            ChartLine line{.name = fmt::format("{}, {}", tasks[t].name, johnson ? "N50" : "TTP"),
                           .colour = chance_colours[t],
                           .x = {},
                           .y = {},
                           .dashed = johnson};
            const std::vector<double>& p = johnson ? curve.johnson[t] : curve.metric[t];
            for (std::size_t k = 0; k < p.size() && curve.range[k] <= 1001.0 * chart.x_last; ++k) {
                line.x.push_back(curve.range[k] / 1000.0);
                line.y.push_back(p[k]);
            }
            chart.lines.push_back(std::move(line));
        }
    }
    return chart;
}

/// Ranges of the first probability over the hours since the first instant.
Chart by_hour(const DetectionInput& input, const std::vector<DetectionCurve>& curves,
              double utc_offset) {
    Chart chart{.title = fmt::format("{}: range of probability {:g}; dashed: Johnson's criteria",
                                     input.studied.object, input.probabilities.front()),
                .x_title = "hours after " + format_local(curves.front().target.when, utc_offset),
                .y_title = "km",
                .lines = {}};
    for (std::size_t t = 0; t < 3; ++t) {
        for (const bool johnson : {false, true}) {
            ChartLine line{.name = fmt::format("{}, {}", tasks[t].name, johnson ? "N50" : "TTP"),
                           .colour = chance_colours[t],
                           .x = {},
                           .y = {},
                           .dashed = johnson};
            for (const DetectionCurve& curve : curves) {
                line.x.push_back(seconds_between(curves.front().target.when, curve.target.when) /
                                 3600.0);
                line.y.push_back(
                    (johnson ? curve.johnson_range[t] : curve.metric_range[t]).front() / 1000.0);
            }
            chart.lines.push_back(std::move(line));
        }
    }
    chart.x_last = chart.lines.front().x.back();
    chart.x_tick = round_tick(chart.x_last);
    return chart;
}

}  // namespace

std::string detection_csv(const std::vector<DetectionCurve>& curves, double utc_offset) {
    std::string text = "time,range_m,transmittance,contrast_K";
    for (const char* way : {"johnson", "ttp"}) {
        for (const Task& task : tasks) text += fmt::format(",{}_{}", way, task.name);
    }
    text += '\n';
    for (const DetectionCurve& curve : curves) {
        for (std::size_t k = 0; k < curve.range.size(); ++k) {
            text +=
                fmt::format("{},{:.1f},{:.5f},{:.5g}", format_local(curve.target.when, utc_offset),
                            curve.range[k], curve.transmittance[k], curve.contrast[k]);
            for (const auto* way : {&curve.johnson, &curve.metric}) {
                for (std::size_t t = 0; t < 3; ++t) text += fmt::format(",{:.5f}", (*way)[t][k]);
            }
            text += '\n';
        }
    }
    return text;
}

std::string detection_json(const DetectionInput& input, const std::string& instrument,
                           const std::vector<DetectionCurve>& curves,
                           const std::vector<std::string>& notes, double utc_offset) {
    OrderedJson json{{"study", "detection"},
                     {"name", input.name},
                     {"object", input.studied.object},
                     {"instrument", instrument}};
    json["johnson"] = {
        {"criterion", input.across ? "least width" : "root of the area"},
        {"n50", input.n50},
        {"exponent", "2.7 + 0.7 N/N50"},
        {"bar_threshold", bar_threshold},
        {"eye_s", eye_seconds},
        {"source",
         "values in common use under these names, not checked against the originals: Johnson 1958; "
         "Ratches and others, ECOM-7043, 1975; ACQUIRE, NVESD 1995"}};
    json["ttp"] = {
        {"v50", input.v50},
        {"exponent", "1.51 + 0.24 V/V50"},
        {"noise_sensitivity_root_Hz", noise_sensitivity},
        {"luminance_cd_m2", input.viewing.luminance},
        {"magnification", input.viewing.magnification},
        {"scene_contrast_K", input.viewing.scene_contrast},
        {"source",
         "values in common use, not checked against the originals: Vollmerhausen & Jacobs, "
         "AMSEL-NV-TR-230, 2004; eye: Barten, Proc. SPIE 1077, 1989, Overington 1976"}};
    json["notes"] = notes;
    json["instants"] = OrderedJson::array();
    for (const DetectionCurve& curve : curves) {
        const SeenTarget& seen = curve.target;
        json["instants"].push_back(
            {{"time", format_local(seen.when, utc_offset)},
             {"seen_from_m", seen.range},
             {"eye_elevation_deg", seen.elevation_deg},
             {"projected_area_m2", seen.area},
             {"least_width_m", seen.least_width},
             {"mean_difference_K", seen.difference},
             {"rss_contrast_K", seen.contrast},
             {"transmittance", seen.transmittance},
             {"rss_contrast_at_target_K", seen.contrast / seen.transmittance},
             {"johnson_range_m", ranges_of(input, curve.johnson_range)},
             {"ttp_range_m", ranges_of(input, curve.metric_range)}});
    }
    return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string detection_svg(const DetectionInput& input, const std::vector<DetectionCurve>& curves,
                          double utc_offset) {
    std::vector<Chart> charts;
    for (const DetectionCurve& curve : curves) {
        charts.push_back(chart_of(input, curve, utc_offset));
    }
    if (curves.size() > 1 && !input.probabilities.empty()) {
        charts.push_back(by_hour(input, curves, utc_offset));
    }
    return stacked_svg(charts);
}

}  // namespace diurna
