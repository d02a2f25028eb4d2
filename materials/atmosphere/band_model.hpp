#pragma once

#include <limits>
#include <string>
#include <vector>

#include "materials/air/profile.hpp"
#include "materials/air/sight_line.hpp"

namespace diurna {

/// Carbon dioxide of the years 2024-26 (NOAA's global mean, rounded).
inline constexpr double todays_co2_ppm = 425.0;

/// One level layer of cloud over part of the sky. From below it is black or grey at the temperature
/// of its base and dims the sun by its optical depth; from above it has the temperature of its top
/// and reflects sunlight; between an observer and the ground its covered part hides the ground.
/// Covered and open parts are independent columns, in the same proportion at every angle. An
/// observer within the layer sees everything else through it.
struct CloudLayer {
    double fraction = 0.0;        // of the sky, 0 to 1
    double base_km = 2.0;         // above the sea
    double depth_km = 0.3;        // from base to top
    double temperature = 0.0;     // [K] of base and top; 0: that of the air there
    double optical_depth = 20.0;  // at all wavelengths of sunlight, 0 to 1000
    double emissivity = 1.0;      // in the thermal bands
    /// Part of the sky whose sunlight it takes; below 0: `fraction`. The sides of broken cloud are
    /// seen too, so it covers more sky than it shades (cloud_modification.hpp).
    double sunlit_fraction = -1.0;

    double top_km() const { return base_km + depth_km; }
    double over_sun() const { return sunlit_fraction < 0.0 ? fraction : sunlit_fraction; }
};

/// Ratios of measured to modelled light: factors that make the model's broadband sums equal to the
/// measured ones (light_of_instant.hpp). All 1: the unscaled model.
struct LightScale {
    double beam = 1.0;        // of the sun; below the cloud, if there is one
    double diffuse = 1.0;     // of scattered sunlight, below the cloud too
    double sky_column = 1.0;  // factor on the emitting column between the ground and space
    double sky_heat = 1.0;    // grey factor on the sky's thermal radiance: the rest
};

/// The embedded band model: seven gases, water and nitrogen continua, Rayleigh extinction, ozone's
/// visible bands, nitric acid, aerosol and rain on 433 bins of 25 to 200 cm⁻¹.
///
/// Per gas and bin τ = exp(−(C·W)^a), W = Σ u (P/P₀)ⁿ (T₀/T)ᵐ ds; continua are linear in their
/// amounts. Aerosol follows Shettle and Fenn's extinction by local humidity; at 0.55 µm it is
/// ln 50 / visibility − 0.01159 km⁻¹ at the ground and has LOWTRAN7's profile above it: the chosen
/// type below 2 km, fading to tropospheric aerosol at 3 km; dry tropospheric aerosol is used for
/// the stratosphere too (optical depth below 0.01). Rain: 0.365 R^0.63 km⁻¹ at all wavelengths
/// (LOWTRAN7), from the ground to `rain_top_km`. Below 5000 cm⁻¹ calibrated to MODTRAN 5, above to
/// LOWTRAN7. Tables and their origin: data_folder()/atmosphere/SOURCE.md.
///
/// Extinction includes scattering (no scattered light returns to the beam): transmittance and
/// direct sun are right; scattered sunlight is computed by SunField (sun_field.hpp).
struct BandModel {
    Profile profile;
    std::string aerosol = "none";      // or one of aerosol_names()
    double visibility_km = 23.0;       // 0.05 to 300
    double co2_ppm = todays_co2_ppm;   // at the lowest level; the whole profile is scaled to it
    double space_temperature = 2.725;  // [K] behind the air
    double ground_km = 0.0;            // where the haze begins; its lowest 6 km are compressed
    double rain_mm_h = 0.0;            // 0 to 300
    double rain_top_km = 3.0;          // above `ground_km`
    CloudLayer cloud = {};
    LightScale scale = {};
    bool refraction = true;  // bends lines to the sky and the sun
};

/// none, rural, maritime, urban, tropospheric, desert, fog_advective, fog_radiative: allowed values
/// of `BandModel::aerosol`.
std::vector<std::string> aerosol_names();

/// Throws InputError if a value is out of range, the aerosol unknown or the profile unusable.
void check(const BandModel& model);

/// Lines from a height as the model's air bends them, or straight if it has no refraction.
SightLine line_of(const BandModel& model, double height_km, double zenith_deg,
                  double range_km = std::numeric_limits<double>::infinity(),
                  const Segmentation& segmentation = {});
bool ends_on_ground(const BandModel& model, double height_km, double zenith_deg);

}  // namespace diurna
