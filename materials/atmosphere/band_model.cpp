#include "materials/atmosphere/band_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>

#include "materials/atmosphere/band_model_tables.hpp"
#include "materials/atmosphere/medium.hpp"
#include "materials/base/error.hpp"

namespace diurna {

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
    within("ground_km", model.ground_km, -0.5, 5.5);
    within("rain_mm_h", model.rain_mm_h, 0.0, 300.0);
    within("rain_top_km", model.rain_top_km, 0.0, 10.0);
    within("cloud.fraction", model.cloud.fraction, 0.0, 1.0);
    within("cloud.base_km", model.cloud.base_km, -0.5, 20.0);
    within("cloud.temperature", model.cloud.temperature, 0.0, 400.0);
    within("cloud.optical_depth", model.cloud.optical_depth, 0.0, 1000.0);
    within("cloud.emissivity", model.cloud.emissivity, 0.0, 1.0);
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
    assert(line.height_km.size() == line.length_km.size() && bins.last <= bin_count());
    CumulativeTransmittance result{.bins = bins, .temperature = {}, .transmittance = {}};
    result.temperature.resize(line.size());
    result.transmittance.resize(line.size() * bins.size());
    const Medium medium(model, bins);
    Amounts amounts = medium.none();
    for (std::size_t i = 0; i < line.size(); ++i) {
        result.temperature[i] =
            pressure_and_temperature_at(model.profile, line.height_km[i]).second;
        medium.add(line, i, amounts);
        medium.spread(amounts);
        medium.transmittances(
            amounts, std::span(result.transmittance).subspan(i * bins.size(), bins.size()));
    }
    return result;
}

std::vector<double> transmittance(const BandModel& model, const SightLine& line, BinRange bins) {
    const Medium medium(model, bins);
    Amounts amounts = medium.none();
    for (std::size_t i = 0; i < line.size(); ++i) {
        medium.add(line, i, amounts);
    }
    medium.spread(amounts);
    std::vector<double> result(bins.size(), 1.0);
    if (line.size() > 0) medium.transmittances(amounts, result);
    return result;
}

double solar_above_air(double wavelength_um) {
    const BandModelTables& tables = band_model_tables();
    const std::vector<double>& edges = tables.solar_edge_um;
    const auto above = std::upper_bound(edges.begin() + 1, edges.end() - 1, wavelength_um);
    return tables.solar_W_m2_um[static_cast<std::size_t>(above - edges.begin()) - 1];
}

}  // namespace diurna
