#include "materials/atmosphere/path_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "materials/modtran/tape7.hpp"

namespace diurna {

namespace {

/// Heights that differ by less are one [km]; a tape7 prints five decimals.
constexpr double same_km = 2e-5;
/// A path as good as empty emits nothing, whatever temperature is kept for it [K].
constexpr double any_temperature = 290.0;

bool to_space(const Tape7Run& run) { return run.path_type == 3; }
double end_km(const Tape7Run& run) { return run.path_type == 1 ? run.h1_km : run.h2_km; }

void check(const Tape7Run& run, const Tape7Run& first, const std::string& name) {
    if (run.lowtran || (run.emission != 1 && run.emission != 2)) {
        throw InputError(name, fmt::format("found a {} run of IEMSCT {}, expected MODTRAN's "
                                           "thermal radiance, IEMSCT 1 or 2",
                                           run.lowtran ? "LOWTRAN7" : "MODTRAN", run.emission));
    }
    if (run.table.wavenumber != first.table.wavenumber) {
        throw InputError(name, "the runs' wavenumbers differ, expected the same in all");
    }
    if (to_space(run) && run.zenith_deg > 90.0) {
        throw InputError(
            name, fmt::format("found a path to space with zenith angle {:g} deg, expected 0 to 90",
                              run.zenith_deg));
    }
    if (!to_space(run) && !(run.range_km > 0.0)) {
        throw InputError(
            name,
            fmt::format("found a path of range {:g} km, expected a positive range", run.range_km));
    }
}

std::vector<double> distinct(std::vector<double> heights_km) {
    std::sort(heights_km.begin(), heights_km.end());
    const auto same = [](double a, double b) { return b - a < same_km; };
    heights_km.erase(std::unique(heights_km.begin(), heights_km.end(), same), heights_km.end());
    return heights_km;
}

std::size_t place_of(const std::vector<double>& heights_km, double height_km) {
    const auto at = std::lower_bound(heights_km.begin(), heights_km.end(), height_km - same_km);
    return static_cast<std::size_t>(at - heights_km.begin());
}

/// Bins whose both ends the rows reach to a third of the bin.
BinRange covered(const std::vector<double>& wavenumber, const std::string& name) {
    const std::span<const double> edges = bin_edges_um();
    BinRange bins{.first = edges.size(), .last = 0};
    for (std::size_t b = 0; b < bin_count(); ++b) {
        const double low = wavenumber_of_um(edges[b + 1]), high = wavenumber_of_um(edges[b]);
        const double slack = (high - low) / 3.0;
        if (wavenumber.front() > low + slack || wavenumber.back() < high - slack) continue;
        bins.first = std::min(bins.first, b);
        bins.last = b + 1;
    }
    if (bins.first >= bins.last) {
        throw InputError(name, fmt::format("{:g} to {:g} cm-1 contain no bin of 0.35 to 20 um",
                                           wavenumber.front(), wavenumber.back()));
    }
    return bins;
}

/// Means over the bins' wavenumbers, by the trapezoid rule.
PathSpectrum binned(const Tape7Run& run, BinRange bins) {
    const std::vector<double>& nu = run.table.wavenumber;
    const std::vector<double>& tau_at = run.table.column("TOT_TRANS");
    const std::vector<double>& thermal_at = run.table.column("PTH_THRML");
    const std::span<const double> edges = bin_edges_um();
    PathSpectrum path;
    for (std::size_t b = bins.first; b < bins.last; ++b) {
        const double low = wavenumber_of_um(edges[b + 1]), high = wavenumber_of_um(edges[b]);
        double sum = 0.0, tau = 0.0, radiance = 0.0;
        const auto first = std::lower_bound(nu.begin(), nu.end(), low - 1e-6) - nu.begin();
        for (auto i = static_cast<std::size_t>(first); i < nu.size() && nu[i] <= high + 1e-6; ++i) {
            const bool edge = nu[i] < low + 1e-6 || nu[i] > high - 1e-6;
            const double weight = edge ? 0.5 : 1.0;  // shared with the next bin
            sum += weight;
            tau += weight * tau_at[i];
            radiance += std::isnan(thermal_at[i]) ? 0.0 : weight * thermal_at[i];
        }
        if (sum == 0.0) {
            throw std::runtime_error(
                fmt::format("MODTRAN computed nothing from {:g} to {:g} cm-1", low, high));
        }
        path.transmittance.push_back(tau / sum);
        path.radiance.push_back(
            per_um_from_modtran(radiance / sum, wavenumber_of_um(bin_middles_um()[b])));
    }
    return path;
}

/// Sorts a row by its nodes; two at one place are refused.
void sort_row(PathRow& row, const std::string& where) {
    std::vector<std::size_t> order(row.node.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return row.node[a] < row.node[b]; });
    PathRow sorted;
    for (const std::size_t i : order) {
        if (!sorted.node.empty() && row.node[i] - sorted.node.back() < 1e-6) {
            throw InputError(where, "found the same path twice");
        }
        sorted.node.push_back(row.node[i]);
        sorted.path.push_back(std::move(row.path[i]));
    }
    row = std::move(sorted);
}

/// The heights of both ends, and empty rows between them.
TabulatedPaths empty_table(const std::vector<Tape7Run>& runs, const std::string& name) {
    std::vector<double> from, to, sky_from;
    for (const Tape7Run& run : runs) {
        check(run, runs[0], name);
        (to_space(run) ? sky_from : from).push_back(run.h1_km);
        if (!to_space(run)) to.push_back(end_km(run));
    }
    if (from.empty() || sky_from.empty()) {
        throw InputError(name, fmt::format("found {} paths to surfaces and {} to space (ITYPE 3), "
                                           "expected at least one of each",
                                           from.size(), sky_from.size()));
    }
    TabulatedPaths table;
    table.bins = covered(runs[0].table.wavenumber, name);
    table.from = distinct(std::move(from));
    table.to = distinct(std::move(to));
    table.sky_from = distinct(std::move(sky_from));
    table.path.resize(table.from.size() * table.to.size());
    table.sky.resize(table.sky_from.size());
    return table;
}

void sort_rows(TabulatedPaths& table, const std::string& name) {
    for (std::size_t i = 0; i < table.path.size(); ++i) {
        const std::string where =
            fmt::format("{}: from {:g} to {:g} km", name, table.from[i / table.to.size()],
                        table.to[i % table.to.size()]);
        if (table.path[i].node.empty()) {
            throw InputError(where, "found no path, expected every H2 for every H1");
        }
        sort_row(table.path[i], where);
    }
    for (std::size_t i = 0; i < table.sky.size(); ++i) {
        const std::string where = fmt::format("{}: to space from {:g} km", name, table.sky_from[i]);
        sort_row(table.sky[i], where);
        const std::vector<double>& node = table.sky[i].node;
        if (node.front() > zenith_variable(0.5) || node.back() < zenith_variable(89.0)) {
            throw InputError(where, "expected zenith angles from 0 to at least 89 deg");
        }
    }
}

TableSpan span_of(const TabulatedPaths& table, std::size_t paths) {
    double most_range = 1e9;
    for (const PathRow& row : table.path) {
        most_range = std::min(most_range, std::pow(row.node.back(), 3));
    }
    return {.least_from_km = table.from.front(),
            .most_from_km = table.from.back(),
            .least_to_km = table.to.front(),
            .most_to_km = table.to.back(),
            .most_range_km = most_range,
            .least_sky_km = table.sky_from.front(),
            .most_sky_km = table.sky_from.back(),
            .least_um = bin_edges_um()[table.bins.first],
            .most_um = bin_edges_um()[table.bins.last],
            .paths = paths};
}

}  // namespace

std::shared_ptr<const TabulatedPaths> read_path_table(const std::filesystem::path& file) {
    const std::vector<Tape7Run> runs = read_tape7(file);
    const std::string name = file.string();
    TabulatedPaths table = empty_table(runs, name);
    for (const Tape7Run& run : runs) {
        const bool sky = to_space(run);
        PathRow& row = sky ? table.sky[place_of(table.sky_from, run.h1_km)]
                           : table.path[place_of(table.from, run.h1_km) * table.to.size() +
                                        place_of(table.to, end_km(run))];
        row.node.push_back(sky ? zenith_variable(run.zenith_deg) : std::cbrt(run.range_km));
        row.path.push_back(stored(binned(run, table.bins), table.bins, any_temperature));
    }
    sort_rows(table, name);
    table.span = span_of(table, runs.size());
    return std::make_shared<const TabulatedPaths>(std::move(table));
}

}  // namespace diurna
