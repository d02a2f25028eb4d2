#pragma once

#include <optional>
#include <span>
#include <vector>

#include "materials/air/sight_line.hpp"
#include "materials/atmosphere/band_model.hpp"

namespace diurna {

/// Below, drops scatter what they take; beyond they absorb and emit.
inline constexpr double drops_scatter_um = 3.0;

/// Whether light at a height is that under the cloud, or under the whole air where there is none:
/// what measurements at the ground scale. Within the layer it is dim as at its base; light changes
/// at the top.
bool below_cloud(const BandModel& model, double height_km);

/// Where a line goes through the cloud layer of a model.
struct CloudCrossing {
    std::size_t segment = 0;   // of the line
    double share = 0.0;        // of the segment before it
    double height_km = 0.0;    // the base of lines that rise, the top of lines that fall
    double temperature = 0.0;  // [K] of the cloud there
    double cosine = 1.0;       // between line and vertical
};

/// The first crossing in the segments from `begin` on; none without cloud. Lines that rise meet the
/// base, lines that fall the top; one that starts within the layer meets the side it leaves by
/// (with begin = 0; what begins later has left it).
std::optional<CloudCrossing> cloud_crossing(const BandModel& model, const SightLine& line,
                                            std::size_t begin = 0);

/// The line before the crossing, and behind it.
SightLine line_before(const SightLine& line, const CloudCrossing& crossing);
SightLine line_behind(const SightLine& line, const CloudCrossing& crossing);

/// What the crossing hides of light of a wavelength, 0 to 1: what drops scatter out of the
/// line below drops_scatter_um, what they absorb beyond.
double hidden_share(const CloudLayer& cloud, const CloudCrossing& crossing, double wavelength_um);

/// What all crossings of a line let through, (node); all 1 where there is none.
std::vector<double> through_clouds(const BandModel& model, const SightLine& line,
                                   std::span<const double> node_um);

}  // namespace diurna
