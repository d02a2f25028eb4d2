#include "materials/atmosphere/tabulated.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

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

/// sum += weight · row(x), optical depths besides times `depth_scale`.
void add(const PathRow& row, double x, double weight, double depth_scale, StoredPath& sum) {
    const Weights w = weights(row.node, x);
    for (std::size_t i = 0; i < w.count; ++i) {
        const StoredPath& path = row.path[w.first + i];
        const double both = weight * w.weight[i];
        for (std::size_t b = 0; b < sum.depth.size(); ++b) {
            sum.depth[b] += both * depth_scale * path.depth[b];
            sum.temperature[b] += both * path.temperature[b];
        }
    }
}

StoredPath nothing_yet(BinRange bins) {
    return {std::vector<double>(bins.size(), 0.0), std::vector<double>(bins.size(), 0.0)};
}

void check_spanned(const char* what, double value, double low, double high) {
    const double slack = 1e-3 + 1e-3 * std::abs(high);
    if (value >= low - slack && value <= high + slack) return;
    throw InputError(std::string("atmosphere table: ") + what,
                     fmt::format("{:g} is outside {:g} to {:g}", value, low, high));
}

}  // namespace

double zenith_variable(double zenith_deg) {
    return 1.0 - std::sqrt(std::max(0.0, 1.0 - zenith_deg / 90.0));
}

PathSpectrum table_path(const TabulatedPaths& table, double from_km, double to_km, double range_km,
                        std::span<const double> node_um) {
    const TableSpan& span = table.span;
    check_spanned("from_km", from_km, span.least_from_km, span.most_from_km);
    check_spanned("to_km", to_km, span.least_to_km, span.most_to_km);
    check_spanned("range_km", range_km, 0.0, span.most_range_km);
    const Weights from = weights(table.from, from_km), to = weights(table.to, to_km);
    const double root = std::cbrt(range_km);
    StoredPath sum = nothing_yet(table.bins);
    for (std::size_t f = 0; f < from.count; ++f) {
        for (std::size_t t = 0; t < to.count; ++t) {
            const PathRow& row = table.path[(from.first + f) * table.to.size() + to.first + t];
            const double shorter = std::min(1.0, std::pow(root / row.node.front(), 3));
            add(row, root, from.weight[f] * to.weight[t], shorter, sum);
        }
    }
    return restored(sum, table.bins, node_um);
}

PathSpectrum table_sky(const TabulatedPaths& table, double height_km, double zenith_deg,
                       std::span<const double> node_um) {
    const Weights from = weights(table.sky_from, height_km);
    const double v = zenith_variable(std::clamp(zenith_deg, 0.0, 90.0));
    StoredPath sum = nothing_yet(table.bins);
    for (std::size_t f = 0; f < from.count; ++f) {
        add(table.sky[from.first + f], v, from.weight[f], 1.0, sum);
    }
    return restored(sum, table.bins, node_um);
}

}  // namespace diurna
