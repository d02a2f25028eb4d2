#include "materials/band_model_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "materials/error.hpp"
#include "materials/files.hpp"
#include "materials/spectrum.hpp"
#include "materials/units.hpp"

namespace diurna {

namespace {

using Tables = BandModelTables;

CsvTable table(const char* name) { return read_csv(data_folder() / "atmosphere" / name); }

/// Total of the published solar spectrum, to whose shape `solar_constant` is given.
constexpr double e490_total = 1366.1;  // [W m⁻²]

Gas gas_named(const CsvTable& csv, std::size_t row) {
    static const std::array<std::string, 7> names = {"H2O", "CO2", "O3", "N2O", "CO", "CH4", "O2"};
    const std::string& name = csv.rows[row][csv.column("gas")];
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        throw InputError(csv.where(row, csv.column("gas")), "unknown gas '" + name + "'");
    }
    return static_cast<Gas>(found - names.begin());
}

void load_continuum(Tables& tables) {
    const CsvTable csv = table("continuum.csv");
    const std::size_t lo = csv.column("nu_lo"), hi = csv.column("nu_hi");
    constexpr std::array<const char*, Tables::linear_count> columns = {
        "Cs", "Cd", "Cf", "N2", "rayleigh", "O3vis", "HNO3"};
    for (std::size_t row = csv.rows.size(); row-- > 0;) {  // wavenumbers ascend, wavelengths not
        const double low = csv.number(row, lo), high = csv.number(row, hi);
        const double edge = um_of_wavenumber(high);
        if (!tables.edge_um.empty() && tables.edge_um.back() != edge) {
            throw InputError(csv.where(row, hi), "bins are not contiguous");
        }
        if (tables.edge_um.empty()) tables.edge_um.push_back(edge);
        tables.edge_um.push_back(um_of_wavenumber(low));
        tables.middle_um.push_back(um_of_wavenumber(0.5 * (low + high)));
        for (std::size_t term = 0; term < columns.size(); ++term) {
            tables.linear[term].push_back(csv.number(row, csv.column(columns[term])));
        }
    }
}

/// Bin that holds a wavelength of the grid.
std::size_t bin_at(const std::vector<double>& edges, double wavelength_um) {
    const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, wavelength_um);
    return static_cast<std::size_t>(above - edges.begin()) - 1;
}

void load_gases(Tables& tables) {
    const CsvTable csv = table("bandmodel.csv");
    const std::size_t n = csv.column("n"), m = csv.column("m");
    const std::size_t lo = csv.column("nu_lo"), hi = csv.column("nu_hi");
    const std::size_t ln_c = csv.column("lnC"), a = csv.column("a");
    struct Line {
        std::size_t bin;
        double ln_c, a;
    };
    std::map<std::tuple<Gas, double, double>, std::vector<Line>> groups;
    for (std::size_t row = 0; row < csv.rows.size(); ++row) {
        const double middle = um_of_wavenumber(0.5 * (csv.number(row, lo) + csv.number(row, hi)));
        groups[{gas_named(csv, row), csv.number(row, n), csv.number(row, m)}].push_back(
            {bin_at(tables.edge_um, middle), csv.number(row, ln_c), csv.number(row, a)});
    }
    for (auto& [key, lines] : groups) {
        const auto [gas, pressure, temperature] = key;
        std::sort(lines.begin(), lines.end(),
                  [](const Line& x, const Line& y) { return x.bin < y.bin; });
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (i == 0 || lines[i].bin != lines[i - 1].bin + 1) {
                tables.runs.push_back({tables.groups.size(), lines[i].bin, {}, {}});
            }
            tables.runs.back().ln_c.push_back(lines[i].ln_c);
            tables.runs.back().a.push_back(lines[i].a);
        }
        tables.groups.push_back({gas, pressure, temperature});
    }
}

void load_aerosols(Tables& tables) {
    const CsvTable csv = table("aerosol_shettle_fenn.csv");
    const std::size_t type = csv.column("type"), humidity = csv.column("RH_percent");
    const std::size_t wavelength = csv.column("wavelength_um"), extinction = csv.column("ext");
    std::map<std::string, std::map<double, Spectrum>> curves;
    for (std::size_t row = 0; row < csv.rows.size(); ++row) {
        Spectrum& curve = curves[csv.rows[row][type]][csv.number(row, humidity)];
        curve.wavelength_um.push_back(csv.number(row, wavelength));
        curve.value.push_back(csv.number(row, extinction));
    }
    for (const auto& [name, levels] : curves) {
        for (const auto& [percent, curve] : levels) {
            std::vector<double> ln(tables.bins());
            for (std::size_t bin = 0; bin < ln.size(); ++bin) {
                const double um = std::clamp(tables.middle_um[bin], curve.wavelength_um.front(),
                                             curve.wavelength_um.back());
                ln[bin] = std::log(std::max(curve.at(um), 1e-9));
            }
            tables.aerosols[name].emplace_back(percent, std::move(ln));
        }
    }
}

void load_sun(Tables& tables) {
    const CsvTable csv = table("solar.csv");
    const std::size_t from = csv.column("from_um"), to = csv.column("to_um");
    const std::size_t value = csv.column("irradiance_W_m2_um");
    tables.solar_edge_um.push_back(csv.number(0, from));
    for (std::size_t row = 0; row < csv.rows.size(); ++row) {
        tables.solar_edge_um.push_back(csv.number(row, to));
        tables.solar_W_m2_um.push_back(csv.number(row, value) * (solar_constant / e490_total));
    }
}

}  // namespace

const BandModelTables& band_model_tables() {
    static const Tables tables = [] {
        Tables loaded;
        load_continuum(loaded);
        load_gases(loaded);
        load_aerosols(loaded);
        load_sun(loaded);
        return loaded;
    }();
    return tables;
}

}  // namespace diurna
