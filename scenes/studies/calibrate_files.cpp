#include "scenes/studies/calibrate_files.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

namespace diurna {

namespace {

using OrderedJson = nlohmann::ordered_json;

std::string numbers_csv(const CalibrationReport& report) {
    const auto& sought = report.asked.sought;
    std::string text = "key,low,high,start,value,deviation,least_95,most_95,at_bound";
    for (const SoughtNumber& one : sought)
        text += fmt::format(",{}", csv_cell("correlation " + one.key));
    text += '\n';
    for (std::size_t i = 0; i < sought.size(); ++i) {
        const FittedNumber& found = report.fit.number[i];
        text += fmt::format("{},{:.9g},{:.9g},{:.9g},{:.9g},{:.4g},{:.6g},{:.6g},{}",
                            csv_cell(sought[i].key), sought[i].low, sought[i].high, sought[i].start,
                            found.value, found.deviation, found.least, found.most, found.at_bound);
        for (const double r : report.fit.correlation[i]) text += fmt::format(",{:.4f}", r);
        text += '\n';
    }
    return text;
}

std::string numbers_json(const CalibrationReport& report) {
    const Fit& fit = report.fit;
    OrderedJson json{{"study", "calibrate"},           {"values", report.measured.size()},
                     {"rms_before_K", fit.rms_before}, {"rms_K", fit.rms},
                     {"converged", fit.converged},     {"columns_run", fit.runs},
                     {"residuals_alike", fit.alike},   {"values_that_count", fit.independent}};
    json["interval"] =
        "95 % interval by Student's t, widened where residuals are autocorrelated (Geyer 1992); "
        "deviation assumes independent errors";
    json["numbers"] = OrderedJson::array();
    for (std::size_t i = 0; i < report.asked.sought.size(); ++i) {
        const SoughtNumber& one = report.asked.sought[i];
        const FittedNumber& found = fit.number[i];
        json["numbers"].push_back({{"key", one.key},
                                   {"low", one.low},
                                   {"high", one.high},
                                   {"start", one.start},
                                   {"value", found.value},
                                   {"deviation", found.deviation},
                                   {"interval", {found.least, found.most}},
                                   {"at_bound", found.at_bound}});
    }
    json["correlation"] = fit.correlation;
    json["notes"] = report.notes;
    return json.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

std::string curves_svg(const CalibrationReport& report) {
    const Instant start = report.when.front();
    const double hours = seconds_between(start, report.when.back()) / 3600.0;
    Chart curves{.title = fmt::format(
                     "rms {:.2f} K with the initial values, {:.2f} K with the fitted values",
                     report.fit.rms_before, report.fit.rms),
                 .x_title = "hours after " + format_instant(start),
                 .y_title = "K",
                 .x_last = hours,
                 .x_tick = hours > 48.0 ? 12.0 : 3.0,
                 .lines = {}};
    Chart left = curves;
    left.title = "computed minus measured";
    left.height = 260;
    std::vector<double> x, residual;
    for (std::size_t i = 0; i < report.when.size(); ++i) {
        x.push_back(seconds_between(start, report.when[i]) / 3600.0);
        residual.push_back(report.fit.after[i] - report.measured[i]);
    }
    const auto line = [&](const char* name, const char* colour, const std::vector<double>& y,
                          bool dashed) {
        return ChartLine{.name = name, .colour = colour, .x = x, .y = y, .dashed = dashed};
    };
    curves.lines = {line("measured", "#333333", report.measured, false),
                    line("before", "#999999", report.fit.before, true),
                    line("found", "#b2182b", report.fit.after, false)};
    left.lines = {line("residual", "#2166ac", residual, false)};
    return stacked_svg({curves, left});
}

std::string curve_csv(const CalibrationReport& report) {
    std::string text = "time,measured_K,before_K,after_K\n";
    for (std::size_t i = 0; i < report.when.size(); ++i) {
        text += fmt::format("{},{:.4f},{:.4f},{:.4f}\n", format_instant(report.when[i]),
                            report.measured[i], report.fit.before[i], report.fit.after[i]);
    }
    return text;
}

}  // namespace

StudyTexts calibration_texts(const CalibrationReport& report) {
    return {.csv = numbers_csv(report),
            .json = numbers_json(report),
            .svg = curves_svg(report),
            .more = {{"_curve.csv", curve_csv(report)}}};
}

}  // namespace diurna
