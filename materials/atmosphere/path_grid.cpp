#include "materials/atmosphere/path_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/atmosphere/stored_path.hpp"
#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

/// A uniform axis; one node where it has no length.
struct Axis {
    double low, high;
    std::size_t count;
    double at(std::size_t i) const {
        return count == 1 ? low : low + (high - low) * double(i) / double(count - 1);
    }
    double place(double x) const {
        return count == 1 ? 0.0 : (x - low) / (high - low) * double(count - 1);
    }
};

/// Lagrange weights of up to four neighbouring nodes.
struct Weights {
    std::size_t first, count;
    std::array<double, 4> weight;
};
Weights weights(const Axis& axis, double x) {
    const double place = std::clamp(axis.place(x), 0.0, double(axis.count - 1));
    Weights w{.first = 0, .count = std::min<std::size_t>(axis.count, 4), .weight = {}};
    const double before = std::floor(place) - 1.0;
    w.first = static_cast<std::size_t>(std::clamp(before, 0.0, double(axis.count - w.count)));
    const double y = place - double(w.first);
    for (std::size_t j = 0; j < w.count; ++j) {
        w.weight[j] = 1.0;
        for (std::size_t k = 0; k < w.count; ++k) {
            if (k != j) w.weight[j] *= (y - double(k)) / (double(j) - double(k));
        }
    }
    return w;
}

/// Zenith angles crowd towards the horizon: v = 1 − √(1 − zenith / 90°).
double zenith_of(double v) { return 90.0 * (1.0 - (1.0 - v) * (1.0 - v)); }

}  // namespace

double variable_of(double zenith_deg) {
    return 1.0 - std::sqrt(std::max(0.0, 1.0 - zenith_deg / 90.0));
}

Stored stored(const BinPath& path, BinRange bins, double fallback) {
    Stored s;
    for (std::size_t b = 0; b < bins.size(); ++b) {
        const double tau = std::clamp(path.transmittance[b], 0.0, 1.0);
        const double um = bin_middles_um()[bins.first + b];
        s.depth.push_back(-std::log(std::max(tau, 1e-30)));
        double temperature = fallback;
        if (1.0 - tau > 1e-10 && path.radiance[b] > 0.0) {
            // Planck's law solved for T.
            const double black = path.radiance[b] / (1.0 - tau);
            const double x = std::log1p(first_radiation_um / (std::pow(um, 5) * black));
            temperature = second_radiation_um / (um * x);
        }
        s.temperature.push_back(temperature);
    }
    return s;
}

BinPath restored(std::span<const double> depth, std::span<const double> temperature,
                 std::span<const double> node_um, BinRange bins) {
    BinPath path;
    for (const double um : node_um) {
        const std::size_t bin = bin_of(um);
        if (bin < bins.first || bin >= bins.last) {
            throw InputError("path table",
                             fmt::format("{:g} um is outside the bands it was made for", um));
        }
        const double d = std::max(0.0, depth[bin - bins.first]);
        path.transmittance.push_back(std::exp(-d));
        path.radiance.push_back(-std::expm1(-d) * planck(um, temperature[bin - bins.first]));
    }
    return path;
}

struct PathGrid {
    BinRange bins;
    Axis from, to, range;          // range: of its cube root
    Axis sky;                      // of variable_of(zenith)
    std::vector<Stored> path;      // (from, to, range)
    std::vector<Stored> to_space;  // (from, sky)
    TableExtent extent;
    Profile profile;
    double space_temperature;
    TableError error;

    const Stored& path_at(std::size_t f, std::size_t t, std::size_t r) const {
        return path[(f * to.count + t) * range.count + r];
    }
};

namespace {

std::vector<TablePath> paths_of(const PathGrid& grid) {
    std::vector<TablePath> paths;
    for (std::size_t f = 0; f < grid.from.count; ++f) {
        for (std::size_t t = 0; t < grid.to.count; ++t) {
            for (std::size_t r = 0; r < grid.range.count; ++r) {
                const double from = grid.from.at(f), to = grid.to.at(t);
                const double range = std::pow(grid.range.at(r), 3);
                paths.push_back({from, to, range, 0.0, false});
            }
        }
    }
    for (std::size_t f = 0; f < grid.from.count; ++f) {
        for (std::size_t v = 0; v < grid.sky.count; ++v) {
            paths.push_back({grid.from.at(f), 0.0, 0.0, zenith_of(grid.sky.at(v)), true});
        }
    }
    return paths;
}

void fill(PathGrid& grid, const PathSource& source) {
    const std::vector<TablePath> wanted = paths_of(grid);
    const std::vector<BinPath> found = source(wanted, grid.bins);
    grid.error.paths += wanted.size();
    grid.path.clear();
    grid.to_space.clear();
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        const double air = air_at(grid.profile, wanted[i].from_km).temperature;
        (wanted[i].to_space ? grid.to_space : grid.path)
            .push_back(stored(found[i], grid.bins, air));
    }
}

/// Places half-way between the nodes of one axis, at nodes of the others' ends and middle.
std::vector<double> middles(const Axis& axis) {
    std::vector<double> places;
    for (std::size_t i = 0; i + 1 < axis.count; ++i) {
        places.push_back(0.5 * (axis.at(i) + axis.at(i + 1)));
    }
    return places;
}
std::vector<double> some(const Axis& axis) {
    if (axis.count == 1) return {axis.low};
    return {axis.low, axis.at(axis.count / 2), axis.high};
}

}  // namespace

Tabulated tabulate(const PathSource& source, const Profile& profile, const TableExtent& extent,
                   std::span<const Band> bands, const TableTolerance& tolerance,
                   double surface_temperature, double space_temperature) {
    const auto ascending = [](const char* what, double low, double high) {
        if (!(low <= high) || !std::isfinite(low) || !std::isfinite(high)) {
            throw InputError(std::string("path table: ") + what,
                             fmt::format("found {:g} to {:g}", low, high));
        }
    };
    ascending("from_km", extent.least_from_km, extent.most_from_km);
    ascending("to_km", extent.least_to_km, extent.most_to_km);
    ascending("range_km", extent.least_range_km, extent.most_range_km);
    if (bands.empty()) throw InputError("path table", "no band to make it for");
    std::vector<double> all;
    for (const Band& band : bands) {
        all.insert(all.end(), band.node_um.begin(), band.node_um.end());
    }
    const auto axis = [](double low, double high, std::size_t count) {
        return high - low < 1e-6 ? Axis{low, high, 1} : Axis{low, high, count};
    };
    auto grid = std::make_shared<PathGrid>();
    grid->bins = bins_of(all);
    grid->from = axis(extent.least_from_km, extent.most_from_km, 2);
    grid->to = axis(extent.least_to_km, extent.most_to_km, 2);
    grid->range = axis(std::cbrt(extent.least_range_km), std::cbrt(extent.most_range_km), 5);
    grid->sky = {0.0, 1.0, 9};
    grid->extent = extent;
    grid->profile = profile;
    grid->space_temperature = space_temperature;
    const Tabulated table{grid};

    while (true) {
        fill(*grid, source);
        // Probes of one axis at a time; the worst names the axis to refine.
        std::array<std::vector<TablePath>, 4> probe;
        for (const double f : middles(grid->from)) {
            for (const double t : some(grid->to)) {
                for (const double r : some(grid->range)) probe[0].push_back({f, t, r, 0, false});
            }
            for (const double v : some(grid->sky))
                probe[0].push_back({f, 0, 0, zenith_of(v), true});
        }
        for (const double t : middles(grid->to)) {
            for (const double f : some(grid->from)) {
                for (const double r : some(grid->range)) probe[1].push_back({f, t, r, 0, false});
            }
        }
        for (const double r : middles(grid->range)) {
            for (const double f : some(grid->from)) {
                for (const double t : some(grid->to)) probe[2].push_back({f, t, r, 0, false});
            }
        }
        for (const double v : middles(grid->sky)) {
            for (const double f : some(grid->from)) {
                probe[3].push_back({f, 0, 0, zenith_of(v), true});
            }
        }
        std::array<double, 4> worst{};
        grid->error.relative = grid->error.kelvin = 0.0;
        for (std::size_t a = 0; a < probe.size(); ++a) {
            for (TablePath& path : probe[a]) {
                if (path.to_space) continue;
                path.range_km = std::pow(path.range_km, 3);
            }
            if (probe[a].empty()) continue;
            const std::vector<BinPath> direct = source(probe[a], grid->bins);
            grid->error.paths += probe[a].size();
            for (std::size_t i = 0; i < probe[a].size(); ++i) {
                const TablePath& p = probe[a][i];
                const Stored exact = stored(direct[i], grid->bins, surface_temperature);
                for (const Band& band : bands) {
                    const BinPath found =
                        p.to_space
                            ? table_sky(table, p.from_km, p.zenith_deg, band.node_um)
                            : table_path(table, p.from_km, p.to_km, p.range_km, band.node_um);
                    const BinPath right =
                        restored(exact.depth, exact.temperature, band.node_um, grid->bins);
                    for (const double behind : {surface_temperature, surface_temperature + 20.0}) {
                        double a_sum = 0.0, b_sum = 0.0;
                        for (std::size_t n = 0; n < band.node_um.size(); ++n) {
                            const double black =
                                planck(band.node_um[n], p.to_space ? space_temperature : behind);
                            a_sum += band.weight[n] *
                                     (found.radiance[n] + found.transmittance[n] * black);
                            b_sum += band.weight[n] *
                                     (right.radiance[n] + right.transmittance[n] * black);
                        }
                        if (!(b_sum > 0.0)) continue;
                        const double relative = std::abs(a_sum / b_sum - 1.0);
                        // The sky counts by its share of what a surface reflects: its radiance
                        // error over the slope of a surface's own.
                        const double at =
                            p.to_space ? surface_temperature : brightness_temperature(band, b_sum);
                        const double kelvin =
                            std::abs(a_sum - b_sum) / band_radiance_derivative(band, at);
                        grid->error.relative = std::max(grid->error.relative, relative);
                        grid->error.kelvin = std::max(grid->error.kelvin, kelvin);
                        worst[a] = std::max(worst[a], std::max(relative / tolerance.relative,
                                                               kelvin / tolerance.kelvin));
                    }
                }
            }
        }
        const double most = *std::max_element(worst.begin(), worst.end());
        if (most <= 1.0) break;
        for (std::size_t a = 0; a < worst.size(); ++a) {
            // All axes that are not good enough by themselves, so that few rounds suffice.
            if (worst[a] <= 0.7) continue;
            Axis& refine = a == 0   ? grid->from
                           : a == 1 ? grid->to
                           : a == 2 ? grid->range
                                    : grid->sky;
            refine.count = 2 * refine.count - 1;
        }
        const std::size_t next =
            grid->from.count * (grid->to.count * grid->range.count + grid->sky.count);
        if (next + grid->error.paths > tolerance.most_paths) {
            grid->error.reached = false;
            // The last table stays: undo the refinement.
            for (std::size_t a = 0; a < worst.size(); ++a) {
                if (worst[a] <= 0.7) continue;
                Axis& refine = a == 0   ? grid->from
                               : a == 1 ? grid->to
                               : a == 2 ? grid->range
                                        : grid->sky;
                refine.count = (refine.count + 1) / 2;
            }
            break;
        }
    }
    return table;
}

const TableError& table_error(const Tabulated& table) { return table.grid->error; }

BinPath table_path(const Tabulated& table, double from_km, double to_km, double range_km,
                   std::span<const double> node_um) {
    if (table.file) return file_path(*table.file, from_km, to_km, range_km, node_um);
    const PathGrid& g = *table.grid;
    const auto inside = [](const char* what, double value, double low, double high) {
        const double slack = 1e-3 + 1e-3 * std::abs(high);
        if (value >= low - slack && value <= high + slack) return;
        throw InputError(std::string("path table: ") + what,
                         fmt::format("{:g} is outside {:g} to {:g}", value, low, high));
    };
    inside("from_km", from_km, g.extent.least_from_km, g.extent.most_from_km);
    inside("to_km", to_km, g.extent.least_to_km, g.extent.most_to_km);
    // Shorter paths than the shortest are thinner in proportion.
    inside("range_km", std::max(range_km, g.extent.least_range_km), g.extent.least_range_km,
           std::max(g.extent.most_range_km, std::abs(from_km - to_km)));
    const Weights wf = weights(g.from, from_km), wt = weights(g.to, to_km);
    const Weights wr = weights(g.range, std::cbrt(range_km));
    std::vector<double> depth(g.bins.size(), 0.0), temperature(g.bins.size(), 0.0);
    for (std::size_t f = 0; f < wf.count; ++f) {
        for (std::size_t t = 0; t < wt.count; ++t) {
            for (std::size_t r = 0; r < wr.count; ++r) {
                const Stored& s = g.path_at(wf.first + f, wt.first + t, wr.first + r);
                const double w = wf.weight[f] * wt.weight[t] * wr.weight[r];
                for (std::size_t b = 0; b < depth.size(); ++b) {
                    depth[b] += w * s.depth[b];
                    temperature[b] += w * s.temperature[b];
                }
            }
        }
    }
    const double shorter = std::min(1.0, range_km / g.extent.least_range_km);
    if (shorter < 1.0) {
        for (double& d : depth) d *= shorter;
    }
    return restored(depth, temperature, node_um, g.bins);
}

BinPath table_sky(const Tabulated& table, double height_km, double zenith_deg,
                  std::span<const double> node_um) {
    if (table.file) return file_sky(*table.file, height_km, zenith_deg, node_um);
    const PathGrid& g = *table.grid;
    const Weights wf = weights(g.from, height_km);
    const Weights wz = weights(g.sky, variable_of(std::clamp(zenith_deg, 0.0, 90.0)));
    std::vector<double> depth(g.bins.size(), 0.0), temperature(g.bins.size(), 0.0);
    for (std::size_t f = 0; f < wf.count; ++f) {
        for (std::size_t z = 0; z < wz.count; ++z) {
            const Stored& s = g.to_space[(wf.first + f) * g.sky.count + wz.first + z];
            const double w = wf.weight[f] * wz.weight[z];
            for (std::size_t b = 0; b < depth.size(); ++b) {
                depth[b] += w * s.depth[b];
                temperature[b] += w * s.temperature[b];
            }
        }
    }
    return restored(depth, temperature, node_um, g.bins);
}

double table_air_temperature(const Tabulated& table, double height_km) {
    return air_at(table.profile ? *table.profile : table.grid->profile, height_km).temperature;
}
double table_space_temperature(const Tabulated& table) {
    return table.file ? 2.725 : table.grid->space_temperature;
}

}  // namespace diurna
