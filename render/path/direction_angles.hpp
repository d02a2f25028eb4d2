#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/light/band_channels.hpp"
#include "render/light/radiance.hpp"
#include "render/path/path_table.hpp"

namespace diurna {

/// Radiance of the background (sky, and the far plain below the horizon) from one height in the
/// channels of a band, over direction: background_at() and scattered_background_at() at nodes that
/// crowd towards the horizon, cubic between them; scattered sunlight over azimuth too, every 6°.
class SkyTable {
 public:
    /// Directions to be asked for; azimuths to either side of the sun's.
    struct Extent {
        double least_zenith_deg = 1e9, most_zenith_deg = -1e9;
        double least_azimuth_deg = 1e9, most_azimuth_deg = -1e9;
        bool any() const { return least_zenith_deg <= most_zenith_deg; }
        void include(const Eigen::Vector3d& direction, const Eigen::Vector3d& to_sun);
    };
    SkyTable(const RadianceInput& input, const Band& band, const Channels& channels,
             const SunField* scattered, double height_km, const Extent& extent);

    /// Where in the table a unit vector lies: the same for every band of one height and extent.
    struct Place {
        bool up;
        Stencil zenith, azimuth;
    };
    Place place(const Eigen::Vector3d& direction) const;
    /// Channel sums [W m⁻² sr⁻¹] there.
    void at(const Place& place, std::span<float> out) const;

 private:
    static constexpr std::size_t nodes = 28;
    static constexpr double azimuth_step_deg = 6.0;
    /// Above the horizon, or below it.
    struct Part {
        double low = 0.0, step = 1.0;  // of the variable of zenith angles
        std::vector<float> heat;       // (zenith, channel); empty where not needed
        std::vector<float> sunlight;   // (azimuth, zenith, channel)
    };
    double above(double zenith_deg) const;
    double below(double zenith_deg) const;

    std::size_t padded_ = 0;
    std::size_t azimuths_ = 4, first_azimuth_ = 0;  // of those every 6° from the sun's
    double horizon_ = 90.0;
    Eigen::Vector3d to_sun_;
    Part sky_, plain_;
};

}  // namespace diurna
