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

/// Sunlight in the air. Single scattering is exact (Mie's phase functions of aerosol, Rayleigh's of
/// air; delta-scaled, after Nakajima and Tanaka 1988); multiple scattering comes from two-stream
/// fluxes in the same air. Clouds as in BandModel::cloud, over their share of the sky.
///
/// Built once for an instant, then evaluated along many lines; safe to share between threads.
/// Smooth in height, zenith angle and azimuth (continuous slopes), so that tables of it stay small.
/// The air is plane for multiple scattering, spherical and refracting for the beam. The sun's
/// zenith angle is constant along a line: an error for lines over 100 km under a low sun.
///
/// Comparison with LOWTRAN7 with Mie phase functions and its own two streams, by band: README and
/// tests/materials/sun_field_test.cpp. Bins outside those of the nodes take no time.
class SunField {
 public:
    SunField(const BandModel& model, const SunLight& sun, std::span<const double> node_um);
    /// The same air and sun under another cloud: a third of the work of making it.
    SunField under(const CloudLayer& cloud) const;

    /// Sunlight scattered into a line between its far end and its start, (node) [W m⁻² sr⁻¹ µm⁻¹].
    /// Light from behind its end is not included.
    ///
    /// zenith_deg              of the line at its start, 0 up
    /// azimuth_from_sun_deg    azimuth of the line minus that of the sun, 0 towards the sun
    std::vector<double> path(const SightLine& line, double zenith_deg,
                             double azimuth_from_sun_deg) const;
    /// The same in parts for tables: at_angle[k] + cos(zenith) · by_cosine, angle k being between
    /// line and direction to the sun. Several angles take little more time than one.
    struct ByTurn {
        std::vector<std::vector<double>> at_angle;  // (angle)(node)
        std::vector<double> by_cosine;              // (node)
    };
    /// With `onward`, the path from an observer to a mirror at the line's start: the part of it
    /// that arrives at the observer, in addition to path() of that path.
    ByTurn path_by_turn(const SightLine& line, std::span<const double> angle_deg,
                        const SightLine& onward = {}) const;
    /// The angle between line and sun [deg].
    double angle_from_sun_deg(double zenith_deg, double azimuth_from_sun_deg) const;

    /// Scattered radiance of the sky (path to the top of the air, or to the cloud layer plus the
    /// light transmitted by it), or of the air in front of the ground.
    std::vector<double> sky(double height_km, double zenith_deg, double azimuth_from_sun_deg) const;
    /// The same under several azimuths, (azimuth)(node), in little more time than one. With
    /// `onward`, the path from an observer to a mirror at that height: the part of it that arrives
    /// at the observer, in addition to path() of that path.
    std::vector<std::vector<double>> skies(double height_km, double zenith_deg,
                                           std::span<const double> azimuth_from_sun_deg,
                                           const SightLine& onward = {}) const;

    SunFlux flux(double height_km) const;

 private:
    explicit SunField(std::shared_ptr<const SunlitAir> air) : air_(std::move(air)) {}

    std::shared_ptr<const SunlitAir> air_;
};

}  // namespace diurna
