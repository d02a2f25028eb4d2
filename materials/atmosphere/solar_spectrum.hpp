#pragma once

namespace diurna {

/// The sun's irradiance above the air at 1 AU [W m⁻² µm⁻¹], 0.3 to 20 µm, averaged over the
/// wavelength's bin (the band model's bins and five below them); outside, the nearest bin's.
/// ASTM E490 scaled to `solar_constant`; source: data_folder()/atmosphere/SOURCE.md.
double solar_above_air(double wavelength_um);

}  // namespace diurna
