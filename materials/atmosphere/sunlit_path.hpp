#pragma once

#include <span>
#include <vector>

#include "materials/air/sight_line.hpp"
#include "materials/atmosphere/sunlit_air.hpp"

namespace diurna {

/// Cosines of the scattering angles of sunlight on a line, (azimuth): light travels away from the
/// sun and on towards the observer, so the scattering angle is that between the directions of the
/// sun and of the line.
std::vector<double> turns(const SunLight& sun, double zenith_deg,
                          std::span<const double> azimuth_from_sun_deg);

/// Sunlight scattered into a line, per bin: at_turn[k] + cos(zenith) · by_cosine
/// [W m⁻² sr⁻¹ µm⁻¹].
struct ScatteredLight {
    std::vector<std::vector<double>> at_turn;  // (turn)(bin)
    std::vector<double> by_cosine;             // (bin)

    std::vector<double> towards(std::size_t turn, double cosine) const;
    void scale(double factor);
    /// Mixes in a share of another light.
    void mix(double share, const ScatteredLight& other);
};

/// Without cloud, or entirely below it.
///
/// something_behind  the caller adds what is behind the line's end, times its transmittance
/// onward            path from an observer to a mirror at the line's start: returns the part of
///                   the light that arrives at the observer, in addition to the light that path
///                   scatters itself with something behind its end
ScatteredLight scattered_light(const SunlitAir& air, const SightLine& line,
                               std::span<const double> turn, bool under_cloud,
                               bool something_behind, const SightLine& onward = {});
/// Mean of the parts of the sky without and with cloud, with something behind; scaled as the model
/// says where the line starts below the cloud. Where the line falls through the cloud the covered
/// part has the cloud's lit top, where it rises through it the cloud's base.
ScatteredLight scattered_light(const SunlitAir& air, const SightLine& line,
                               std::span<const double> turn, const SightLine& onward = {});

/// Where in the fluxes under cloud a height is: up to the cloud's top below the layer of air that
/// holds the drops, from there on above it.
HermiteWeights in_clouded_air(const SunlitAir& air, double height_km);

/// Radiance of a cloud's base over its mean, under a cosine of the zenith angle: thick cloud shines
/// as 1 + 2 cos z (Moon & Spencer 1942), thin cloud evenly.
double base_brightness(const CloudLayer& cloud, double cosine);

}  // namespace diurna
