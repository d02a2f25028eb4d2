#include "materials/atmosphere/band_model_tables.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "materials/base/csv.hpp"
#include "materials/base/data_folder.hpp"
#include "materials/base/error.hpp"
#include "materials/base/interval.hpp"
#include "materials/base/monotone_cubic.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/spectrum.hpp"

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
            throw InputError(csv.where(row, hi), "the bins are not contiguous");
        }
        if (tables.edge_um.empty()) tables.edge_um.push_back(edge);
        tables.edge_um.push_back(um_of_wavenumber(low));
        tables.middle_um.push_back(um_of_wavenumber(0.5 * (low + high)));
        for (std::size_t term = 0; term < columns.size(); ++term) {
            tables.linear[term].push_back(csv.number(row, csv.column(columns[term])));
        }
    }
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
            {interval_of(tables.edge_um, middle), csv.number(row, ln_c), csv.number(row, a)});
    }
    for (auto& [key, lines] : groups) {
        const auto [gas, pressure, temperature] = key;
        std::sort(lines.begin(), lines.end(),
                  [](const Line& x, const Line& y) { return x.bin < y.bin; });
        for (std::size_t i = 0; i < lines.size(); ++i) {
            if (i == 0 || lines[i].bin != lines[i - 1].bin + 1) {
                tables.runs.push_back({tables.groups.size(), lines[i].bin, 0, {}, {}});
            }
            tables.runs.back().ln_c.push_back(static_cast<float>(lines[i].ln_c));
            tables.runs.back().a.push_back(static_cast<float>(lines[i].a));
        }
        tables.groups.push_back({gas, pressure, temperature});
    }
    for (Tables::Run& run : tables.runs) {
        run.bins = run.a.size();
        run.ln_c.resize(run.bins + Tables::run_padding, -1e4f);
        run.a.resize(run.bins + Tables::run_padding, 1.0f);
    }
}

/// Values of a curve at the middle of every bin; its first and last value beyond its ends.
std::vector<double> at_bins(const Tables& tables, const Spectrum& curve) {
    std::vector<double> value(tables.bins());
    for (std::size_t bin = 0; bin < value.size(); ++bin) {
        value[bin] = curve.at(std::clamp(tables.middle_um[bin], curve.wavelength_um.front(),
                                         curve.wavelength_um.back()));
    }
    return value;
}

void load_extinction(Tables& tables, const char* file) {
    const CsvTable csv = table(file);
    const std::size_t type = csv.column("type"), humidity = csv.column("RH_percent");
    const std::size_t wavelength = csv.column("wavelength_um");
    const std::size_t extinction = csv.column("ext"), absorption = csv.column("abs");
    std::map<std::string, std::map<double, std::pair<Spectrum, Spectrum>>> curves;
    for (std::size_t row = 0; row < csv.rows.size(); ++row) {
        auto& [ext, abs] = curves[csv.rows[row][type]][csv.number(row, humidity)];
        ext.wavelength_um.push_back(csv.number(row, wavelength));
        ext.value.push_back(csv.number(row, extinction));
        abs.wavelength_um.push_back(csv.number(row, wavelength));
        abs.value.push_back(std::max(0.0, csv.number(row, absorption)));
    }
    for (const auto& [name, levels] : curves) {
        for (const auto& [percent, curve] : levels) {
            std::vector<double> values = at_bins(tables, curve.first), ln;
            for (double& value : values) {
                value = std::max(value, 1e-9);
                ln.push_back(std::log(value));
            }
            tables.aerosols[name].levels.push_back({std::log(100.0 - percent), std::move(ln),
                                                    std::move(values),
                                                    at_bins(tables, curve.second)});
        }
    }
}

/// Extinction between the humidities of the table, for polynomials in ln dryness.
void make_nodes(Tables::Aerosol& aerosol) {
    if (aerosol.levels.size() == 1) aerosol.node = {aerosol.levels[0].extinction};
    for (std::size_t i = 0; i + 1 < aerosol.levels.size(); ++i) {
        const std::vector<double>&from = aerosol.levels[i].ln_extinction,
              &to = aerosol.levels[i + 1].ln_extinction;
        for (std::size_t k = 0; k < Tables::interval_nodes; ++k) {
            const double t = chebyshev_node(k, Tables::interval_nodes);
            std::vector<double>& extinction = aerosol.node.emplace_back();
            for (std::size_t b = 0; b < from.size(); ++b) {
                extinction.push_back(std::exp(from[b] + t * (to[b] - from[b])));
            }
        }
    }
}

void load_asymmetry(Tables& tables) {
    const CsvTable csv = table("aerosol_asymmetry.csv");
    const std::size_t wavelength = csv.column("wavelength_um");
    for (auto& [name, aerosol] : tables.aerosols) {
        const std::size_t column = csv.column(name);
        Spectrum curve;
        for (std::size_t row = 0; row < csv.rows.size(); ++row) {
            curve.wavelength_um.push_back(csv.number(row, wavelength));
            curve.value.push_back(csv.number(row, column));
        }
        aerosol.asymmetry = at_bins(tables, curve);
    }
}

void load_phase(Tables& tables) {
    const CsvTable csv = table("aerosol_phase.csv");
    const std::size_t wavelength = csv.column("wavelength_um"), angle = csv.column("angle_deg");
    for (std::size_t row = 0; row < csv.rows.size(); ++row) {
        const double um = csv.number(row, wavelength);
        if (tables.phase_um.empty() || tables.phase_um.back() != um) tables.phase_um.push_back(um);
        if (tables.phase_um.size() == 1) tables.phase_deg.push_back(csv.number(row, angle));
        for (auto& [name, aerosol] : tables.aerosols) {
            const double value = csv.number(row, csv.column(name));
            aerosol.ln_phase.push_back(std::log(std::max(value, 1e-9)));
        }
    }
    if (csv.rows.size() != tables.phase_um.size() * tables.phase_deg.size()) {
        throw InputError(csv.path.string(), "every wavelength needs the same angles");
    }
    const std::size_t angles = tables.phase_deg.size();
    for (auto& [name, aerosol] : tables.aerosols) {
        for (std::size_t row = 0; row < tables.phase_um.size(); ++row) {
            const auto slopes = monotone_slopes(
                tables.phase_deg, std::span(aerosol.ln_phase).subspan(row * angles, angles));
            aerosol.ln_phase_slope.insert(aerosol.ln_phase_slope.end(), slopes.begin(),
                                          slopes.end());
        }
    }
}

void load_haze(Tables& tables) {
    const CsvTable csv = table("haze_profiles.csv");
    const std::size_t model = csv.column("model"), visibility = csv.column("vis_km");
    const std::array<std::size_t, 4> zone = {csv.column("A1"), csv.column("A2"), csv.column("A3"),
                                             csv.column("A4")};
    for (std::size_t row = 0; row < csv.rows.size(); ++row) {
        const std::string& name = csv.rows[row][model];
        if (name != "2" && name != "3") continue;  // midlatitude summer and winter
        std::vector<Tables::Haze>& season = tables.haze[name == "2" ? 0 : 1];
        const double km = csv.number(row, visibility);
        if (season.empty() || season.back().visibility_km != km) season.push_back({km, {}, {}});
        Tables::Haze& haze = season.back();
        haze.height_km.push_back(csv.number(row, csv.column("z_km")));
        haze.extinction[0].push_back(csv.number(row, zone[0]));
        haze.extinction[1].push_back(csv.number(row, zone[1]));
        haze.extinction[2].push_back(csv.number(row, zone[2]) + csv.number(row, zone[3]));
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

double chebyshev_node(std::size_t k, std::size_t count) {
    return 0.5 - 0.5 * std::cos(std::numbers::pi * (double(k) + 0.5) / double(count));
}

const BandModelTables& band_model_tables() {
    static const Tables tables = [] {
        Tables loaded;
        load_continuum(loaded);
        load_gases(loaded);
        load_extinction(loaded, "aerosol_shettle_fenn.csv");
        load_extinction(loaded, "aerosol_desert.csv");
        for (auto& [name, aerosol] : loaded.aerosols) make_nodes(aerosol);
        load_asymmetry(loaded);
        load_phase(loaded);
        load_haze(loaded);
        load_sun(loaded);
        return loaded;
    }();
    return tables;
}

}  // namespace diurna
