#pragma once

#include <span>
#include <vector>

#include "render/path/path_table.hpp"
#include "render/rays/channel_lanes.hpp"

namespace diurna {

/// The air between the observer and points on its rays: a PathTable's transmittance and radiance in
/// the channels of all bands side by side.
class AirLanes {
 public:
    /// - bands: of the table
    AirLanes(const PathTable& path, std::span<const BandLight> bands, const ChannelLanes& lanes);

    /// Transmittance, (origin, lane), and radiance, (lane), of the air to a range [m] and a height
    /// above the sea.
    void to(float range, float height_km, float* transmittance, float* radiance) const;

 private:
    SightGrid grid_;
    std::size_t lanes_ = 0;
    std::vector<float> air_;  // (range, height, transmittance by origin, then radiance, lane)
};

}  // namespace diurna
