#include "materials/atmosphere/atmosphere.hpp"

#include <cmath>

#include "materials/atmosphere/band_model_light.hpp"
#include "materials/atmosphere/solar_spectrum.hpp"
#include "materials/base/quadrature.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

/// Multiplies light by the transmittance of a further line: all that a table of paths can tell.
void send_on(const Atmosphere& atmosphere, const SightLine& onward, std::span<const double> node_um,
             std::vector<double>& light) {
    const PathSpectrum path = path_at_nodes(atmosphere, onward, node_um);
    for (std::size_t i = 0; i < light.size(); ++i) light[i] *= path.transmittance[i];
}

}  // namespace

double air_temperature_at(const Atmosphere& atmosphere, double height_km) {
    if (const auto* model = std::get_if<BandModel>(&atmosphere)) {
        return air_at(model->profile, height_km).temperature;
    }
    if (const auto* known = std::get_if<Tabulated>(&atmosphere)) {
        return air_at(*known->profile, height_km).temperature;
    }
    return std::get<Vacuum>(atmosphere).space_temperature;
}

PathSpectrum path_at_nodes(const Atmosphere& atmosphere, const SightLine& line,
                           std::span<const double> node_um) {
    const bool vacuum = std::holds_alternative<Vacuum>(atmosphere);
    if (vacuum || line.size() == 0 || node_um.empty()) {
        return {std::vector<double>(node_um.size(), 1.0), std::vector<double>(node_um.size(), 0.0)};
    }
    if (const auto* known = std::get_if<Tabulated>(&atmosphere)) {
        return table_path(*known->paths, line.height_within(0, 0.0),
                          line.height_within(line.size() - 1, 1.0), line.range_km(), node_um);
    }
    return band_model_path(std::get<BandModel>(atmosphere), line, node_um);
}

std::vector<double> sky_at_nodes(const Atmosphere& atmosphere, double height_km, double zenith_deg,
                                 std::span<const double> node_um, const SightLine& onward) {
    if (const auto* model = std::get_if<BandModel>(&atmosphere)) {
        return band_model_sky(*model, height_km, zenith_deg, node_um, onward);
    }
    std::vector<double> sky(node_um.size());
    if (const auto* known = std::get_if<Tabulated>(&atmosphere)) {
        const PathSpectrum path = table_sky(*known->paths, height_km, zenith_deg, node_um);
        for (std::size_t i = 0; i < node_um.size(); ++i) {
            const double space = planck(node_um[i], known->space_temperature);
            sky[i] = path.radiance[i] + path.transmittance[i] * space;
        }
        send_on(atmosphere, onward, node_um, sky);
        return sky;
    }
    const double temperature = std::get<Vacuum>(atmosphere).space_temperature;
    for (std::size_t i = 0; i < node_um.size(); ++i) sky[i] = planck(node_um[i], temperature);
    return sky;
}

std::vector<double> mean_sky_at_nodes(const Atmosphere& atmosphere, double height_km,
                                      std::span<const double> node_um, int zenith_angles,
                                      const SightLine& onward) {
    const Quadrature square_of_cosine = gauss_legendre(zenith_angles, 0.0, 1.0);
    std::vector<double> mean(node_um.size(), 0.0);
    for (std::size_t i = 0; i < square_of_cosine.size(); ++i) {
        const double zenith_deg = degrees(std::acos(std::sqrt(square_of_cosine.node[i])));
        const std::vector<double> sky =
            sky_at_nodes(atmosphere, height_km, zenith_deg, node_um, onward);
        for (std::size_t n = 0; n < sky.size(); ++n) {
            mean[n] += square_of_cosine.weight[i] * sky[n];
        }
    }
    return mean;
}

std::vector<double> solar_at_nodes(const Atmosphere& atmosphere, double height_km,
                                   double zenith_deg, double distance_au,
                                   std::span<const double> node_um, const SightLine& onward) {
    std::vector<double> irradiance(node_um.size(), 0.0);
    if (const auto* model = std::get_if<BandModel>(&atmosphere)) {
        irradiance = band_model_sun(*model, height_km, zenith_deg, node_um, onward);
    } else if (!meets_ground(height_km, zenith_deg)) {
        for (std::size_t i = 0; i < node_um.size(); ++i) {
            irradiance[i] = solar_above_air(node_um[i]);
        }
        if (const auto* known = std::get_if<Tabulated>(&atmosphere)) {
            const PathSpectrum path = table_sky(*known->paths, height_km, zenith_deg, node_um);
            for (std::size_t i = 0; i < node_um.size(); ++i) {
                irradiance[i] *= path.transmittance[i];
            }
            send_on(atmosphere, onward, node_um, irradiance);
        }
    }
    for (double& value : irradiance) value /= distance_au * distance_au;
    return irradiance;
}

}  // namespace diurna
