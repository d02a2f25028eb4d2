#pragma once

#include <cstddef>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/light/radiance.hpp"

namespace diurna {

/// Band radiance [W m⁻² sr⁻¹] of the background over zenith angle: sky above the horizon of the
/// far plain, plain below it (background_at). Nodes crowd towards the horizon; cubic between them,
/// within 5 mK of apparent temperature (tests/render/tracer_test.cpp). Scattered sunlight on top
/// over zenith and azimuth, nodes every 6° of azimuth, within 0.1 % of radiance in 0.4-1 µm 20° and
/// more from the sun, 0.2 % at the horizon (tests/render/tracer_test.cpp).
class BackgroundTable {
 public:
    BackgroundTable(const RadianceInput& input, const Band& band, double height_km,
                    double least_zenith_deg, double most_zenith_deg);
    /// Adds sunlight for azimuths [deg] between two, counted from the sun's.
    void add_sunlight(const RadianceInput& input, const Band& band, const SunField& scattered,
                      double height_km, double least_azimuth_deg, double most_azimuth_deg);
    double operator()(double zenith_deg, double azimuth_from_sun_deg = 0.0) const;

 private:
    static constexpr std::size_t nodes = 24, sunlit_nodes = 28;
    /// Scattered sunlight above the horizon or below it.
    struct Sunlit {
        std::vector<std::vector<double>> radiance;  // (azimuth)(zenith), empty where not needed
        double low = 0.0, step = 1.0;               // of the variable of zenith angles
    };
    double sunlit(const Sunlit& part, double place, double azimuth_deg) const;
    double above(double zenith_deg) const;  // the variable in which nodes are uniform
    double below(double zenith_deg) const;

    double horizon_ = 90.0;
    double above_low_ = 0.0, above_step_ = 0.0, below_low_ = 0.0, below_step_ = 0.0;
    std::vector<double> sky_, plain_;  // empty where not needed
    Sunlit sunlit_sky_, sunlit_plain_;
    double azimuth_low_ = 0.0, azimuth_step_ = 1.0;
};

}  // namespace diurna
