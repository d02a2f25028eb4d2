#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/atmosphere/path_grid.hpp"
#include "materials/atmosphere/stored_path.hpp"
#include "materials/base/units.hpp"
#include "materials/modtran/modtran.hpp"

namespace diurna {

PathSource path_source(const BandModel& model) {
    return [model](std::span<const TablePath> paths, BinRange bins) {
        const std::span<const double> node = bin_middles_um().subspan(bins.first, bins.size());
        std::vector<BinPath> found;
        for (const TablePath& path : paths) {
            SightLine line;
            if (path.to_space) {
                line = line_of(model, path.from_km, path.zenith_deg);
            } else {
                // The straight chord: heights over its length to second order of the earth's curve;
                // a smooth function of its ends even where they are further apart than its length.
                const int cuts = 24 + static_cast<int>(12.0 * std::abs(path.to_km - path.from_km));
                const double sag = path.range_km * path.range_km / (2.0 * earth_radius_km);
                const double rise = path.to_km - path.from_km - sag;
                const auto height = [&](double t) { return path.from_km + t * (rise + t * sag); };
                line.edge_km.push_back(path.from_km);
                for (int i = 0; i < cuts; ++i) {
                    const double a = double(i) * i / (double(cuts) * cuts);
                    const double b = double(i + 1) * (i + 1) / (double(cuts) * cuts);
                    line.height_km.push_back(height(0.5 * (a + b)));
                    line.length_km.push_back((b - a) * path.range_km);
                    line.edge_km.push_back(height(b));
                }
            }
            NodeSpectrum spectrum = path_at_nodes(model, line, node);
            found.push_back({std::move(spectrum.transmittance), std::move(spectrum.radiance)});
        }
        return found;
    };
}

BinPath binned(const Tape7Run& run, BinRange bins) {
    const std::vector<double>& nu = run.table.axis;
    const std::vector<double>& tau_at = run.table.column("TOT_TRANS");
    const std::vector<double>& thermal_at = run.table.column("PTH_THRML");
    const std::span<const double> edges = bin_edges_um();
    BinPath path;
    for (std::size_t b = bins.first; b < bins.last; ++b) {
        // Mean over the bin's wavenumbers, by the trapezoid rule.
        const double low = 1e4 / edges[b + 1], high = 1e4 / edges[b];
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
                fmt::format("MODTRAN gave nothing from {:g} to {:g} cm-1", low, high));
        }
        path.transmittance.push_back(tau / sum);
        path.radiance.push_back(
            per_um_from_modtran(radiance / sum, wavenumber_of_um(bin_middles_um()[b])));
    }
    return path;
}

PathSource path_source(const ModtranRunner& runner, const ModtranDeck& like) {
    return [runner, like](std::span<const TablePath> paths, BinRange bins) {
        std::vector<ModtranDeck> decks;
        const std::span<const double> edges = bin_edges_um();
        for (const TablePath& path : paths) {
            ModtranDeck deck = like;
            deck.emission = ModtranDeck::Emission::thermal;
            deck.first_per_cm = std::floor(1e4 / edges[bins.last] + 1e-6);
            deck.last_per_cm = std::ceil(1e4 / edges[bins.first] - 1e-6);
            deck.h1_km = path.from_km;
            if (path.to_space) {
                deck.path = ModtranDeck::PathType::to_space;
                deck.zenith_deg = path.zenith_deg;
            } else if (std::abs(path.to_km - path.from_km) < 1e-4) {
                deck.path = ModtranDeck::PathType::level;
                deck.range_km = path.range_km;
            } else {
                deck.path = ModtranDeck::PathType::between_heights;
                deck.h2_km = path.to_km;
                // No real line is shorter than it climbs.
                deck.range_km = std::max(path.range_km, std::abs(path.to_km - path.from_km) + 1e-4);
            }
            decks.push_back(std::move(deck));
        }
        const std::vector<Tape7Run> runs = run_decks(runner, decks);
        std::vector<BinPath> found;
        for (const Tape7Run& run : runs) {
            found.push_back(binned(run, bins));
        }
        return found;
    };
}

}  // namespace diurna
