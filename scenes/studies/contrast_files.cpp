#include "scenes/studies/contrast_files.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "scenes/studies/study_files.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::array<const char*, 8> contrast_colours{"#2166ac", "#b2182b", "#1b7837", "#762a83",
                                                      "#e08214", "#01665e", "#8c510a", "#555555"};

struct Column {
    const char* name;
    double ContrastRow::*value;
    const char* says;
};
constexpr std::array<Column, 14> contrast_columns{
    {{"range_m", &ContrastRow::range,
      "distance to the nearest surface of the target in a pixel that it fills"},
     {"pixels", &ContrastRow::pixels,
      "sum over the picture of the share of each pixel that the target covers"},
     {"difference_K", &ContrastRow::difference,
      "sum of (apparent temperature of the pixel minus the background's mean) over all pixels that "
      "the target covers at least in part, divided by pixels"},
     {"spread_K", &ContrastRow::spread,
      "standard deviation of apparent temperature over pixels that the target fills (share of "
      "0.999 or more)"},
     {"rss_K", &ContrastRow::rss, "root of the sum of difference squared and spread squared"},
     {"clutter_K", &ContrastRow::clutter,
      "root mean square of the standard deviations in square cells of twice the larger side of "
      "the target's box, over the whole picture without cells that contain the target (Schmieder "
      "and Weathersby 1983)"},
     {"signal_to_clutter", &ContrastRow::signal_to_clutter,
      "absolute difference divided by clutter"},
     {"edge_K_per_pixel", &ContrastRow::edge, "mean gradient along the target's border (Sobel)"},
     {"background_edge_K_per_pixel", &ContrastRow::background_edge,
      "mean gradient in the background"},
     {"similarity", &ContrastRow::similarity,
      "root mean square structural similarity (Wang and others 2004) of cells of the target's "
      "size, after Chang and Zhang 2006"},
     {"entropy_bits", &ContrastRow::entropy,
      "entropy of the pixels that the target fills, in steps of 0.1 K"},
     {"background_entropy_bits", &ContrastRow::background_entropy,
      "entropy of the background's pixels"},
     {"radiance_W_m2_sr", &ContrastRow::radiance,
      "as difference_K, of radiance in place of apparent temperature"},
     {"weber", &ContrastRow::weber,
      "radiance difference divided by the background's mean radiance"}}};

const std::string& observer_name(const ContrastInput& input, const Scene& scene,
                                 const ContrastRow& row) {
    return scene.observers[input.observers[row.observer]].name;
}

OrderedJson finite(double value) {
    return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr);
}

/// Of the row's undefined values: names and reasons.
OrderedJson why_undefined(const ContrastRow& row, const ObserverInput& observer) {
    OrderedJson why = OrderedJson::object();
    if (const std::string reason = why_no_clutter(row, observer); !reason.empty()) {
        why["clutter_K"] = reason;
        why["signal_to_clutter"] = reason;
    } else if (!std::isfinite(row.signal_to_clutter)) {
        why["signal_to_clutter"] = "the clutter is 0";
    }
    if (!std::isfinite(row.similarity)) {
        why["similarity"] =
            "no cell of the size of the target's box lies in the picture without the target";
    }
    if (!std::isfinite(row.range)) why["range_m"] = "the target fills no pixel";
    return why;
}

}  // namespace

std::string why_no_clutter(const ContrastRow& row, const ObserverInput& observer) {
    if (std::isfinite(row.clutter)) return "";
    return fmt::format(
        "no cell of {0} x {0} pixels, twice the target's size, lies in the picture of {1} x {2} "
        "pixels without the target; to have one, enlarge width, height and horizontal_fov_deg of "
        "\"{3}\" together",
        row.clutter_side, observer.width, observer.height, observer.name);
}

std::string contrast_csv(const ContrastInput& input, const ContrastReport& report,
                         const Scene& scene) {
    std::string text = "target,observer,time,band_um";
    for (const Column& column : contrast_columns) {
        text += fmt::format(",{}", column.name);
    }
    text += '\n';
    for (const ContrastRow& row : report.row) {
        text += fmt::format("{},{},{},{}", csv_cell(input.targets[row.target].name),
                            csv_cell(observer_name(input, scene, row)),
                            format_local(row.when, scene.time.utc_offset), row.band);
        for (const Column& column : contrast_columns) {
            const double value = row.*column.value;
            text += std::isfinite(value) ? fmt::format(",{:.5g}", value) : ",";
        }
        text += '\n';
    }
    return text;
}

std::string contrast_json(const ContrastInput& input, const ContrastReport& report,
                          const Scene& scene, const std::vector<std::string>& notes) {
    OrderedJson json{{"study", "contrast"},
                     {"name", input.name},
                     {"threshold_K", input.threshold},
                     {"ring", input.ring}};
    json["background"] =
        "pixels of the target's box, extended on each side by ring times its width (height), "
        "without pixels of the study's targets; sky and other objects are included";
    json["columns"] = OrderedJson::object();
    for (const Column& column : contrast_columns) {
        json["columns"][column.name] = column.says;
    }
    json["sampling_change_K"] =
        "change of rss_K if the picture has half the samples: the error of random samples alone, "
        "not that of the contrast";
    json["targets"] = OrderedJson::array();
    for (const ContrastSummary& summary : report.summary) {
        const ObserverInput& observer = scene.observers[input.observers[summary.observer]];
        OrderedJson one{{"target", input.targets[summary.target].name},
                        {"band_um", input.bands[summary.band]},
                        {"observer", observer.name}};
        one["share_of_pictures_above_threshold"] = finite(summary.share);
        if (summary.highest < report.row.size()) {
            const ContrastRow& row = report.row[summary.highest];
            OrderedJson at{{"time", format_local(row.when, scene.time.utc_offset)},
                           {"sampling_change_K", summary.sampling_change}};
            for (const Column& column : contrast_columns) {
                at[column.name] = finite(row.*column.value);
            }
            if (OrderedJson why = why_undefined(row, observer); !why.empty()) {
                at["why"] = std::move(why);
            }
            one["highest"] = std::move(at);
            const ContrastRow& lowest = report.row[summary.lowest];
            one["lowest"] = {{"time", format_local(lowest.when, scene.time.utc_offset)},
                             {"rss_K", lowest.rss}};
            one["rss_K_at_range_m"] = OrderedJson::object();
            for (std::size_t k = 0; k < summary.at_range.size(); ++k) {
                one["rss_K_at_range_m"][fmt::format("{:g}", input.ranges[k])] =
                    finite(summary.at_range[k]);
            }
        }
        json["targets"].push_back(std::move(one));
    }
    json["notes"] = notes;
    return json.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

std::string contrast_svg(const ContrastInput& input, const ContrastReport& report,
                         const Scene& scene) {
    std::vector<Chart> charts;
    for (const std::string& band : input.bands) {
        for (std::size_t o = 0; o < input.observers.size(); ++o) {
            Chart chart{
                .title =
                    fmt::format("{} um, from {}", band, scene.observers[input.observers[o]].name),
                .x_title = "hours after " + format_local(scene.time.start, scene.time.utc_offset),
                .y_title = "RSS contrast, K",
                .x_last = scene.time.duration / 3600.0,
                .x_tick = scene.time.duration > 172800.0 ? 12.0 : 3.0,
                .lines = {}};
            for (std::size_t t = 0; t < input.targets.size(); ++t) {
                ChartLine line{.name = input.targets[t].name,
                               .colour = contrast_colours[t % contrast_colours.size()],
                               .x = {},
                               .y = {},
                               .dashed = t >= contrast_colours.size()};
                for (const ContrastRow& row : report.row) {
                    if (row.target != t || row.observer != o || row.band != band) continue;
                    if (std::isnan(row.rss)) continue;
                    line.x.push_back(seconds_between(scene.time.start, row.when) / 3600.0);
                    line.y.push_back(row.rss);
                }
                if (!line.x.empty()) chart.lines.push_back(std::move(line));
            }
            if (chart.lines.empty()) continue;
            chart.lines.push_back({.name = "threshold",
                                   .colour = "#999999",
                                   .x = {0.0, chart.x_last},
                                   .y = {input.threshold, input.threshold},
                                   .dashed = true});
            charts.push_back(std::move(chart));
        }
    }
    return stacked_svg(charts);
}

}  // namespace diurna
