#include "materials/atmosphere/ground_sky.hpp"

#include <cmath>
#include <numbers>

#include "materials/atmosphere/band_model_light.hpp"
#include "materials/atmosphere/ground_fluxes.hpp"
#include "materials/base/quadrature.hpp"
#include "materials/base/units.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

GroundSky::GroundSky(const BandModel& model, double height_km)
    : overcast_(model), height_km_(height_km) {
    const Band& band = longwave_band();
    const Quadrature square_of_cosine = gauss_legendre(int(angles), 0.0, 1.0);
    BandModel own = model;
    own.scale.sky_column = own.scale.sky_heat = 1.0;
    overcast_ = own;
    own.cloud.emissivity = 0.0;
    overcast_.cloud.fraction = overcast_.cloud.emissivity = 1.0;
    for (std::size_t a = 0; a < angles; ++a) {
        zenith_deg_[a] = degrees(std::acos(std::sqrt(square_of_cosine.node[a])));
        weight_[a] = square_of_cosine.weight[a];
        ends_on_ground_[a] = ends_on_ground(model, height_km, zenith_deg_[a]);
        clear_[a] = band_model_sky(own, height_km, zenith_deg_[a], band.node_um);
    }
    const double warm = air_at(model.profile, height_km).temperature;
    for (const double um : band.node_um) black_here_.push_back(planck(um, warm));
}

void GroundSky::follow_covered() {
    for (std::size_t a = 0; a < angles; ++a) {
        covered_[a] =
            band_model_sky(overcast_, height_km_, zenith_deg_[a], longwave_band().node_um);
    }
}

double GroundSky::longwave(double black_share, const LightScale& scale) {
    if (black_share > 0.0 && covered_[0].empty()) follow_covered();
    const Band& band = longwave_band();
    const bool own = scale.sky_column == 1.0 && scale.sky_heat == 1.0;
    std::vector<double> mean(black_here_.size(), 0.0);
    for (std::size_t n = 0; n < mean.size(); ++n) {
        if (band.node_um[n] > black_air_um) {
            mean[n] = black_here_[n];
            continue;
        }
        for (std::size_t a = 0; a < angles; ++a) {
            double sky = clear_[a][n];
            if (black_share > 0.0) sky = std::lerp(sky, covered_[a][n], black_share);
            if (!own && !ends_on_ground_[a]) sky = scaled_sky(scale, sky, black_here_[n]);
            mean[n] += weight_[a] * sky;
        }
    }
    return std::numbers::pi * band_sum_nodes(band, mean);
}

}  // namespace diurna
