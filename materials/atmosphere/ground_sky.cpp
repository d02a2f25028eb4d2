#include "materials/atmosphere/ground_sky.hpp"

#include <cmath>
#include <numbers>

#include "materials/atmosphere/band_model_light.hpp"
#include "materials/atmosphere/ground_fluxes.hpp"
#include "materials/base/quadrature.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

GroundSky::GroundSky(const BandModel& model, double height_km) {
    const Band& band = longwave_band();
    const Quadrature square_of_cosine = gauss_legendre(int(angles), 0.0, 1.0);
    BandModel own = model;
    own.scale.sky_column = own.scale.sky_heat = 1.0;
    BandModel overcast = own;
    own.cloud.emissivity = 0.0;
    overcast.cloud.fraction = overcast.cloud.emissivity = 1.0;
    for (std::size_t a = 0; a < angles; ++a) {
        const double zenith_deg = degrees(std::acos(std::sqrt(square_of_cosine.node[a])));
        weight_[a] = square_of_cosine.weight[a];
        ends_on_ground_[a] = ends_on_ground(model, height_km, zenith_deg);
        clear_[a] = band_model_sky(own, height_km, zenith_deg, band.node_um);
        covered_[a] = band_model_sky(overcast, height_km, zenith_deg, band.node_um);
    }
    const double warm = air_at(model.profile, height_km).temperature;
    for (const double um : band.node_um) black_here_.push_back(planck(um, warm));
}

double GroundSky::longwave(double black_share, const LightScale& scale) const {
    const Band& band = longwave_band();
    const bool own = scale.sky_column == 1.0 && scale.sky_heat == 1.0;
    std::vector<double> mean(black_here_.size(), 0.0);
    for (std::size_t n = 0; n < mean.size(); ++n) {
        if (band.node_um[n] > black_air_um) {
            mean[n] = black_here_[n];
            continue;
        }
        for (std::size_t a = 0; a < angles; ++a) {
            double sky = std::lerp(clear_[a][n], covered_[a][n], black_share);
            if (!own && !ends_on_ground_[a]) sky = scaled_sky(scale, sky, black_here_[n]);
            mean[n] += weight_[a] * sky;
        }
    }
    return std::numbers::pi * band_sum_nodes(band, mean);
}

}  // namespace diurna
