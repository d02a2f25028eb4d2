#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/atmosphere/stored_path.hpp"
#include "materials/base/error.hpp"

namespace diurna {

namespace {

/// Nodes of one axis, ascending, and what is stored at each.
struct Line {
    std::vector<double> place;
    std::vector<Stored> path;
};

/// Lagrange weights of up to four neighbouring nodes, wherever they lie.
struct Weights {
    std::size_t first = 0, count = 0;
    std::array<double, 4> weight{};
};
Weights weights(const std::vector<double>& node, double x) {
    x = std::clamp(x, node.front(), node.back());
    Weights w;
    w.count = std::min<std::size_t>(node.size(), 4);
    const auto above = std::upper_bound(node.begin(), node.end(), x) - node.begin();
    const auto last = static_cast<std::ptrdiff_t>(node.size() - w.count);
    w.first = static_cast<std::size_t>(std::clamp<std::ptrdiff_t>(above - 2, 0, last));
    for (std::size_t j = 0; j < w.count; ++j) {
        w.weight[j] = 1.0;
        for (std::size_t k = 0; k < w.count; ++k) {
            const double at = node[w.first + k];
            if (k != j) w.weight[j] *= (x - at) / (node[w.first + j] - at);
        }
    }
    return w;
}

void add(const Line& line, double x, double weight, double depth_scale, Stored& sum) {
    const Weights w = weights(line.place, x);
    for (std::size_t i = 0; i < w.count; ++i) {
        const Stored& s = line.path[w.first + i];
        const double both = weight * w.weight[i];
        for (std::size_t b = 0; b < sum.depth.size(); ++b) {
            sum.depth[b] += both * depth_scale * s.depth[b];
            sum.temperature[b] += both * s.temperature[b];
        }
    }
}

/// Heights that differ by less are one [km]; a tape7 prints five decimals.
constexpr double same_km = 2e-5;

std::vector<double> distinct(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const auto same = [](double a, double b) { return b - a < same_km; };
    values.erase(std::unique(values.begin(), values.end(), same), values.end());
    return values;
}

std::size_t place_of(const std::vector<double>& values, double value) {
    const auto at = std::lower_bound(values.begin(), values.end(), value - same_km);
    return static_cast<std::size_t>(at - values.begin());
}

/// Bins whose both ends the rows reach to a third of the bin.
BinRange covered(const std::vector<double>& per_cm, const std::string& file) {
    const std::span<const double> edges = bin_edges_um();
    BinRange bins{.first = edges.size(), .last = 0};
    for (std::size_t b = 0; b + 1 < edges.size(); ++b) {
        const double low = 1e4 / edges[b + 1], high = 1e4 / edges[b], slack = (high - low) / 3.0;
        if (per_cm.front() > low + slack || per_cm.back() < high - slack) continue;
        bins.first = std::min(bins.first, b);
        bins.last = b + 1;
    }
    if (bins.first >= bins.last) {
        throw InputError(file, fmt::format("{:g} to {:g} cm-1 hold no bin of 0.35 to 20 um",
                                           per_cm.front(), per_cm.back()));
    }
    return bins;
}

/// Sorts a line's nodes; two at one place are refused.
void sort_line(Line& line, const std::string& where) {
    std::vector<std::size_t> order(line.place.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return line.place[a] < line.place[b]; });
    Line sorted;
    for (const std::size_t i : order) {
        if (!sorted.place.empty() && line.place[i] - sorted.place.back() < 1e-6) {
            throw InputError(where, "found the same path twice");
        }
        sorted.place.push_back(line.place[i]);
        sorted.path.push_back(std::move(line.path[i]));
    }
    line = std::move(sorted);
}

}  // namespace

struct FileGrid {
    BinRange bins;
    std::vector<double> from, to, sky_from;  // [km]
    std::vector<Line> path;                  // (from, to), of the cube root of range
    std::vector<Line> sky;                   // (sky_from), of variable_of(zenith)
    TableSpan span;
};

Tabulated read_path_table(const std::filesystem::path& file) {
    const std::vector<Tape7Run> runs = read_tape7(file);
    const std::string name = file.string();
    auto grid = std::make_shared<FileGrid>();
    std::vector<double> from, to, sky_from;
    for (const Tape7Run& run : runs) {
        if (run.lowtran || (run.emission != 1 && run.emission != 2)) {
            throw InputError(name, fmt::format("found a {} run of IEMSCT {}, expected MODTRAN's "
                                               "thermal radiance, IEMSCT 1 or 2",
                                               run.lowtran ? "LOWTRAN7" : "MODTRAN", run.emission));
        }
        if (run.table.axis != runs[0].table.axis) {
            throw InputError(name, "the runs' wavenumbers differ, expected the same in all");
        }
        if (run.path_type == 3) {
            if (run.zenith_deg > 90.0) {
                throw InputError(name, fmt::format("a path to space under zenith angle {:g} deg, "
                                                   "expected 0 to 90",
                                                   run.zenith_deg));
            }
            sky_from.push_back(run.h1_km);
        } else {
            from.push_back(run.h1_km);
            to.push_back(run.path_type == 1 ? run.h1_km : run.h2_km);
            if (!(run.range_km > 0.0)) {
                throw InputError(name, fmt::format("a path of range {:g} km", run.range_km));
            }
        }
    }
    if (from.empty() || sky_from.empty()) {
        throw InputError(name, fmt::format("found {} paths to surfaces and {} to space (ITYPE 3), "
                                           "expected some of both",
                                           from.size(), sky_from.size()));
    }
    grid->bins = covered(runs[0].table.axis, name);
    grid->from = distinct(from);
    grid->to = distinct(to);
    grid->sky_from = distinct(sky_from);
    grid->path.resize(grid->from.size() * grid->to.size());
    grid->sky.resize(grid->sky_from.size());
    for (const Tape7Run& run : runs) {
        const double h2 = run.path_type == 1 ? run.h1_km : run.h2_km;
        const bool sky = run.path_type == 3;
        Line& line = sky ? grid->sky[place_of(grid->sky_from, run.h1_km)]
                         : grid->path[place_of(grid->from, run.h1_km) * grid->to.size() +
                                      place_of(grid->to, h2)];
        line.place.push_back(sky ? variable_of(run.zenith_deg) : std::cbrt(run.range_km));
        // A path as good as empty emits nothing, whatever temperature is kept for it.
        line.path.push_back(stored(binned(run, grid->bins), grid->bins, 290.0));
    }
    double least = 0.0, most = 1e9;
    for (std::size_t i = 0; i < grid->path.size(); ++i) {
        const std::string where =
            fmt::format("{}: from {:g} to {:g} km", name, grid->from[i / grid->to.size()],
                        grid->to[i % grid->to.size()]);
        Line& line = grid->path[i];
        if (line.place.empty()) {
            throw InputError(where, "found no path, expected every H2 for every H1");
        }
        sort_line(line, where);
        least = std::max(least, std::pow(line.place.front(), 3));
        most = std::min(most, std::pow(line.place.back(), 3));
    }
    for (std::size_t i = 0; i < grid->sky.size(); ++i) {
        const std::string where = fmt::format("{}: to space from {:g} km", name, grid->sky_from[i]);
        sort_line(grid->sky[i], where);
        const double nearest = grid->sky[i].place.front(), farthest = grid->sky[i].place.back();
        if (nearest > variable_of(0.5) || farthest < variable_of(89.0)) {
            throw InputError(where, "expected zenith angles from 0 to at least 89 deg");
        }
    }
    const std::span<const double> edges = bin_edges_um();
    grid->span = {.extent = {.least_from_km = grid->from.front(),
                             .most_from_km = grid->from.back(),
                             .least_to_km = grid->to.front(),
                             .most_to_km = grid->to.back(),
                             .least_range_km = least,
                             .most_range_km = most},
                  .least_sky_km = grid->sky_from.front(),
                  .most_sky_km = grid->sky_from.back(),
                  .least_um = edges[grid->bins.first],
                  .most_um = edges[grid->bins.last],
                  .paths = runs.size()};
    return {.grid = nullptr, .file = std::move(grid), .profile = nullptr};
}

TableSpan table_span(const Tabulated& table) { return table.file->span; }

BinPath file_path(const FileGrid& g, double from_km, double to_km, double range_km,
                  std::span<const double> node_um) {
    const TableExtent& extent = g.span.extent;
    const auto inside = [](const char* what, double value, double low, double high) {
        const double slack = 1e-3 + 1e-3 * std::abs(high);
        if (value >= low - slack && value <= high + slack) return;
        throw InputError(std::string("atmosphere table: ") + what,
                         fmt::format("{:g} is outside {:g} to {:g}", value, low, high));
    };
    inside("from_km", from_km, extent.least_from_km, extent.most_from_km);
    inside("to_km", to_km, extent.least_to_km, extent.most_to_km);
    inside("range_km", range_km, 0.0, extent.most_range_km);
    const Weights wf = weights(g.from, from_km), wt = weights(g.to, to_km);
    const double root = std::cbrt(range_km);
    Stored sum{std::vector<double>(g.bins.size(), 0.0), std::vector<double>(g.bins.size(), 0.0)};
    for (std::size_t f = 0; f < wf.count; ++f) {
        for (std::size_t t = 0; t < wt.count; ++t) {
            const Line& line = g.path[(wf.first + f) * g.to.size() + wt.first + t];
            // Shorter paths than the shortest are thinner in proportion.
            const double shorter = std::min(1.0, std::pow(root / line.place.front(), 3));
            add(line, root, wf.weight[f] * wt.weight[t], shorter, sum);
        }
    }
    return restored(sum.depth, sum.temperature, node_um, g.bins);
}

BinPath file_sky(const FileGrid& g, double height_km, double zenith_deg,
                 std::span<const double> node_um) {
    const Weights wf = weights(g.sky_from, height_km);
    const double v = variable_of(std::clamp(zenith_deg, 0.0, 90.0));
    Stored sum{std::vector<double>(g.bins.size(), 0.0), std::vector<double>(g.bins.size(), 0.0)};
    for (std::size_t f = 0; f < wf.count; ++f) {
        add(g.sky[wf.first + f], v, wf.weight[f], 1.0, sum);
    }
    return restored(sum.depth, sum.temperature, node_um, g.bins);
}

}  // namespace diurna
