#pragma once

#include <span>
#include <vector>

#include "materials/air/sight_line.hpp"
#include "materials/atmosphere/band_model.hpp"
#include "materials/atmosphere/medium.hpp"
#include "materials/atmosphere/path_spectrum.hpp"

namespace diurna {

/// The functions of atmosphere.hpp for the band model: a path's transmittance and emission, the sky
/// with its clouds, the direct sun; each at given wavelengths.
///
/// met  output: amounts along the whole path, in the bins of the nodes; null: not requested
PathSpectrum band_model_path(const BandModel& model, const SightLine& line,
                             std::span<const double> node_um, Amounts* met = nullptr);
std::vector<double> band_model_sky(const BandModel& model, double height_km, double zenith_deg,
                                   std::span<const double> node_um, const SightLine& onward = {});
std::vector<double> band_model_sun(const BandModel& model, double height_km, double zenith_deg,
                                   std::span<const double> node_um, const SightLine& onward = {});

/// The sky's radiance as measured light says it is, from the model's.
///
/// - black: of the air where it arrives
double scaled_sky(const LightScale& scale, double radiance, double black);

}  // namespace diurna
