#pragma once

#include <vector>

namespace diurna {

struct Material;
class MaterialLibrary;

/// Light that continues behind surfaces of a material (Material::see_through): through the open
/// share of a net, or through a pane. Opaque: all zero.
struct PassedLight {
    std::vector<float> beam;  // of the sun, by the cosine of incidence in even steps from 0 to 1;
                              // empty: opaque
    float heat = 0.0f;        // of diffuse light from surfaces and sky: at 300 K, hemispherical
    float sunlight = 0.0f;    // the same, by the sun's spectrum
    bool sheet = false;       // has a back (ExposedBack), no facet in a closed mesh
};
/// (material)
std::vector<PassedLight> passed_light(const MaterialLibrary& materials);

/// PassedLight::heat of one material.
double passed_heat(const Material& material);
/// Whether sunlight and longwave transmittance differ by more than a hundredth: panes.
bool passes_by_spectrum(const std::vector<PassedLight>& passed);

}  // namespace diurna
