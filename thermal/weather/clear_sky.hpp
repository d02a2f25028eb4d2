#pragma once

#include "materials/air/moist_air.hpp"
#include "terrain/place/sun.hpp"
#include "thermal/weather/separation.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// Longwave of the clear sky from air temperature and vapour pressure near the ground, by name;
/// `none`: no air sends any, under whatever cloud.
enum class LongwaveFormula { dilley_obrien, brutsaert, prata, brunt, idso, swinbank, none };

/// Model of a cloudless sky for sunlight (Bird & Hulstrom 1981; Ineichen & Perez 2002 if a
/// turbidity is given) and the formula for its longwave.
struct ClearSky {
    double aerosol_380nm = 0.15;                  // optical depth
    double aerosol_500nm = 0.10;                  // optical depth
    double ozone_cm = 0.3;                        // [atm cm]
    double precipitable_water_cm = not_measured;  // NaN: from the vapour pressure
    double ground_albedo = 0.2;                   // of the surroundings, for the back-scattered sky
    double linke_turbidity = not_measured;        // at air mass 2; a number chooses Ineichen
    Separation separation = Separation::engerer2;  // for rows of only global sun
    LongwaveFormula longwave = LongwaveFormula::dilley_obrien;
    /// The sky is brighter towards the horizon, which affects tilted facets (sky_shape.hpp).
    bool longwave_by_direction = true;
    /// Nothing between sun and ground: the beam is the solar constant at the sun's distance, and
    /// there is no other light. With LongwaveFormula::none: a vacuum (in_vacuum()).
    bool bare_sun = false;
};
/// The formula beside which measured longwave is put: where there is one, some air sent it.
LongwaveFormula formula_of_measured(const ClearSky& sky);
/// The sky of a place without air: the sun as in space, black and cold all round.
ClearSky in_vacuum(ClearSky sky);

/// Water above the place [cm] from the vapour near the ground, 46.5 e/T (e in hPa; Prata 1996).
double precipitable_water_cm(const AirState& air);

/// Sunlight at one instant.
struct Sunlight {
    double direct_normal;       // [W m⁻²]
    double diffuse_horizontal;  // [W m⁻²]
};

/// Clear-sky sunlight at the ground, Bird & Hulstrom 1981 (SERI/TR-642-761): 5 to 10 % of rigorous
/// codes for known aerosol and water. Zero for a sun at or below the horizon.
///
/// - sun_elevation_deg: refracted
/// - distance_au: of the sun
/// - pressure: [Pa]
/// - water_cm: precipitable [cm]
Sunlight bird_clear_sky(double sun_elevation_deg, double distance_au, double pressure,
                        double water_cm, const ClearSky& sky = {});

/// Clear-sky sunlight after Ineichen & Perez 2002 from Linke's turbidity: for places where only the
/// climate is known. 20 W m⁻² in global and direct if the turbidity is known to 0.2.
Sunlight ineichen_clear_sky(double sun_elevation_deg, double distance_au, double pressure,
                            double elevation, double linke_turbidity);

/// Clear-sky sunlight at an instant by the model of a ClearSky: Bird, or Ineichen if it has a
/// turbidity. `sun` with refraction; zero if the sun is down.
Sunlight clear_sunlight(const SunPosition& sun, const AirState& air, double elevation,
                        const ClearSky& clear);

/// Longwave radiation of a clear sky on the horizontal [W m⁻²], Dilley & O'Brien 1998:
/// 59.38 + 113.7 (T/273.16)⁶ + 96.96 √(w/2.5), w = 4.65 e/T [cm, e in Pa over 10].
/// 7 to 15 W m⁻² rms at six stations from desert to snow.
double clear_longwave(const AirState& air);
/// The same by another formula: Brutsaert 1975, Prata 1996, Brunt 1932 (0.52 + 0.065 √e), Idso
/// 1981, Swinbank 1963. 10 to 35 W m⁻² rms at the same stations.
double clear_longwave(const AirState& air, LongwaveFormula formula);
/// The same under cloud, Crawford & Duchon 1999: c σT⁴ + (1 − c) clear-sky value.
double cloudy_longwave(const AirState& air, double cloud_fraction,
                       LongwaveFormula formula = LongwaveFormula::dilley_obrien);

}  // namespace diurna
