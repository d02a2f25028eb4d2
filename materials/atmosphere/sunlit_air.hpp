#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "materials/atmosphere/band_model.hpp"
#include "materials/atmosphere/bins.hpp"
#include "materials/atmosphere/level_curves.hpp"
#include "materials/atmosphere/medium.hpp"
#include "materials/atmosphere/moonlight.hpp"

namespace diurna {

/// The sun's light on a scene's air and ground.
struct SunLight {
    double zenith_deg = 180.0;  // at the ground, as seen through the air
    double distance_au = 1.0;
    double ground_albedo = 0.2;  // of the surrounding land, at every wavelength
    /// The moon replaces the sun at that zenith angle; the distance is then 1 au.
    std::optional<MoonLight> moon{};
};

/// Cloud drops: mean cosine of their scattering, and the share of scattering in the peak.
inline constexpr double cloud_asymmetry = 0.85;
inline constexpr double cloud_peak = cloud_asymmetry * cloud_asymmetry;

/// Diffuse fluxes of sunlight [W m⁻² µm⁻¹] at each level, (bin).
struct DiffuseField {
    LevelCurves up, down;
};

/// What the plane layers between levels hold, and the beam at their edges, without cloud: two
/// streams of any cloud follow from it.
struct LitLayers {
    struct Content {
        double depth;       // optical
        double scattering;  // optical depth of it
        double asymmetry;
    };
    std::vector<std::vector<Content>> content;  // (layer, from the ground up)(bin)
    std::vector<std::vector<double>> beam;      // (level)(bin)
};

/// Sunlight by height, per bin: what the beam has passed, and what two streams carry of the
/// light it lost. All that a SunField keeps.
struct SunlitAir {
    BandModel model;
    SunLight sun;
    BinRange bins;
    std::vector<std::size_t> node_bin;  // counted from the first of the range
    std::vector<double> node_share;     // irradiance at the node over the bin's mean
    std::vector<double> above_air;  // (bin) irradiance [W m⁻² µm⁻¹] at the sun's distance
    std::vector<double> level;      // [km], ascending
    std::vector<bool> lit;          // (level)
    /// Amounts along the path to the sun: logarithms of gases, then of the linear terms; optical
    /// depths (bin) of scaled aerosol, and the depth removed by scaling. Levels without direct sun
    /// have the values of the lowest level with it.
    LevelCurves ln_amount, aerosol, peak;
    DiffuseField clear, cloudy;  // under a sky without and with cloud; the latter empty: none
    std::shared_ptr<const LitLayers> layers;
    double beam_through_cloud = 1.0;
    double cosine = 0.0;  // of the sun's zenith angle

    HermiteWeights at_height(double height_km) const { return hermite_weights(level, height_km); }
    bool sun_reaches(const HermiteWeights& w) const {
        return lit[w.low + 1] && (lit[w.low] || w.t >= 0.5);
    }
    std::vector<double> per_node(const std::vector<double>& per_bin) const;
};

/// Throws InputError for a sun or a model out of range.
SunlitAir sunlit_air(const BandModel& model, const SunLight& sun, std::span<const double> node_um);

/// The same air and sun under another cloud.
SunlitAir sunlit_air_under(SunlitAir air, const CloudLayer& cloud);

/// What the beam has passed above a height.
Amounts amounts_to_sun(const SunlitAir& air, const Medium& medium, const HermiteWeights& height);

}  // namespace diurna
