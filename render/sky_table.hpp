#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "materials/band.hpp"
#include "render/band_table.hpp"
#include "render/radiance.hpp"

namespace diurna {

/// Radiance of the background (sky, and the far plain below the horizon) from one height in the
/// channels of a band, over direction: background_at() and scattered_background_at() at nodes that
/// crowd towards the horizon, cubic between them; scattered sunlight over azimuth too, every 6°.
class SkyTable {
 public:
    /// Directions to be asked for.
    struct Extent {
        double least_zenith_deg = 1e9, most_zenith_deg = -1e9;
        bool any() const { return least_zenith_deg <= most_zenith_deg; }
        void include(const Eigen::Vector3d& direction);
    };
    SkyTable(const RadianceInput& input, const Band& band, const Channels& channels,
             const SunField* scattered, double height_km, const Extent& extent);

    /// Channel sums [W m⁻² sr⁻¹] towards a unit vector.
    void at(const Eigen::Vector3d& direction, std::span<float> out) const;

 private:
    static constexpr std::size_t nodes = 28, azimuths = 31;
    /// Above the horizon, or below it.
    struct Part {
        double low = 0.0, step = 1.0;  // of the variable of zenith angles
        std::vector<float> heat;       // (zenith, channel); empty where not needed
        std::vector<float> sunlight;   // (azimuth, zenith, channel)
    };
    double above(double zenith_deg) const;
    double below(double zenith_deg) const;

    std::size_t padded_ = 0;
    double horizon_ = 90.0, sun_azimuth_deg_ = 0.0;
    Part sky_, plain_;
};

}  // namespace diurna
