#include "materials/matter/passed_light.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "materials/matter/broadband.hpp"
#include "materials/matter/directional_optics.hpp"
#include "materials/matter/library.hpp"

namespace diurna {

namespace {

constexpr int cosine_steps = 32;

/// What is let through at the points of the transmittance, by `optics` of each.
template <class Optics>
Spectrum passed_by(const Material& material, const Optics& optics) {
    Spectrum passed{.wavelength_um = material.transmittance.wavelength_um, .value = {}};
    for (const double um : passed.wavelength_um) {
        passed.value.push_back(optics(material, um).transmittance);
    }
    return passed;
}

Spectrum hemispherical(const Material& material) {
    if (std::holds_alternative<Lambert>(material.finish)) return material.transmittance;
    return passed_by(material, hemispherical_optics);
}

/// Solar mean of what is let through at an angle.
float beam_at(const Material& material, double cosine) {
    return static_cast<float>(
        solar_mean(passed_by(material, [cosine](const Material& of, double um) {
            return directional_optics(of, um, cosine);
        })));
}

bool lets_through(const Material& material) {
    return material.see_through && !material.transmittance.empty();
}

}  // namespace

double passed_heat(const Material& material) {
    if (!lets_through(material)) return 0.0;
    return std::clamp(planck_mean(hemispherical(material)), 0.0, 1.0);
}

std::vector<PassedLight> passed_light(const MaterialLibrary& materials) {
    std::vector<PassedLight> all(materials.size());
    for (std::size_t m = 0; m < all.size(); ++m) {
        const Material& material = materials[MaterialId{static_cast<std::uint16_t>(m)}];
        all[m].sheet = material.thermal.back.has_value();
        if (!lets_through(material)) continue;
        all[m].heat = static_cast<float>(passed_heat(material));
        all[m].sunlight = static_cast<float>(solar_mean(hemispherical(material)));
        if (std::holds_alternative<Lambert>(material.finish)) {
            all[m].beam.assign(2, beam_at(material, 1.0));
            continue;
        }
        for (int k = 0; k <= cosine_steps; ++k) {
            all[m].beam.push_back(beam_at(material, double(k) / cosine_steps));
        }
    }
    return all;
}

bool passes_by_spectrum(const std::vector<PassedLight>& passed) {
    return std::any_of(passed.begin(), passed.end(),
                       [](const PassedLight& p) { return std::abs(p.heat - p.sunlight) > 0.01f; });
}

}  // namespace diurna
