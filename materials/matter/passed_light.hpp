#pragma once

#include <vector>

namespace diurna {

struct Material;
class MaterialLibrary;

/// What goes on behind surfaces of a material (Material::see_through): the open share of a net,
/// what a pane lets through. Opaque: all zero.
struct PassedLight {
    std::vector<float> beam;  // of the sun, by the cosine of incidence in even steps from 0 to 1;
                              // empty: none
    float heat = 0.0f;        // of diffuse light from surfaces and sky: at 300 K, hemispherical
    float sunlight = 0.0f;    // likewise by the sun's spectrum
    bool sheet = false;       // has a back (ExposedBack), which is no facet in a closed mesh
};
/// (material)
std::vector<PassedLight> passed_light(const MaterialLibrary& materials);

/// PassedLight::heat of one.
double passed_heat(const Material& material);
/// Whether sunlight passes otherwise than heat does, beyond a hundredth: panes.
bool passes_by_spectrum(const std::vector<PassedLight>& passed);

}  // namespace diurna
