#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "render/light/band_light.hpp"
#include "render/path/interpolation.hpp"

namespace diurna {

/// Zenith angles from one height, on either side of the horizon of the far plain, in variables in
/// which the background is smooth, so that nodes are denser towards the horizon.
struct HorizonScale {
    enum Side : std::size_t { sky, plain };
    double horizon_deg = 90.0;

    Side side_of(double zenith_deg) const { return zenith_deg <= horizon_deg ? sky : plain; }
    /// Sky: the path length grows like one over the angle above the horizon. Plain: the distance
    /// behaves like a square root near the horizon.
    double of(Side side, double zenith_deg) const;
    double zenith_deg(Side side, double variable) const;

    /// Node positions on one side, in equal steps of the variable.
    struct Nodes {
        double low = 0.0, step = 1.0;
        double at(double k) const { return low + step * k; }
        /// The step between the first two cut for so many nodes.
        Nodes cut(std::size_t count) const { return {low, step / double(count - 1)}; }
        double place(double variable) const { return (variable - low) / step; }
    };
    /// `count` nodes for the part of an extent on one side; empty if there is none.
    std::optional<Nodes> nodes(Side side, double least_zenith_deg, double most_zenith_deg,
                               std::size_t count) const;
};

/// Band radiance [W m⁻² sr⁻¹] of the background (background.hpp) from one height over zenith angle,
/// cubic between 13 or 25 nodes on each side of the horizon; within 5 mK of apparent temperature
/// (tests/render/tracer_test.cpp). Scattered sunlight on top over zenith and azimuth, nodes every
/// 6° of azimuth, within 0.1 % of radiance in 0.4-1 µm 20° and more from the sun, 0.2 % at the
/// horizon (tests/render/tracer_test.cpp).
class BackgroundTable {
 public:
    /// Range of directions; azimuths relative to the sun's.
    struct Extent {
        double least_zenith_deg, most_zenith_deg;
        double least_azimuth_deg, most_azimuth_deg;
    };
    BackgroundTable(const RadianceInput& input, const BandLight& band, double height_km,
                    const Extent& extent);
    double operator()(double zenith_deg, double azimuth_from_sun_deg = 0.0) const;

 private:
    struct Part {
        HorizonScale::Nodes nodes, sunlit_nodes;    // of zenith angles
        std::vector<double> heat;                   // (zenith)
        std::vector<std::vector<double>> sunlight;  // (azimuth)(zenith), empty: none
    };
    void add_sunlight(const RadianceInput& input, const BandLight& band, double height_km,
                      const Extent& extent);

    HorizonScale horizon_;
    std::array<Part, 2> part_;  // (side) empty where not needed
    double azimuth_low_ = 0.0, azimuth_step_ = 1.0;
};

/// The same in the channels of a band, for panes, nets, plumes and mirrors: 28 nodes on each side;
/// sunlight over azimuths to either side of the sun's, every 6°.
class BackgroundChannels {
 public:
    /// Range of directions.
    struct Extent {
        double least_zenith_deg = 1e9, most_zenith_deg = -1e9;
        double least_azimuth_deg = 1e9, most_azimuth_deg = -1e9;
        bool any() const { return least_zenith_deg <= most_zenith_deg; }
        void include(const Eigen::Vector3d& direction, const Eigen::Vector3d& to_sun);
    };
    /// - onward: path from an eye to that height (mirrors): returns what arrives
    ///   there
    BackgroundChannels(const RadianceInput& input, const BandLight& band, double height_km,
                       const Extent& extent, const SightLine& onward = {});

    /// Table position of a unit vector: the same for every band of one height and extent.
    struct Place {
        HorizonScale::Side side;
        Stencil zenith, azimuth;
    };
    Place place(const Eigen::Vector3d& direction) const;
    /// Adds the channel sums [W m⁻² sr⁻¹] there, times `weight`, to `out`.
    void add(const Place& place, float weight, std::span<float> out) const;
    /// Multiplies all values, by channel.
    void scale(std::span<const float> factor);

 private:
    struct Part {
        HorizonScale::Nodes nodes;    // of zenith angles
        std::vector<float> heat;      // (zenith, channel); empty where not needed
        std::vector<float> sunlight;  // (azimuth, zenith, channel) including heat; or empty
    };
    void fill(HorizonScale::Side side, const RadianceInput& input, const BandLight& band,
              double height_km, const SightLine& onward);

    std::size_t padded_ = 0;
    std::size_t azimuths_ = 4, first_azimuth_ = 0;  // range of those every 6° from the sun's
    HorizonScale horizon_;
    Eigen::Vector3d to_sun_;
    std::array<Part, 2> part_;  // (side)
};

}  // namespace diurna
