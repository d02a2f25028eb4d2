#include "scenes/charts/chart_layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace diurna {

namespace {

constexpr double bottom = 46.0, between_panels = 16.0, least_panel = 78.0;

Extent extent_of(const ChartLine& line) {
    Extent all{1e300, -1e300};
    for (const double y : line.y) {
        if (!std::isfinite(y)) continue;
        all = {std::min(all.low, y), std::max(all.high, y)};
    }
    return all;
}

Extent joined(const std::vector<Extent>& lines, const std::vector<std::size_t>& which) {
    Extent all{1e300, -1e300};
    for (const std::size_t i : which) {
        all = {std::min(all.low, lines[i].low), std::max(all.high, lines[i].high)};
    }
    return all;
}

double span_of(const std::vector<Extent>& lines, const std::vector<std::size_t>& which) {
    const Extent all = joined(lines, which);
    return which.empty() ? 0.0 : all.high - all.low;
}

/// The fewest lines at the end of an order, up to half of all, that lie apart from the others and
/// without which these fill their scale 1.5 times better; one that comes among them, where it is 3
/// times. 0: none.
std::size_t outliers(const std::vector<Extent>& lines, const std::vector<std::size_t>& order) {
    constexpr double better = 1.5, much_better = 3.0;
    const double whole = span_of(lines, order);
    for (std::size_t out = 1; 2 * out <= order.size(); ++out) {
        const auto cut = order.end() - std::ptrdiff_t(out);
        const std::vector<std::size_t> rest(order.begin(), cut), gone(cut, order.end());
        const Extent inner = joined(lines, rest), outer = joined(lines, gone);
        const bool apart = outer.low > inner.high || outer.high < inner.low;
        const double span = span_of(lines, rest);
        if (apart ? better * span <= whole : out == 1 && much_better * span <= whole) return out;
    }
    return 0;
}

}  // namespace

double round_step(double span, int count) {
    const double raw = span / count;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (raw <= factor * power) return factor * power;
    }
    return 10.0 * power;
}

std::vector<double> spread(const std::vector<double>& wanted, double gap, double lowest,
                           double highest) {
    std::vector<std::size_t> order(wanted.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return wanted[a] < wanted[b]; });
    // Less the gaps before them they need only not descend: pools of neighbours, each at its mean.
    struct Pool {
        double sum;
        std::size_t count;
        double mean() const { return sum / double(count); }
    };
    std::vector<Pool> pools;
    for (std::size_t i = 0; i < order.size(); ++i) {
        pools.push_back({wanted[order[i]] - gap * double(i), 1});
        while (pools.size() > 1 && pools[pools.size() - 2].mean() >= pools.back().mean()) {
            const Pool last = pools.back();
            pools.pop_back();
            pools.back().sum += last.sum;
            pools.back().count += last.count;
        }
    }
    const double last = highest - gap * (double(order.size()) - 1.0);
    std::vector<double> at(wanted.size());
    std::size_t i = 0;
    for (const Pool& pool : pools) {
        for (std::size_t k = 0; k < pool.count; ++k, ++i) {
            at[order[i]] = std::max(lowest, std::min(pool.mean(), last)) + gap * double(i);
        }
    }
    return at;
}

std::vector<std::vector<std::size_t>> scales_apart(const std::vector<Extent>& lines) {
    std::vector<std::size_t> main(lines.size());
    std::iota(main.begin(), main.end(), std::size_t{0});
    std::vector<std::vector<std::size_t>> scales;
    for (int more = 0; more < 2; ++more) {
        std::vector<std::size_t> up = main, down = main;
        std::stable_sort(up.begin(), up.end(),
                         [&](auto a, auto b) { return lines[a].high < lines[b].high; });
        std::stable_sort(down.begin(), down.end(),
                         [&](auto a, auto b) { return lines[a].low > lines[b].low; });
        const std::size_t above = outliers(lines, up), below = outliers(lines, down);
        if (above == 0 && below == 0) break;
        const bool from_above = above > 0 && (below == 0 || above <= below);
        std::vector<std::size_t>& order = from_above ? up : down;
        const auto cut = order.end() - std::ptrdiff_t(from_above ? above : below);
        scales.emplace_back(cut, order.end());
        main.assign(order.begin(), cut);
    }
    scales.push_back(std::move(main));
    for (std::vector<std::size_t>& scale : scales) std::sort(scale.begin(), scale.end());
    std::stable_sort(scales.begin(), scales.end(), [&](const auto& a, const auto& b) {
        return joined(lines, a).high > joined(lines, b).high;
    });
    return scales;
}

ChartLayout layout_of(const Chart& chart) {
    ChartLayout layout;
    if (chart.title.empty()) layout.top = 12.0;
    if (chart.narrow) layout.letters = 14;
    std::size_t longest = 0;
    for (const ChartLine& line : chart.lines) longest = std::max(longest, letters_of(line.name));
    for (const ChartRow& row : chart.rows) longest = std::max(longest, letters_of(row.name));
    layout.right = 28.0 + letter * double(std::min(longest, layout.letters));
    layout.width = chart.width - layout.left - layout.right;

    std::vector<Extent> extent;
    for (const ChartLine& line : chart.lines) extent.push_back(extent_of(line));
    std::vector<std::size_t> drawn;  // of a line without numbers there is none
    for (std::size_t i = 0; i < extent.size(); ++i) {
        if (extent[i].low <= extent[i].high) drawn.push_back(i);
    }
    std::vector<std::vector<std::size_t>> scales{drawn};
    if (chart.outliers_apart) {
        std::vector<Extent> some;
        for (const std::size_t i : drawn) some.push_back(extent[i]);
        scales = scales_apart(some);
        for (auto& scale : scales) {
            for (std::size_t& i : scale) i = drawn[i];
        }
    }
    std::size_t most = 0;
    for (const auto& scale : scales) most = std::max(most, scale.size());
    double at = layout.top;
    bool main_stands = false;
    for (auto& scale : scales) {
        Extent ends = joined(extent, scale);
        if (scale.empty()) ends = {0.0, 1.0};
        if (!(ends.low < ends.high)) ends.high = ends.low + 1.0;
        const double need = label_gap * double(scale.size() + 1);
        const bool is_main = !main_stands && scale.size() == most;
        main_stands = main_stands || is_main;
        const double height =
            std::max(need, is_main ? chart.height - layout.top - bottom : least_panel);
        const double step =
            round_step(ends.high - ends.low, std::max(2, static_cast<int>(height / 48.0)));
        layout.panel.push_back({.line = std::move(scale),
                                .low = step * std::floor(ends.low / step + 1e-9),
                                .high = step * std::ceil(ends.high / step - 1e-9),
                                .step = step,
                                .top = at,
                                .height = height});
        at += height + between_panels;
    }
    at -= between_panels;
    if (!chart.rows.empty()) {
        layout.rows_top = at + 26.0;
        layout.row_height = 30.0;
        at = layout.rows_top + layout.row_height * double(chart.rows.size());
    }
    layout.foot = at;
    layout.height = static_cast<int>(std::lround(at + bottom));
    return layout;
}

std::vector<std::pair<double, std::string>> ticks_of(const Chart& chart, double width) {
    std::vector<std::pair<double, std::string>> all = chart.ticks;
    if (all.empty()) {
        for (double t = chart.x_first; t <= chart.x_last + 1e-9; t += chart.x_tick) {
            all.emplace_back(t, fmt::format("{:g}", t));
        }
    }
    std::size_t longest = 0;
    for (const auto& [t, says] : all) longest = std::max(longest, letters_of(says));
    const double need = (letter * double(longest) + 8.0) * double(all.size());
    const auto every = static_cast<std::size_t>(std::max(1.0, std::ceil(need / (width + 30.0))));
    std::vector<std::pair<double, std::string>> some;
    for (std::size_t i = 0; i < all.size(); i += every) some.push_back(all[i]);
    return some;
}

ChartLine thinned(const ChartLine& line, const Chart& chart, double width) {
    const double span = chart.x_last - chart.x_first;
    if (double(line.x.size()) <= 4.0 * width || !(span > 0.0)) return line;
    ChartLine thin{
        .name = line.name, .colour = line.colour, .x = {}, .y = {}, .dashed = line.dashed};
    const auto column = [&](std::size_t k) {
        return std::floor(2.0 * width * (line.x[k] - chart.x_first) / span);
    };
    for (std::size_t from = 0; from < line.x.size();) {
        std::size_t to = from, least = from, most = from;
        for (; to < line.x.size() && column(to) == column(from); ++to) {
            if (line.y[to] < line.y[least]) least = to;
            if (line.y[to] > line.y[most]) most = to;
        }
        for (const std::size_t k : {std::min(least, most), std::max(least, most)}) {
            thin.x.push_back(line.x[k]);
            thin.y.push_back(line.y[k]);
            if (least == most) break;
        }
        from = to;
    }
    return thin;
}

std::vector<EventText> event_texts(const std::vector<double>& x, const std::vector<double>& width,
                                   double end) {
    std::vector<EventText> texts(x.size());
    double taken[2] = {-1e300, -1e300};
    for (std::size_t i = 0; i < x.size(); ++i) {
        texts[i].leftward = x[i] + width[i] > end;
        const double from = texts[i].leftward ? x[i] - width[i] : x[i];
        for (const int level : {0, 1}) {
            if (texts[i].level >= 0 || from < taken[level]) continue;
            texts[i].level = level;
        }
        if (texts[i].level < 0) {  // its tick is as high as both
            for (double& to : taken) to = std::max(to, x[i] + 3.0);
        } else {
            taken[texts[i].level] = texts[i].leftward ? x[i] + 3.0 : x[i] + width[i];
        }
    }
    return texts;
}

std::size_t letters_of(const std::string& name) {
    return static_cast<std::size_t>(
        std::count_if(name.begin(), name.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string shortened(const std::string& name, std::size_t letters) {
    if (letters_of(name) <= letters) return name;
    std::size_t at = 0, count = 0;
    while (at < name.size()) {
        if ((name[at] & 0xC0) != 0x80 && ++count == letters) break;
        ++at;
    }
    return name.substr(0, at) + "…";
}

}  // namespace diurna
