#pragma once

#include <array>

#include "materials/matter/material.hpp"

namespace diurna {

/// Key figures of a material.
struct MaterialFigures {
    double albedo, transmittance;  // of sunlight at the ground (ASTM G173)
    double emissivity;             // hemispherical, Planck at 300 K
    double mwir, lwir, wide;       // emissivity in 3-5, 8-12, 8-14 µm, 10° from the normal, 300 K
    double diffusivity;            // [m² s⁻¹] of the top layer
    double inertia;                // [J m⁻² K⁻¹ s⁻½] of the top layer, √(k ρ c)
    double day_depth;              // [m] at which a daily wave has decayed to 1/e
    std::array<double, 3> visible;  // reflectance in 0.6-0.7, 0.5-0.6, 0.4-0.5 µm: red, green, blue
};
MaterialFigures material_figures(const Material& material);

}  // namespace diurna
