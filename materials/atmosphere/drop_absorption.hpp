#pragma once

namespace diurna {

/// Single-scattering albedo of cloud drops with an effective radius of 10 µm, 0.5 to 1: 1 − ω =
/// ½ (1 − exp(−1.7 κ r)), κ = 4π k / λ, the large-drop limit of Mie's theory, 0.85 κ r where little
/// is absorbed (Twomey & Bohren 1980, J. Atmos. Sci. 37, 2086), with k of water by Hale & Querry
/// (1973). 0.994 at 1.6 µm, 0.91 at 3.8 µm, 0.5 at 3 µm.
double drop_single_albedo(double wavelength_um);

}  // namespace diurna
