#pragma once

#include <span>
#include <vector>

#include "render/instrument/instrument.hpp"
#include "render/instrument/response.hpp"

namespace diurna {

/// What a lens does to light from place to place, row by row from the upper left.
struct LensField {
    std::vector<float> light;       // share of the axis' light: cos⁴ and mounts
    std::vector<float> background;  // flux that comes with no light from the scene
};

/// cos⁴ of the angle at which a pixel looks, what mounts cut off (they are walls then), the lens'
/// own emission, the walls beside it, and narcissus: a share of the lens mirrors the cold detector
/// in place of the walls, exp(−(r/r₀)²) from the middle.
LensField lens_field(const Instrument& instrument, const Response& response, int width, int height,
                     double focal_length);

/// Veiling glare: a share of all light is spread evenly, (1 − share) L + share · mean
/// (ISO 9358: what a black spot in a white field then has).
void spread_glare(double share, std::span<float> light);

/// Time constants from one picture to the next beyond which they do not know each other.
inline constexpr double forgotten_after = 1000.0;
/// What a bolometer follows of what it sees, which goes straight from one picture to the next:
/// τ dy/dt = x − y, solved exactly. `seen` and `shown` are those of the picture before.
void lag(double time_constant, double seconds, std::span<const float> seen,
         std::span<const float> shown, std::span<float> now);

}  // namespace diurna
