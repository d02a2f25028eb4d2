#pragma once

#include <Eigen/Core>
#include <vector>

#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "terrain/place/sun.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// Longwave of the clear sky from air temperature and vapour pressure near the ground, by name.
enum class LongwaveFormula { dilley_obrien, brutsaert, prata, brunt, idso, swinbank };

/// What a cloudless sky does to sunlight (Bird & Hulstrom 1981; Ineichen & Perez 2002 where a
/// turbidity is given) and which formula stands for its longwave.
struct ClearSky {
    double aerosol_380nm = 0.15;                  // optical depth
    double aerosol_500nm = 0.10;                  // optical depth
    double ozone_cm = 0.3;                        // [atm cm]
    double precipitable_water_cm = not_measured;  // NaN: from the vapour pressure, 46.5 e/T
    double ground_albedo = 0.2;                   // of the surroundings, for the back-scattered sky
    double linke_turbidity = not_measured;        // at air mass 2; a number chooses Ineichen
    LongwaveFormula longwave = LongwaveFormula::dilley_obrien;
    /// The sky is brighter towards the horizon, which tilted facets see (tilted_sky_excess).
    bool longwave_by_direction = true;
};

struct ClearSun {
    double direct_normal;       // [W m⁻²]
    double diffuse_horizontal;  // [W m⁻²]
};

/// Clear-sky sunlight at the ground, Bird & Hulstrom 1981 (SERI/TR-642-761): 5 to 10 % of rigorous
/// codes for known aerosol and water. Zero for a sun at or below the horizon.
///
/// sun_elevation_deg  refracted          distance_au  sun
/// pressure           [Pa]               water_cm     precipitable [cm]
ClearSun bird_clear_sky(double sun_elevation_deg, double distance_au, double pressure,
                        double water_cm, const ClearSky& sky = {});

/// Clear-sky sunlight after Ineichen & Perez 2002 from Linke's turbidity: where only the climate of
/// a place is known. 20 W m⁻² in global and direct with the turbidity known to 0.2.
ClearSun ineichen_clear_sky(double sun_elevation_deg, double distance_au, double pressure,
                            double elevation, double linke_turbidity);

/// Longwave radiation of a clear sky on the horizontal [W m⁻²], Dilley & O'Brien 1998:
/// 59.38 + 113.7 (T/273.16)⁶ + 96.96 √(w/2.5), w = 4.65 e/T [cm, e in Pa over 10].
/// 7 to 15 W m⁻² rms at six stations from desert to snow.
double clear_longwave(const AirState& air);
/// The same by another formula: Brutsaert 1975, Prata 1996, Brunt 1932 (0.52 + 0.065 √e), Idso
/// 1981, Swinbank 1963. 10 to 35 W m⁻² rms at the same stations.
double clear_longwave(const AirState& air, LongwaveFormula formula);
/// The same under cloud, Crawford & Duchon 1999: c σT⁴ + (1 − c) clear.
double cloudy_longwave(const AirState& air, double cloud_fraction,
                       LongwaveFormula formula = LongwaveFormula::dilley_obrien);
/// What a facet tilted by `slope` [rad] receives from the part of the sky it sees, beyond its sky
/// view times the horizontal's flux, per σT⁴ of the air. The clear sky's emissivity grows towards
/// the horizon as ε(z) = ε + b (ln sec z − ½), b = 0.09 (Unsworth & Monteith 1975, Q. J. R.
/// Meteorol. Soc. 101, 13). Where terrain hides more than the facet's own tilt, it hides the
/// horizon first: a ring of one height all around. Zero for a level facet under the whole sky,
/// ½ b (1 − V) ln(1 − V) for one that sees V, ½ b ln 2 = 0.031 for a wall (12 W/m²).
double tilted_sky_excess(double slope, double sky_view = 1.0);

/// The same for many facets, from a table: within 1e-4 of it.
class TiltedSky {
 public:
    TiltedSky();
    double excess(double up_cosine, double sky_view) const;

 private:
    struct Tilt {
        std::vector<double> view, excess;  // (ring) up to there from the zenith
    };
    static Tilt tilt_of(double slope);
    static double at(const Tilt& tilt, double share);
    friend double tilted_sky_excess(double slope, double sky_view);
    std::vector<Tilt> tilt_;  // every two degrees from 0 to 180
};

/// Diffuse share of global sunlight from the clearness index kt, Erbs et al. 1982.
double erbs_diffuse_share(double clearness);

/// The sky over the whole scene at one instant.
struct SkyState {
    SunPosition sun;
    Eigen::Vector3d to_sun;                // unit, east-north-up
    double direct_normal = 0.0;            // beam on a plane facing the sun [W m⁻²]
    double diffuse_horizontal = 0;         // [W m⁻²]
    double anisotropy = 0.0;               // Hay & Davies: direct over extraterrestrial, 0 to 1
    double longwave_down = 0.0;            // on the horizontal [W m⁻²]
    double tilted_longwave = 0.0;          // what tilted_sky_excess multiplies [W m⁻²]
    double albedo = not_measured;          // measured up over down, replaces the material's
    double plane_of_array = not_measured;  // measured on the facet, replaces the transposition

    double global_horizontal() const;
};

/// Measured fluxes where there are any, the clear sky and its cloud elsewhere. Measured global sun
/// alone is split by the clearness index; global, direct and diffuse together are made consistent
/// with the global. Cloud without measured sun takes Kasten & Czeplak's 1 − 0.75 c³·⁴.
SkyState sky_state(const Site& site, double elevation, Instant instant, const Forcing& forcing,
                   const ClearSky& clear = {});
/// The same for a sun whose place, without refraction, is known.
SkyState sky_state(const SunPosition& geometric, double elevation, const Forcing& forcing,
                   const ClearSky& clear = {});

/// Fills the cloud fraction, where it is absent, from measured over clear-sky global sun
/// (Crawford & Duchon: c = 1 − G/G_clear) for a sun above 8°, and holds the last daylight value
/// through the night. For series whose longwave is not measured.
void infer_cloud(Weather& weather, const Site& site, double elevation, const ClearSky& clear = {});

/// Sunlight on a facet [W m⁻²] without what other facets reflect, Hay & Davies 1980: the beam and
/// the circumsolar part of the diffuse light come from the sun's direction and share its shadow,
/// the rest comes evenly from the sky in view.
///
/// sun_cosine    normal · to_sun         sun_fraction  0 to 1, share of facet and disc not in
/// shadow sky_view      0 to 1, cosine-weighted
double facet_sunlight(const SkyState& sky, double sun_cosine, double sun_fraction, double sky_view);

}  // namespace diurna
