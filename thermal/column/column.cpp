#include "thermal/column/column.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace diurna {

namespace {

double skin_depth(const Layer& layer, double period) {
    // (T17) of docs/theory.md
    return std::sqrt(layer.conductivity * period /
                     (std::numbers::pi * layer.density * layer.heat_capacity));
}

}  // namespace

double ColumnGrid::total_capacity() const {
    double sum = 0.0;
    for (const double c : capacity) sum += c;
    return sum;
}

ColumnGrid column_grid(std::span<const Layer> layers, const Bottom& bottom,
                       const GridOptions& options) {
    assert(!layers.empty());
    // (T16) of docs/theory.md: cells of heat and links between them
    ColumnGrid grid;
    grid.depth.push_back(0.0);
    grid.capacity.push_back(0.0);

    // Spacing in skin depths grows linearly with the skin depths gone down, first + growth ξ, so
    // nodes are equidistant in ∫ dξ / (first + growth ξ).
    double xi = 0.0, top = 0.0;
    for (const Layer& layer : layers) {
        const double skin = skin_depth(layer, options.period);
        const double thickness =
            std::holds_alternative<FixedFlux>(bottom)
                ? std::min(layer.thickness, std::max(0.0, options.deepest - xi) * skin)
                : layer.thickness;
        if (thickness <= 0.0) break;
        const double from = options.first + options.growth * xi;
        const double to = from + options.growth * thickness / skin;
        const double ratio = to / from;
        const int cells =
            std::max(1, static_cast<int>(std::ceil(std::log(ratio) / options.growth - 1e-9)));
        const double heat = layer.density * layer.heat_capacity;
        double before = 0.0;
        for (int i = 1; i <= cells; ++i) {
            const double part =
                i == cells ? 1.0 : (std::pow(ratio, double(i) / cells) - 1.0) / (ratio - 1.0);
            const double width = (part - before) * thickness;
            grid.capacity.back() += 0.5 * heat * width;
            grid.conductance.push_back(layer.conductivity / width);
            grid.capacity.push_back(0.5 * heat * width);
            grid.depth.push_back(top + part * thickness);
            before = part;
        }
        top += thickness;
        xi += thickness / skin;
    }

    if (const auto* fixed = std::get_if<FixedTemperature>(&bottom)) {
        // The last node is the place of the given temperature; its link leads there.
        grid.depth.pop_back();
        grid.capacity.pop_back();
        grid.below_temperature = fixed->temperature;
    } else if (const auto* room = std::get_if<Interior>(&bottom)) {
        grid.conductance.push_back(room->film);
        grid.below_temperature = room->air_temperature;
    } else {
        grid.conductance.push_back(0.0);
        grid.below_flux = std::get<FixedFlux>(bottom).flux;
    }
    assert(grid.conductance.size() == grid.size());
    return grid;
}

Stage make_stage(const ColumnGrid& grid, double tau, double reference) {
    const std::size_t n = grid.size();
    Stage stage{.tau = tau,
                .b = 0.0,
                .surface_store = grid.capacity[0] / tau,
                .remember = std::vector<double>(n),
                .lift = std::vector<double>(n),
                .follow = std::vector<double>(n),
                .below = 0.0};
    // (T18) of docs/theory.md
    const double last = grid.conductance[n - 1];
    const double driven = last * (grid.below_temperature - reference) + grid.below_flux;
    double below_follow = 0.0;  // of the node under i; what lies below the column does not follow
    for (std::size_t i = n - 1; i >= 1; --i) {
        const double store = grid.capacity[i] / tau;
        const double up = grid.conductance[i - 1], down = grid.conductance[i];
        const double scale = 1.0 / (store + up + down * (1.0 - below_follow));
        stage.remember[i] = store * scale;
        stage.lift[i] = i + 1 < n ? down * scale : 0.0;
        stage.follow[i] = up * scale;
        if (i == n - 1) stage.below = driven * scale;
        below_follow = stage.follow[i];
    }
    stage.remember[0] = stage.surface_store;
    stage.lift[0] = n > 1 ? grid.conductance[0] : 0.0;
    if (n == 1) stage.below = driven;
    stage.b = stage.surface_store + grid.conductance[0] * (1.0 - below_follow);
    return stage;
}

void eliminate(const ColumnGrid& grid, const Stage& stage, std::size_t count, const double* start,
               double* offset, double* a) {
    const std::size_t n = grid.size();
    double carried[lanes];
    std::fill_n(carried, lanes, 0.0);
    for (std::size_t i = n - 1; i >= 1; --i) {
        const double remember = stage.remember[i], lift = stage.lift[i];
        const double add = i == n - 1 ? stage.below : 0.0;
        const double* old = start + i * lanes;
        double* out = offset + i * lanes;
#pragma omp simd
        for (std::size_t l = 0; l < count; ++l) {
            carried[l] = remember * old[l] + lift * carried[l] + add;
            out[l] = carried[l];
        }
    }
    const double add = n == 1 ? stage.below : 0.0;
#pragma omp simd
    for (std::size_t l = 0; l < count; ++l) {
        a[l] = stage.surface_store * start[l] + stage.lift[0] * carried[l] + add;
    }
}

SteadyColumn steady_column(const ColumnGrid& grid) {
    const std::size_t n = grid.size();
    const bool open = grid.conductance[n - 1] > 0.0;
    SteadyColumn steady{.conductance = 0.0,
                        .temperature = grid.below_temperature,
                        .flux = open ? 0.0 : grid.below_flux,
                        .share = std::vector<double>(n, 1.0),
                        .excess = std::vector<double>(n, 0.0)};
    double resistance = 0.0;
    for (std::size_t i = 0; i + 1 < n; ++i) resistance += 1.0 / grid.conductance[i];
    const double whole = open ? resistance + 1.0 / grid.conductance[n - 1] : 0.0;
    if (open) steady.conductance = 1.0 / whole;
    double above = 0.0;
    for (std::size_t i = 1; i < n; ++i) {
        above += 1.0 / grid.conductance[i - 1];
        if (open) {
            steady.share[i] = 1.0 - above / whole;
        } else {
            steady.excess[i] = grid.below_flux * above;
        }
    }
    return steady;
}

}  // namespace diurna
