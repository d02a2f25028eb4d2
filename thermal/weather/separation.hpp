#pragma once

namespace diurna {

/// Models that divide global sunlight into direct and diffuse if only global was measured.
enum class Separation { engerer2, erbs };

/// Inputs of a separation model for an interval; means weighted by the sunlight above the air.
struct SeparationCase {
    double clearness;          // global over that above the air, both on the horizontal
    double minutes = 60.0;     // of the interval
    double zenith_deg = 0.0;   // of the sun, mean
    double solar_hour = 12.0;  // apparent solar time
    double day_of_year = 1.0;
    double top = 1361.0;  // [W m⁻²] above the air on a plane facing the sun
};

/// Diffuse share of global sunlight from the clearness index only, hourly, Erbs et al. 1982 (Solar
/// Energy 28, 293).
double erbs_diffuse_share(double clearness);

/// Diffuse share by Engerer2 (Engerer 2015, Solar Energy 116, 215) with the parameters of Bright &
/// Engerer 2019 (J. Renewable Sustainable Energy 11, 033701) for the averaging period nearest to
/// `minutes` among 1, 5, 10, 15, 30, 60 and 1440, and the clear sky it was fitted with (Threlkeld
/// & Jordan). Over 75 stations they give an rms of 12 to 17 % in the share, lower than Erbs's.
double engerer2_diffuse_share(const SeparationCase& given);

double diffuse_share(Separation model, const SeparationCase& given);

}  // namespace diurna
