#pragma once

#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/base/csv.hpp"
#include "materials/base/units.hpp"

/// The reference runs of LOWTRAN7 and how they are repeated here: shared by tests and benches.
namespace lowtran {

using namespace diurna;

struct Range {
    const char* name;
    double from_um, to_um;
    Band band() const { return flat_band(name, from_um, to_um, bin_edges_um()); }
};
inline constexpr std::array<Range, 9> ranges = {{{"0.4-0.7", 0.4, 0.7},
                                                 {"0.7-1.0", 0.7, 1.0},
                                                 {"1.5-1.8", 1.5, 1.8},
                                                 {"2.0-2.5", 2.0, 2.5},
                                                 {"3-5", 3.0, 5.0},
                                                 {"3.5-4.1", 3.5, 4.1},
                                                 {"4.5-5", 4.5, 5.0},
                                                 {"8-12", 8.0, 12.0},
                                                 {"8-14", 8.0, 14.0}}};

/// "TROP", "R05": the model air of a row. LOWTRAN7 has 330 ppm of carbon dioxide.
inline BandModel model_of(const std::string& profile, const std::string& aerosol) {
    static const std::map<std::string, std::pair<std::string, double>> aerosols = {
        {"R23", {"rural", 23.0}}, {"R05", {"rural", 5.0}}, {"M23", {"maritime", 23.0}}};
    const auto& [name, visibility] = aerosols.at(aerosol);
    return {.profile = afgl_profile(profile),
            .aerosol = name,
            .visibility_km = visibility,
            .co2_ppm = 330.0};
}

/// One row of a *_bands.csv file.
struct Row {
    std::string profile, aerosol, kind;
    double h1_km, h2_km, range_km, zenith_deg;  // range NaN where the end is a height
    std::array<double, 9> transmittance;
    std::array<double, 9> thermal;  // [W m⁻² sr⁻¹]; NaN where the file has none

    SightLine line(const BandModel& air) const {
        if (kind == "horizontal") return {{h1_km}, {range_km}};
        if (kind == "ground_to_air") {
            const double r = earth_radius_km + h1_km, mu = std::cos(radians(zenith_deg));
            const double top = earth_radius_km + h2_km;
            return line_of(air, h1_km, zenith_deg,
                           std::sqrt(top * top - r * r * (1.0 - mu * mu)) - r * mu);
        }
        return line_of(air, h1_km, zenith_deg);
    }
};

inline std::vector<Row> rows(const std::filesystem::path& file) {
    const CsvTable table = read_csv(file);
    const auto text = [&](std::size_t row, const char* name) {
        return table.rows[row][table.column(name)];
    };
    const auto number = [&](std::size_t row, const std::string& name) {
        constexpr double nothing = std::numeric_limits<double>::quiet_NaN();
        if (!table.has(name) || table.rows[row][table.column(name)].empty()) return nothing;
        return table.number(row, table.column(name));
    };
    std::vector<Row> found;
    for (std::size_t i = 0; i < table.rows.size(); ++i) {
        Row row{.profile = text(i, "model"),
                .aerosol = text(i, "aerosol"),
                .kind = text(i, "kind"),
                .h1_km = number(i, "h1_km"),
                .h2_km = number(i, "h2_km"),
                .range_km = number(i, "range_km"),
                .zenith_deg = number(i, "zenith_deg"),
                .transmittance = {},
                .thermal = {}};
        for (std::size_t b = 0; b < ranges.size(); ++b) {
            row.transmittance[b] = number(i, std::string("tau_") + ranges[b].name);
            row.thermal[b] = number(i, std::string("thermal_W_m2_sr_") + ranges[b].name);
        }
        found.push_back(std::move(row));
    }
    return found;
}

/// Errors in per cent.
struct Errors {
    int count = 0;
    double sum = 0.0, absolute = 0.0, worst = 0.0;
    void add(double found, double expected) {
        const double percent = 100.0 * (found / expected - 1.0);
        ++count;
        sum += percent;
        absolute += std::abs(percent);
        worst = std::max(worst, std::abs(percent));
    }
    double bias() const { return sum / count; }
    double mean() const { return absolute / count; }
};

/// Errors of band transmittance where it exceeds 0.05, and of thermal radiance, per range.
struct Comparison {
    std::array<Errors, 9> transmittance, thermal;
};
template <class Keep>
Comparison compare(const std::vector<Row>& reference, Keep&& keep) {
    Comparison result;
    for (const Row& row : reference) {
        if (!keep(row)) continue;
        const BandModel air = model_of(row.profile, row.aerosol);
        const SightLine line = row.line(air);
        for (std::size_t b = 0; b < ranges.size(); ++b) {
            const Band band = ranges[b].band();
            const PathSpectrum path = path_at_nodes(air, line, band.node_um);
            if (row.transmittance[b] > 0.05) {
                result.transmittance[b].add(band_mean_nodes(band, path.transmittance),
                                            row.transmittance[b]);
            }
            if (!std::isnan(row.thermal[b])) {
                result.thermal[b].add(band_sum_nodes(band, path.radiance), row.thermal[b]);
            }
        }
    }
    return result;
}

}  // namespace lowtran
