#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "materials/air/sight_line.hpp"
#include "materials/atmosphere/band_model.hpp"
#include "materials/atmosphere/sunlit_air.hpp"

namespace diurna {

/// Fluxes of sunlight at a height, per node [W m⁻² µm⁻¹].
struct SunFlux {
    std::vector<double> direct;  // on a plane facing the sun
    std::vector<double> down;    // diffuse, on the horizontal from above
    std::vector<double> up;      // all, on the horizontal from below
};

/// Sunlight in the air: what scatters once exactly (Mie's phase functions of aerosol, Rayleigh's of
/// air; delta-scaled, after Nakajima and Tanaka 1988), what scatters more often from
/// two-stream fluxes in the same air. Clouds as BandModel::cloud says, in their share of the sky.
///
/// Made once for an instant, then asked along many lines; safe to share between threads. Smooth in
/// height, zenith angle and azimuth (continuous slopes), so that tables made of it stay small.
/// The air is plane for multiple scattering, spherical and refracting for the beam; the sun stands
/// under the same zenith angle along a whole line, so lines beyond 100 km under a low sun err.
///
/// Against LOWTRAN7 with Mie phase functions and its own two streams, and by band: README and
/// tests/materials/sun_field_test.cpp. Bins outside those of the nodes cost nothing.
class SunField {
 public:
    SunField(const BandModel& model, const SunLight& sun, std::span<const double> node_um);
    /// The same air and sun under another cloud: a third of the work of making it.
    SunField under(const CloudLayer& cloud) const;

    /// Sunlight scattered into a line on its way from its far end to its start, (node)
    /// [W m⁻² sr⁻¹ µm⁻¹]. What is behind its end is not in it.
    ///
    /// zenith_deg              of the line at its start, 0 up
    /// azimuth_from_sun_deg    of the line's azimuth from that of the sun, 0 towards it
    std::vector<double> path(const SightLine& line, double zenith_deg,
                             double azimuth_from_sun_deg) const;
    /// The same taken apart for tables: at_angle[k] + cos(zenith) · by_cosine, where angle k lies
    /// between the line and the direction to the sun. Several angles cost little more than one.
    struct ByTurn {
        std::vector<std::vector<double>> at_angle;  // (angle)(node)
        std::vector<double> by_cosine;              // (node)
    };
    /// With `onward`, which leads from an eye to a mirror at the line's start, what of it arrives
    /// at the eye on top of path() of that way.
    ByTurn path_by_turn(const SightLine& line, std::span<const double> angle_deg,
                        const SightLine& onward = {}) const;
    /// That angle [deg].
    double angle_from_sun_deg(double zenith_deg, double azimuth_from_sun_deg) const;

    /// Scattered radiance of the sky (path to the top of the air, or to the cloud layer and what
    /// shines through it), or of the air above the ground it ends on.
    std::vector<double> sky(double height_km, double zenith_deg, double azimuth_from_sun_deg) const;
    /// The same under several azimuths, (azimuth)(node): they cost little more than one. With
    /// `onward`, which leads from an eye to a mirror at that height, what of it arrives at the eye
    /// on top of path() of that way.
    std::vector<std::vector<double>> skies(double height_km, double zenith_deg,
                                           std::span<const double> azimuth_from_sun_deg,
                                           const SightLine& onward = {}) const;

    SunFlux flux(double height_km) const;

 private:
    explicit SunField(std::shared_ptr<const SunlitAir> air) : air_(std::move(air)) {}

    std::shared_ptr<const SunlitAir> air_;
};

}  // namespace diurna
