#include "materials/band_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>

#include "materials/band_model_tables.hpp"
#include "materials/error.hpp"
#include "materials/fast_exp.hpp"
#include "materials/units.hpp"

namespace diurna {

namespace {

using Tables = BandModelTables;

constexpr double standard_pressure_hPa = 1013.25;
constexpr double standard_temperature = 273.15;

/// What a sight line has met so far; optical depth follows from it alone.
struct Amounts {
    std::vector<std::size_t> active;  // groups that absorb in the bins asked for
    std::vector<double> gas;          // (group) W, of the active ones
    std::array<double, Tables::linear_count> linear{};
    double aerosol = 0.0;  // optical depth at 0.55 µm
};

/// Relative humidity [%] by LOWTRAN's formula: absolute humidity over its saturation [g m⁻³].
double relative_humidity(const AirSample& air) {
    const double vapour_hPa =
        air.pressure_hPa * air.mixing_ratio_ppm[static_cast<std::size_t>(Gas::water)] * 1e-6;
    const double a = standard_temperature / air.temperature;
    const double saturated = a * std::exp(18.9766 - 14.9595 * a - 2.43882 * a * a);
    return 100.0 * (vapour_hPa * 1e5 / (461.5 * air.temperature)) / saturated;
}

void add_segment(const Tables& tables, const BandModel& model, const AirSample& air,
                 double height_km, double length_km, double co2_scale, Amounts& amounts) {
    const double pressure = air.pressure_hPa / standard_pressure_hPa;
    const double temperature = standard_temperature / air.temperature;
    const double amagat = pressure * temperature;  // density over that at 0 °C, 1 atm

    std::array<double, gas_count> amount;  // [cm at STP], water [g cm⁻²]
    for (std::size_t gas = 0; gas < gas_count; ++gas) {
        amount[gas] = 1e5 * amagat * air.mixing_ratio_ppm[gas] * 1e-6 * length_km;
    }
    const auto of = [&](Gas gas) -> double& { return amount[static_cast<std::size_t>(gas)]; };
    of(Gas::carbon_dioxide) *= co2_scale;
    const double water_cm = of(Gas::water);
    constexpr double loschmidt = 2.68675e19, avogadro = 6.022045e23, water_molar_mass = 18.015;
    of(Gas::water) *= loschmidt / avogadro * water_molar_mass;

    const double ln_pressure = std::log(pressure), ln_temperature = std::log(temperature);
    for (const std::size_t i : amounts.active) {
        const auto& [gas, n, m] = tables.groups[i];
        amounts.gas[i] += of(gas) * fast_exp(n * ln_pressure + m * ln_temperature);
    }

    const double molecules = water_cm * loschmidt * 1e-20;  // [1e20 cm⁻²]
    const double vapour_hPa =
        air.pressure_hPa * air.mixing_ratio_ppm[static_cast<std::size_t>(Gas::water)] * 1e-6;
    const double reference = 296.0 / air.temperature / standard_pressure_hPa;
    const double self = molecules * vapour_hPa * reference;
    const double foreign = molecules * (air.pressure_hPa - vapour_hPa) * reference;
    const double colder = std::clamp((296.0 - air.temperature) / 36.0, 0.0, 1.0);
    const std::array<double, Tables::linear_count> linear = {
        self,
        self * colder,
        foreign,
        0.781 * amagat * pressure * std::sqrt(temperature) * length_km,
        amagat * length_km,
        of(Gas::ozone),
        of(Gas::nitric_acid)};
    for (std::size_t i = 0; i < linear.size(); ++i) amounts.linear[i] += linear[i];

    if (model.aerosol != "none" && height_km < aerosol_top_km) {
        // Koschmieder: contrast falls to 2 % at the visibility; the air's own part taken off.
        amounts.aerosol +=
            std::max(0.0, std::log(50.0) / model.visibility_km - 0.01159) * length_km;
    }
}

/// Extinction relative to 0.55 µm; its logarithm is linear in that of the dryness 100 − RH.
std::vector<double> aerosol_shape(const Tables& tables, const BandModel& model, BinRange bins,
                                  double humidity) {
    const Tables::AerosolLevels& levels = tables.aerosols.at(model.aerosol);
    const double dryness = std::log(100.0 - std::clamp(humidity, 0.0, 99.0));
    std::size_t upper = 0;
    while (upper < levels.size() && std::log(100.0 - levels[upper].first) > dryness) ++upper;
    const std::size_t b = std::min(upper, levels.size() - 1), a = upper > 0 ? upper - 1 : 0;
    double t = 0.0;
    if (a != b) {
        const double from = std::log(100.0 - levels[a].first);
        t = (dryness - from) / (std::log(100.0 - levels[b].first) - from);
    }
    std::vector<double> shape(bins.size());
    for (std::size_t i = 0; i < shape.size(); ++i) {
        const double low = levels[a].second[bins.first + i],
                     high = levels[b].second[bins.first + i];
        shape[i] = fast_exp(low + t * (high - low));
    }
    return shape;
}

/// Optical depth, then transmittance, of every bin for the amounts met.
void transmittances(const Tables& tables, const Amounts& amounts, BinRange bins,
                    std::span<const double> shape, std::span<double> out) {
    const std::array<const double*, Tables::linear_count> k = {
        tables.linear[0].data() + bins.first, tables.linear[1].data() + bins.first,
        tables.linear[2].data() + bins.first, tables.linear[3].data() + bins.first,
        tables.linear[4].data() + bins.first, tables.linear[5].data() + bins.first,
        tables.linear[6].data() + bins.first};
    const std::array<double, Tables::linear_count> w = amounts.linear;
    const std::size_t count = bins.size();
#pragma omp simd
    for (std::size_t i = 0; i < count; ++i) {
        out[i] = w[0] * k[0][i] + w[1] * k[1][i] + w[2] * k[2][i] + w[3] * k[3][i] +
                 w[4] * k[4][i] + w[5] * k[5][i] + w[6] * k[6][i];
    }
    if (!shape.empty()) {
#pragma omp simd
        for (std::size_t i = 0; i < count; ++i) out[i] += amounts.aerosol * shape[i];
    }
    std::vector<double> ln_w(amounts.gas.size());
    for (const std::size_t i : amounts.active) ln_w[i] = std::log(amounts.gas[i] + 1e-300);
    for (const Tables::Run& run : tables.runs) {
        const std::size_t from = std::max(run.first, bins.first);
        const std::size_t to = std::min(run.first + run.a.size(), bins.last);
        if (from >= to) continue;
        const double* const ln_c = run.ln_c.data() + (from - run.first);
        const double* const a = run.a.data() + (from - run.first);
        double* const depth = out.data() + (from - bins.first);
        const double ln_amount = ln_w[run.group];
#pragma omp simd
        for (std::size_t i = 0; i < to - from; ++i) {
            depth[i] += fast_exp(std::clamp(a[i] * (ln_c[i] + ln_amount), -60.0, 6.0));
        }
    }
#pragma omp simd
    for (std::size_t i = 0; i < count; ++i) out[i] = fast_exp(-out[i]);
}

/// The walk both public forms share: `at_end(segment, amounts)` after each segment.
template <class AtEnd>
std::vector<double> walk(const Tables& tables, const BandModel& model, const SightLine& line,
                         BinRange bins, AtEnd&& at_end) {
    assert(line.height_km.size() == line.length_km.size() && bins.last <= tables.bins());
    constexpr auto carbon_dioxide = static_cast<std::size_t>(Gas::carbon_dioxide);
    const double profile_co2 = model.profile.mixing_ratio_ppm[carbon_dioxide].front();
    const double co2_scale = profile_co2 > 0.0 ? model.co2_ppm / profile_co2 : 0.0;
    std::vector<double> shape;
    if (model.aerosol != "none" && line.size() > 0) {
        const double lowest = *std::min_element(line.height_km.begin(), line.height_km.end());
        shape =
            aerosol_shape(tables, model, bins, relative_humidity(air_at(model.profile, lowest)));
    }
    Amounts amounts;
    amounts.gas.assign(tables.groups.size(), 0.0);
    for (const Tables::Run& run : tables.runs) {  // runs stand in the order of their groups
        const bool absorbs = run.first < bins.last && run.first + run.a.size() > bins.first;
        const bool listed = !amounts.active.empty() && amounts.active.back() == run.group;
        if (absorbs && !listed) amounts.active.push_back(run.group);
    }
    std::vector<double> temperature(line.size());
    for (std::size_t i = 0; i < line.size(); ++i) {
        const AirSample air = air_at(model.profile, line.height_km[i]);
        temperature[i] = air.temperature;
        add_segment(tables, model, air, line.height_km[i], line.length_km[i], co2_scale, amounts);
        at_end(i, amounts, std::span<const double>(shape));
    }
    return temperature;
}

}  // namespace

std::vector<std::string> aerosol_names() {
    std::vector<std::string> names = {"none"};
    for (const auto& [name, levels] : band_model_tables().aerosols) names.push_back(name);
    return names;
}

void check(const BandModel& model) {
    check(model.profile);
    const std::vector<std::string> names = aerosol_names();
    if (std::find(names.begin(), names.end(), model.aerosol) == names.end()) {
        throw InputError("aerosol",
                         fmt::format("found '{}', expected one of {}", model.aerosol.substr(0, 40),
                                     fmt::join(names, " ")),
                         did_you_mean(model.aerosol, names));
    }
    const auto within = [](const char* what, double value, double least, double most) {
        if (value >= least && value <= most) return;
        throw InputError(what,
                         fmt::format("found {:g}, expected {:g} to {:g}", value, least, most));
    };
    within("visibility_km", model.visibility_km, 0.05, 300.0);
    within("co2_ppm", model.co2_ppm, 0.0, 10000.0);
    within("space_temperature", model.space_temperature, 0.0, 10000.0);
}

std::span<const double> bin_edges_um() { return band_model_tables().edge_um; }

std::size_t bin_of(double wavelength_um) {
    const std::vector<double>& edges = band_model_tables().edge_um;
    const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, wavelength_um);
    return static_cast<std::size_t>(above - edges.begin()) - 1;
}

BinRange all_bins() { return {0, bin_count()}; }

BinRange bins_of(std::span<const double> wavelengths_um) {
    if (wavelengths_um.empty()) return {};
    const auto [least, most] = std::minmax_element(wavelengths_um.begin(), wavelengths_um.end());
    return {bin_of(*least), bin_of(*most) + 1};
}

CumulativeTransmittance cumulative_transmittance(const BandModel& model, const SightLine& line,
                                                 BinRange bins) {
    const Tables& tables = band_model_tables();
    CumulativeTransmittance result{.bins = bins, .temperature = {}, .transmittance = {}};
    result.transmittance.resize(line.size() * bins.size());
    result.temperature = walk(
        tables, model, line, bins,
        [&](std::size_t i, const Amounts& amounts, std::span<const double> shape) {
            transmittances(tables, amounts, bins, shape,
                           std::span(result.transmittance).subspan(i * bins.size(), bins.size()));
        });
    return result;
}

std::vector<double> transmittance(const BandModel& model, const SightLine& line, BinRange bins) {
    const Tables& tables = band_model_tables();
    std::vector<double> result(bins.size(), 1.0);
    walk(tables, model, line, bins,
         [&](std::size_t i, const Amounts& amounts, std::span<const double> shape) {
             if (i + 1 == line.size()) transmittances(tables, amounts, bins, shape, result);
         });
    return result;
}

double solar_above_air(double wavelength_um) {
    const Tables& tables = band_model_tables();
    const std::vector<double>& edges = tables.solar_edge_um;
    const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, wavelength_um);
    return tables.solar_W_m2_um[static_cast<std::size_t>(above - edges.begin()) - 1];
}

}  // namespace diurna
