#pragma once

#include <array>
#include <vector>

#include "materials/atmosphere/band_model.hpp"

namespace diurna {

/// The longwave that falls on open level ground under any share of black cloud and any scale of the
/// sky: its lines of sight are followed once without cloud and once under a whole cover of it, as a
/// line through cloud is linear in the share that cloud hides.
class GroundSky {
 public:
    /// - model: whose cloud's place and temperature count, and whether there is some to meet: lines
    ///   are cut at its base then
    GroundSky(const BandModel& model, double height_km);

    /// ground_longwave() of that model with this share of black cloud (fraction × emissivity) and
    /// this scale, to rounding [W m⁻²].
    double longwave(double black_share, const LightScale& scale);

 private:
    static constexpr std::size_t angles = 4;
    std::array<std::vector<double>, angles> clear_,
        covered_;  // (angle)(node); followed when needed
    void follow_covered();

    BandModel overcast_;
    double height_km_;
    std::array<double, angles> zenith_deg_, weight_;
    std::array<bool, angles> ends_on_ground_;
    std::vector<double> black_here_;  // (node) of the air at the ground
};

}  // namespace diurna
