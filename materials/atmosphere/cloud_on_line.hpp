#pragma once

#include <optional>
#include <span>
#include <vector>

#include "materials/air/sight_line.hpp"
#include "materials/atmosphere/band_model.hpp"

namespace diurna {

/// Below this wavelength drops scatter, above it they absorb and emit.
inline constexpr double drops_scatter_um = 3.0;

/// Whether light at a height is that under the cloud, or under the whole air where there is none:
/// what measurements at the ground scale. Within the layer it is dim as at its base; light changes
/// at the top.
bool below_cloud(const BandModel& model, double height_km);

/// Where a line crosses the cloud layer of a model.
struct CloudCrossing {
    std::size_t segment = 0;   // of the line
    double share = 0.0;        // fraction of the segment before the crossing
    double height_km = 0.0;    // the base of lines that rise, the top of lines that fall
    double temperature = 0.0;  // [K] of the cloud there
    double cosine = 1.0;       // between line and vertical
};

/// The first crossing in the segments from `begin` on; nothing without cloud. Rising lines meet the
/// base, falling lines the top; a line that starts within the layer meets the side through which it
/// leaves (with begin = 0; if `begin` is later, the line has already left).
std::optional<CloudCrossing> cloud_crossing(const BandModel& model, const SightLine& line,
                                            std::size_t begin = 0);

/// The part of the line before the crossing, and the part behind it.
SightLine line_before(const SightLine& line, const CloudCrossing& crossing);
SightLine line_behind(const SightLine& line, const CloudCrossing& crossing);

/// Share of a wavelength's light that the crossing removes, 0 to 1: scattered out of the line below
/// drops_scatter_um, absorbed above it.
double hidden_share(const CloudLayer& cloud, const CloudCrossing& crossing, double wavelength_um);

/// Transmittance of all cloud crossings of a line, (node); all 1 if it crosses none.
std::vector<double> through_clouds(const BandModel& model, const SightLine& line,
                                   std::span<const double> node_um);

}  // namespace diurna
