#include "scenes/studies/sensitivity_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "scenes/charts/html.hpp"
#include "scenes/studies/study_files.hpp"

namespace diurna {

namespace {

using OrderedJson = nlohmann::ordered_json;

std::string field(double value) { return std::isfinite(value) ? fmt::format("{:.6g}", value) : ""; }

OrderedJson number_or_null(double value) {
    return std::isfinite(value) ? OrderedJson(value) : OrderedJson(nullptr);
}

const char* word_of(SensitivityOutput::Figure figure) {
    switch (figure) {
        case SensitivityOutput::Figure::temperature:
            return "temperature";
        case SensitivityOutput::Figure::contrast:
            return "contrast";
        case SensitivityOutput::Figure::crossover:
            break;
    }
    return "crossover";
}

OrderedJson effect_json(const ElementaryEffect& effect) {
    return {{"mean", number_or_null(effect.mean)},
            {"mean_size", number_or_null(effect.mean_size)},
            {"size_error", number_or_null(effect.size_error)},
            {"morris_sigma", number_or_null(effect.deviation)},
            {"count", effect.count}};
}

// Bars [px].
constexpr double left = 300.0, longest = 420.0, row = 40.0, head = 34.0;

std::string bar(double top, double end, const char* colour) {
    return fmt::format(
        "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"13\" fill=\"{}\"/>\n", left, top,
        end, colour);
}

std::string sensitivity_words(double x, double y, double value) {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">{:.3g}</text>\n", x, y, value);
}

}  // namespace

const char* unit_of(const SensitivityOutput& output) {
    return output.figure == SensitivityOutput::Figure::crossover ? "h" : "K";
}

std::string sensitivity_csv(const SensitivityInput& input, const SensitivityReport& report) {
    const bool morris = input.trajectories > 0;
    std::string text = "output,unit,key,low,high,at_base,plus_minus,at_low,at_high,slope";
    if (morris) text += ",mean_effect,mean_size,size_error,morris_sigma,effects";
    text += '\n';
    for (std::size_t o = 0; o < input.outputs.size(); ++o) {
        const OutputSensitivity& one = report.output[o];
        for (std::size_t u = 0; u < input.uncertain.size(); ++u) {
            const OneAtATime& alone = one.alone[u];
            text += fmt::format("{},{},{},{:.9g},{:.9g},{},{},{},{},{}",
                                csv_cell(input.outputs[o].name), unit_of(input.outputs[o]),
                                csv_cell(input.uncertain[u].key), input.uncertain[u].low,
                                input.uncertain[u].high, field(one.base), field(one.deviation),
                                field(alone.low), field(alone.high), field(alone.slope));
            if (morris) {
                const ElementaryEffect effect =
                    one.effect.empty() ? ElementaryEffect{} : one.effect[u];
                text +=
                    fmt::format(",{},{},{},{},{}", field(effect.mean), field(effect.mean_size),
                                field(effect.size_error), field(effect.deviation), effect.count);
            }
            text += '\n';
        }
    }
    return text;
}

std::string sensitivity_json(const SensitivityInput& input, const SensitivityReport& report,
                             const std::vector<std::string>& notes) {
    OrderedJson json{{"study", "sensitivity"},
                     {"name", input.name},
                     {"scenes", report.scenes},
                     {"scenes_solved", report.solved},
                     {"trajectories", input.trajectories},
                     {"levels", input.levels}};
    if (const CombinedScenes& combined = report.combined; !combined.settings.empty()) {
        json["combined"] = {{"scenes", combined.scenes},      {"solved_at", combined.settings},
                            {"rms_K", combined.rms},          {"worst_K", combined.worst},
                            {"tolerance_K", input.tolerance}, {"outputs", OrderedJson::array()}};
        for (const double error : combined.output) {
            json["combined"]["outputs"].push_back(number_or_null(error));
        }
    }
    json["elementary_effects"] =
        "change over the whole range of a value (Morris 1991): mean is mu, mean_size mu*, "
        "morris_sigma sigma";
    json["plus_minus"] =
        "one standard deviation of the output, first order, for independent values with uniform "
        "distributions over their ranges";
    json["outputs"] = OrderedJson::array();
    for (std::size_t o = 0; o < input.outputs.size(); ++o) {
        const SensitivityOutput& output = input.outputs[o];
        const OutputSensitivity& one = report.output[o];
        OrderedJson numbers = OrderedJson::array();
        for (std::size_t u = 0; u < input.uncertain.size(); ++u) {
            const OneAtATime& alone = one.alone[u];
            OrderedJson number{
                {"key", input.uncertain[u].key},         {"low", input.uncertain[u].low},
                {"high", input.uncertain[u].high},       {"at_low", number_or_null(alone.low)},
                {"at_high", number_or_null(alone.high)}, {"slope", number_or_null(alone.slope)}};
            if (!one.effect.empty()) number["effect"] = effect_json(one.effect[u]);
            numbers.push_back(std::move(number));
        }
        json["outputs"].push_back({{"name", output.name},
                                   {"figure", word_of(output.figure)},
                                   {"unit", unit_of(output)},
                                   {"base", number_or_null(one.base)},
                                   {"plus_minus", number_or_null(one.deviation)},
                                   {"uncertain", std::move(numbers)}});
    }
    json["notes"] = notes;
    return json.dump(1, ' ', false, OrderedJson::error_handler_t::replace) + "\n";
}

std::string sensitivity_svg(const SensitivityInput& input, const SensitivityReport& report) {
    const double block = head + row * double(input.uncertain.size()) + 16.0;
    std::string text = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 860 {0:.0f}\" width=\"860\" "
        "height=\"{0:.0f}\">\n<style>text{{font:12px sans-serif}}.t{{font-size:15px}}"
        ".e{{text-anchor:end}}</style>\n<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        block * double(input.outputs.size()));
    for (std::size_t o = 0; o < input.outputs.size(); ++o) {
        const OutputSensitivity& one = report.output[o];
        double most = 0.0;
        for (std::size_t u = 0; u < input.uncertain.size(); ++u) {
            std::vector<double> ends{std::abs(one.alone[u].high - one.alone[u].low)};
            if (!one.effect.empty()) {
                ends.push_back(one.effect[u].mean_size);
                ends.push_back(one.effect[u].mean_size + 2.0 * one.effect[u].size_error);
            }
            for (const double end : ends) {
                if (std::isfinite(end)) most = std::max(most, end);
            }
        }
        double y = block * double(o) + 22.0;
        const bool known = std::isfinite(one.base);
        text += fmt::format(
            "<text class=\"t\" x=\"10\" y=\"{:.0f}\">{}: {} {}; change over each range, one at a "
            "time{}</text>\n",
            y, escaped(input.outputs[o].name), known ? fmt::format("{:.5g}", one.base) : "none",
            known ? unit_of(input.outputs[o]) : "",
            one.effect.empty() ? "" : " (dark) and mu* (light)");
        y += head - 22.0;
        for (std::size_t u = 0; u < input.uncertain.size(); ++u, y += row) {
            text += fmt::format("<text class=\"e\" x=\"{:.0f}\" y=\"{:.1f}\">{}</text>\n",
                                left - 10.0, y + 19.0, escaped(input.uncertain[u].key));
            const auto length = [&](double value) { return longest * value / most; };
            const double alone = std::abs(one.alone[u].high - one.alone[u].low);
            if (most > 0.0 && std::isfinite(alone)) {
                text += bar(y, length(alone), "#2166ac");
                text += sensitivity_words(left + length(alone) + 6.0, y + 11.0, alone);
            }
            if (one.effect.empty() || !(most > 0.0) || !std::isfinite(one.effect[u].mean_size)) {
                continue;
            }
            const double size = one.effect[u].mean_size;
            const double error =
                std::isfinite(one.effect[u].size_error) ? 2.0 * one.effect[u].size_error : 0.0;
            text += bar(y + 15.0, length(size), "#92c5de");
            text += fmt::format(
                "<path d=\"M{:.1f} {:.1f}H{:.1f}\" stroke=\"#053061\" stroke-width=\"2\"/>\n",
                left + length(std::max(0.0, size - error)), y + 21.5, left + length(size + error));
            text += sensitivity_words(left + length(size + error) + 6.0, y + 26.0, size);
        }
    }
    return text + "</svg>\n";
}

}  // namespace diurna
