#include "scenes/studies/crossover_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "scenes/charts/clock_names.hpp"
#include "scenes/studies/band_words.hpp"
#include "scenes/studies/study_files.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

using OrderedJson = nlohmann::ordered_json;

const std::string& warmer_after(const CrossoverInput& input, const TimedCrossing& crossing) {
    return crossing.first_warmer_after ? input.first.name : input.second.name;
}

/// [K/h]; of what jumps or touches there is none.
std::optional<double> hourly(const TimedCrossing& crossing) {
    if (crossing.kind != ZeroCrossing::Kind::crosses) return std::nullopt;
    return 3600.0 * crossing.slope;
}

/// [s]; none where no number was varied.
std::optional<double> sigma_of(const TimedCrossing& crossing) {
    if (crossing.shift.empty()) return std::nullopt;
    return crossing.sigma;
}

std::string cell(const std::optional<double>& value, const char* format = "{:.1f}") {
    return value ? fmt::format(fmt::runtime(format), *value) : "";
}

OrderedJson or_null(const std::optional<double>& value) {
    return value ? OrderedJson(*value) : OrderedJson(nullptr);
}

/// Of a band without a crossing; null where one is.
OrderedJson warmer_throughout(const CrossoverInput& input, const CrossoverDay& day) {
    const bool crosses = std::any_of(day.crossing.begin(), day.crossing.end(), [](const auto& one) {
        return one.kind != ZeroCrossing::Kind::touches;
    });
    if (crosses) return nullptr;
    return day.nearest > 0.0 ? input.first.name : input.second.name;
}

}  // namespace

const char* word_of(ZeroCrossing::Kind kind) {
    switch (kind) {
        case ZeroCrossing::Kind::crosses:
            return "crosses";
        case ZeroCrossing::Kind::jumps:
            return "jumps";
        case ZeroCrossing::Kind::touches:
            break;
    }
    return "touches";
}

std::vector<std::string> gone_with(const CrossoverInput& input, const TimedCrossing& crossing) {
    std::vector<std::string> keys;
    if (crossing.kind == ZeroCrossing::Kind::touches) return keys;
    for (std::size_t u = 0; u < crossing.shift.size(); ++u) {
        if (!crossing.shift[u]) keys.push_back(input.uncertain[u].key);
    }
    return keys;
}

std::string crossover_csv(const CrossoverInput& input, const CrossoverReport& report,
                          double utc_offset) {
    std::string text = "band_um,time,kind,warmer_after,slope_K_per_h,least_K,sigma_s,refined_s";
    for (const UncertainInput& one : input.uncertain) {
        text += fmt::format(",{}", csv_cell("shift_s " + one.key));
    }
    text += '\n';
    for (const CrossoverDay& day : report.band) {
        for (const TimedCrossing& one : day.crossing) {
            text += fmt::format("{},{},{},{},{},{:.4g},{},{}", day.band,
                                format_local(one.when, utc_offset), word_of(one.kind),
                                csv_cell(warmer_after(input, one)), cell(hourly(one), "{:.4g}"),
                                one.least, cell(sigma_of(one)), cell(one.refined));
            for (const auto& shift : one.shift) text += fmt::format(",{}", cell(shift));
            text += '\n';
        }
    }
    return text;
}

std::string contrast_curves_csv(const CrossoverReport& report, double utc_offset) {
    std::string text = "band_um,time,first_K,second_K,difference_K\n";
    for (const CrossoverDay& day : report.band) {
        for (std::size_t i = 0; i < day.instant.size(); ++i) {
            text += fmt::format("{},{},{:.4f},{:.4f},{:.4f}\n", day.band,
                                format_local(day.instant[i], utc_offset), day.first[i],
                                day.second[i], day.first[i] - day.second[i]);
        }
    }
    return text;
}

std::string crossover_json(const CrossoverInput& input, const std::string& observer,
                           const CrossoverReport& report, const std::vector<std::string>& notes,
                           double utc_offset) {
    OrderedJson json{{"study", "crossover"},
                     {"name", input.name},
                     {"first", input.first.name},
                     {"second", input.second.name},
                     {"observer", observer},
                     {"first_pixels", report.first_pixels},
                     {"second_pixels", report.second_pixels},
                     {"threshold_K", input.threshold},
                     {"touching_K", input.touching}};
    json["difference"] =
        "apparent temperature of the first region minus that of the second: the black-body "
        "temperature of the mean radiance over the pixels that the region alone fills, atmosphere "
        "included";
    json["nearest"] =
        "nearest_difference_K: the difference of the smallest magnitude, at nearest_time; "
        "warmer_throughout: the warmer region of a band without a crossing, else null";
    json["times"] = fmt::format("clock of the scene, {}", clock_zone(utc_offset));
    json["sigma"] =
        "sigma_s: one standard deviation (68 %) of the time, the root sum square of the shifts; "
        "shift_s: the change of the time with one number at its one_sigma, a standard deviation "
        "(68 %) from its value in the scene; null without uncertain numbers";
    json["bands"] = OrderedJson::array();
    for (const CrossoverDay& day : report.band) {
        OrderedJson crossings = OrderedJson::array();
        for (const TimedCrossing& one : day.crossing) {
            OrderedJson shifts = OrderedJson::object();
            for (std::size_t u = 0; u < one.shift.size(); ++u) {
                shifts[input.uncertain[u].key] = or_null(one.shift[u]);
            }
            crossings.push_back({{"time", format_local(one.when, utc_offset)},
                                 {"kind", word_of(one.kind)},
                                 {"warmer_after", warmer_after(input, one)},
                                 {"slope_K_per_h", or_null(hourly(one))},
                                 {"least_K", one.least},
                                 {"sigma_s", or_null(sigma_of(one))},
                                 {"refined_shift_s", or_null(one.refined)},
                                 {"shift_s", shifts},
                                 {"gone_with", gone_with(input, one)}});
        }
        json["bands"].push_back(
            {{"band_um", day.band},
             {"hours", seconds_between(day.instant.front(), day.instant.back()) / 3600.0},
             {"hours_below_threshold", day.lost / 3600.0},
             {"least_contrast_K", day.worst_least},
             {"nearest_difference_K", day.nearest},
             {"nearest_time", format_local(day.nearest_at, utc_offset)},
             {"warmer_throughout", warmer_throughout(input, day)},
             {"crossings", crossings}});
    }
    json["uncertain"] = OrderedJson::array();
    for (const UncertainInput& one : input.uncertain) {
        json["uncertain"].push_back({{"key", one.key}, {"one_sigma", one.one_sigma}});
    }
    json["notes"] = notes;
    return json.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

std::string crossover_svg(const CrossoverInput& input, const CrossoverReport& report,
                          double utc_offset) {
    std::vector<Chart> charts;
    for (const CrossoverDay& day : report.band) {
        const Instant start = day.instant.front();
        const auto hours = [&](Instant when) { return seconds_between(start, when) / 3600.0; };
        Chart chart{.title = fmt::format("{} minus {}, {}", input.first.name, input.second.name,
                                         band_words(day.band)),
                    .x_title = "hours after " + format_local(start, utc_offset),
                    .y_title = "K",
                    .x_last = hours(day.instant.back()),
                    .x_tick = hours(day.instant.back()) > 48.0 ? 12.0 : 3.0,
                    .lines = {}};
        ChartLine line{.name = "difference", .colour = "#2166ac", .x = {}, .y = {}};
        for (std::size_t i = 0; i < day.instant.size(); ++i) {
            line.x.push_back(hours(day.instant[i]));
            line.y.push_back(day.first[i] - day.second[i]);
        }
        const double low = std::min(*std::min_element(line.y.begin(), line.y.end()), 0.0);
        const double high = std::max(*std::max_element(line.y.begin(), line.y.end()), 0.0);
        chart.lines.push_back(std::move(line));
        for (const double edge : {-input.threshold, input.threshold}) {
            if (edge < low || edge > high) continue;
            chart.lines.push_back({.name = fmt::format("{:+g} K", edge),
                                   .colour = "#999999",
                                   .x = {0.0, chart.x_last},
                                   .y = {edge, edge},
                                   .dashed = true});
        }
        ChartRow row{
            .name = "crossings, " + clock_zone(utc_offset), .colour = "#2166ac", .event = {}};
        for (const TimedCrossing& one : day.crossing) {
            const std::string when = format_local(one.when, utc_offset).substr(0, 16);
            row.event.emplace_back(hours(one.when), when.substr(11));
            chart.marks.push_back({.line = 0, .x = hours(one.when), .y = one.least, .says = when});
        }
        if (!row.event.empty()) chart.rows.push_back(std::move(row));
        charts.push_back(std::move(chart));
    }
    return stacked_svg(charts);
}

}  // namespace diurna
