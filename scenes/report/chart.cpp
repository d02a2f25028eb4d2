#include "scenes/report/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "scenes/report/html.hpp"

namespace diurna {

namespace {

constexpr double left = 62.0, right = 150.0, top = 34.0, bottom = 46.0;  // margins [px]

/// The step among 1, 2, 5 times a power of ten that divides `span` into about `count` parts.
double round_step(double span, int count) {
    const double raw = span / count;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (raw <= factor * power) return factor * power;
    }
    return 10.0 * power;
}

/// Pushes labels apart so that none lies nearer to the next than `gap`, keeping their order.
std::vector<double> spread(std::vector<double> at, double gap, double lowest, double highest) {
    std::vector<std::size_t> order(at.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](auto a, auto b) { return at[a] < at[b]; });
    for (std::size_t i = 0; i < order.size(); ++i) {
        const double floor = i == 0 ? lowest : at[order[i - 1]] + gap;
        at[order[i]] = std::max(at[order[i]], floor);
    }
    for (std::size_t i = order.size(); i-- > 0;) {
        const double ceiling = i + 1 == order.size() ? highest : at[order[i + 1]] - gap;
        at[order[i]] = std::min(at[order[i]], ceiling);
    }
    return at;
}

}  // namespace

std::string svg(const Chart& chart) {
    double lowest = 1e300, highest = -1e300;
    for (const ChartLine& line : chart.lines) {
        for (const double y : line.y) {
            lowest = std::min(lowest, y);
            highest = std::max(highest, y);
        }
    }
    if (!(lowest < highest)) highest = lowest + 1.0;
    const double step = round_step(highest - lowest, 7);
    lowest = step * std::floor(lowest / step);
    highest = step * std::ceil(highest / step);

    const double w = chart.width - left - right, h = chart.height - top - bottom;
    const auto px = [&](double x) {
        return left + w * (x - chart.x_first) / (chart.x_last - chart.x_first);
    };
    const auto py = [&](double y) { return top + h * (1.0 - (y - lowest) / (highest - lowest)); };

    std::string out = fmt::format(
        "<svg viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" "
        "xmlns=\"http://www.w3.org/2000/svg\">\n<text x=\"{2}\" y=\"20\" class=\"t\">{3}</text>\n",
        chart.width, chart.height, left, escaped(chart.title));
    for (double y = lowest; y <= highest + 1e-9 * step; y += step) {
        out += fmt::format(
            "<path class=\"g\" d=\"M{:.1f} {:.1f}h{:.1f}\"/><text class=\"e\" x=\"{:.1f}\" "
            "y=\"{:.1f}\">{:g}</text>\n",
            left, py(y), w, left - 6, py(y) + 4, y);
    }
    for (double x = chart.x_first; x <= chart.x_last + 1e-9; x += chart.x_tick) {
        out += fmt::format(
            "<path class=\"g\" d=\"M{0:.1f} {1:.1f}v{2:.1f}\"/><text class=\"m\" x=\"{0:.1f}\" "
            "y=\"{3:.1f}\">{4:g}</text>\n",
            px(x), top, h, top + h + 17, x);
    }
    out += fmt::format("<text class=\"m\" x=\"{:.1f}\" y=\"{}\">{}</text>\n", left + w / 2,
                       chart.height - 8, escaped(chart.x_title));
    out +=
        fmt::format("<text class=\"m\" transform=\"translate(16 {:.1f}) rotate(-90)\">{}</text>\n",
                    top + h / 2, escaped(chart.y_title));

    std::vector<double> label;
    for (const ChartLine& line : chart.lines) label.push_back(py(line.y.back()) + 4);
    label = spread(label, 15.0, top + 4, top + h + 4);
    for (std::size_t i = 0; i < chart.lines.size(); ++i) {
        const ChartLine& line = chart.lines[i];
        out += fmt::format("<path fill=\"none\" stroke=\"{}\" stroke-width=\"2\"{} d=\"",
                           line.colour, line.dashed ? " stroke-dasharray=\"5 4\"" : "");
        for (std::size_t k = 0; k < line.x.size(); ++k) {
            out += fmt::format("{}{:.1f} {:.1f}", k == 0 ? 'M' : 'L', px(line.x[k]), py(line.y[k]));
        }
        out += fmt::format("\"/>\n<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\">{}</text>\n",
                           left + w + 8, label[i], line.colour, escaped(line.name));
    }
    return out + "</svg>\n";
}

}  // namespace diurna
