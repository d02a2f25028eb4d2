#include "materials/matter/varied.hpp"

#include <algorithm>
#include <cmath>

#include "materials/matter/broadband.hpp"

namespace diurna {

namespace {

constexpr double sunlight_ends_um = 3.0, heat_begins_um = 3.5;

/// A material's reflectance with points where its transmittance has them, where sunlight ends and
/// where heat begins: between two points everything is straight.
Spectrum on_all_points(const Material& material) {
    const Spectrum& s = material.reflectance;
    std::vector<double> points = material.transmittance.wavelength_um;
    points.insert(points.end(), {sunlight_ends_um, heat_begins_um});
    Spectrum out{s.wavelength_um, {}};
    for (const double um : points) {
        if (um > s.wavelength_um.front() && um < s.wavelength_um.back()) {
            out.wavelength_um.push_back(um);
        }
    }
    std::sort(out.wavelength_um.begin(), out.wavelength_um.end());
    out.wavelength_um.erase(std::unique(out.wavelength_um.begin(), out.wavelength_um.end()),
                            out.wavelength_um.end());
    for (const double um : out.wavelength_um) out.value.push_back(s.at(um));
    return out;
}

/// Moves reflectance towards black or white, where `heat` says, until its mean is as wanted.
template <class Mean>
Spectrum moved(const Material& material, double wanted, bool heat, const Mean& mean) {
    Spectrum rho = on_all_points(material);
    const double now = mean(rho);
    Spectrum way = rho;
    for (std::size_t i = 0; i < way.value.size(); ++i) {
        const double um = way.wavelength_um[i];
        const double end =
            wanted < now ? 0.0 : std::max(rho.value[i], 1.0 - material.transmittance.at(um));
        const double warm =
            std::clamp((um - sunlight_ends_um) / (heat_begins_um - sunlight_ends_um), 0.0, 1.0);
        way.value[i] = (heat ? warm : 1.0 - warm) * (end - rho.value[i]);
    }
    const double most = mean(way);
    if (most == 0.0) return rho;
    const double share = std::clamp((wanted - now) / most, 0.0, 1.0);
    for (std::size_t i = 0; i < rho.value.size(); ++i) rho.value[i] += share * way.value[i];
    return rho;
}

}  // namespace

Material with_albedo(Material material, double albedo) {
    material.reflectance =
        moved(material, albedo, false, [](const Spectrum& s) { return solar_mean(s); });
    material.thermal.albedo = albedo;
    return material;
}

Material with_emissivity(Material material, double emissivity) {
    const double transmitted = planck_mean(material.transmittance);
    material.reflectance = moved(material, 1.0 - transmitted - emissivity, true,
                                 [](const Spectrum& s) { return planck_mean(s); });
    material.thermal.emissivity = emissivity;
    return material;
}

}  // namespace diurna
