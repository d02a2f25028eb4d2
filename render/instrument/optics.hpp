#pragma once

#include <span>
#include <vector>

#include "render/instrument/instrument.hpp"
#include "render/instrument/response.hpp"

namespace diurna {

/// Effect of a lens on light by position, row by row from the upper left.
struct LensField {
    std::vector<float> light;       // share of the light on the axis: cos⁴ and mounts
    std::vector<float> background;  // flux that does not come from the scene
};

/// cos⁴ of a pixel's viewing angle, vignetting by mounts (which then emit as walls), the lens' own
/// emission, the walls beside it, and narcissus: a share of the lens reflects the cold detector
/// instead of the walls, exp(−(r/r₀)²) from the middle.
LensField lens_field(const Instrument& instrument, const Response& response, int width, int height,
                     double focal_length);

/// Veiling glare: a share of all light is spread evenly, (1 − share) L + share · mean (ISO 9358:
/// the signal of a black spot in a white field).
void spread_glare(double share, std::span<float> light);

/// Interval in time constants after which the previous picture has no effect.
inline constexpr double forgotten_after = 1000.0;
/// Response of a bolometer to a flux that changes linearly between pictures: τ dy/dt = x − y,
/// solved exactly. `seen` and `shown` are those of the previous picture.
void lag(double time_constant, double seconds, std::span<const float> seen,
         std::span<const float> shown, std::span<float> now);

}  // namespace diurna
