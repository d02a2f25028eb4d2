#pragma once

#include <span>

#include "terrain/relief/height_field.hpp"

namespace diurna {

/// Sky view of each post above the horizontal, cosine-weighted about its normal, (row, column), 0
/// to 1:
///
///     V = 1/π ∫ [n_z cos²h / 2 + n_φ (π/2 − h − sin h cos h) / 2] dφ
///
/// with h the horizon towards φ or the edge of the post's own plane, whichever is higher, and n_φ
/// the normal's component in that direction (Dozier & Frew 1990, eq. 7b). Error by number of
/// azimuths, rms on real relief: 8: 1e-3, 16: 4e-4, 32: 1.3e-4. Voids have 1.
void sky_view(const HeightField& field, int azimuths, std::span<float> sky_view);

}  // namespace diurna
