#include "materials/matter/directional_optics.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/quadrature.hpp"
#include "materials/base/units.hpp"
#include "materials/matter/microfacet.hpp"

namespace diurna {

namespace {

/// A table's factor.
double factor_at(const ByAngle& finish, double cosine) {
    const double angle = degrees(std::acos(std::clamp(cosine, 0.0, 1.0)));
    const auto& x = finish.angle_deg;
    if (angle <= x.front()) return finish.factor.front();
    if (angle >= x.back()) return finish.factor.back();
    const auto above = std::upper_bound(x.begin(), x.end(), angle);
    const auto i = static_cast<std::size_t>(above - x.begin());
    const double t = (angle - x[i - 1]) / (x[i] - x[i - 1]);
    return finish.factor[i - 1] + t * (finish.factor[i] - finish.factor[i - 1]);
}

/// ∫₀¹ f(c) 2c dc by eight points in each of three parts, which crowd where reflectances rise.
template <class F>
double over_hemisphere(const F& f) {
    static const std::array<Quadrature, 3> parts = {
        gauss_legendre(8, 0.0, 0.15), gauss_legendre(8, 0.15, 0.5), gauss_legendre(8, 0.5, 1.0)};
    double sum = 0.0;
    for (const Quadrature& part : parts) {
        for (std::size_t i = 0; i < part.size(); ++i) {
            const double c = part.node[i];
            sum += part.weight[i] * 2.0 * c * f(c);
        }
    }
    return sum;
}

}  // namespace

double interface_reflectance(const Finish& finish, double wavelength_um, double cosine) {
    const auto* glossy = std::get_if<Glossy>(&finish);
    if (glossy == nullptr) return 0.0;
    const Microfacets surface{.roughness = glossy->roughness};
    if (glossy->metal) {
        return microfacet_reflectance(surface, cosine,
                                      [](double c) { return std::pow(1.0 - c, 5); });
    }
    const std::complex<double> index(glossy->index.at(wavelength_um),
                                     glossy->extinction.at(wavelength_um));
    return microfacet_reflectance(surface, cosine, [&](double c) { return fresnel(c, index); });
}

DirectionalOptics directional_optics(const Material& material, double wavelength_um, double cosine,
                                     double interface_here, double interface_normal) {
    const double reflectance = material.reflectance.at(wavelength_um);
    const double transmittance = material.transmittance.at(wavelength_um);
    DirectionalOptics optics{
        .emissivity = 0.0, .mirrored = 0.0, .diffuse = reflectance, .transmittance = transmittance};
    if (const auto* glossy = std::get_if<Glossy>(&material.finish)) {
        double normal = interface_normal;
        if (glossy->metal) {
            optics.mirrored = reflectance + (1.0 - reflectance) * interface_here;
            normal = reflectance + (1.0 - reflectance) * interface_normal;
        } else {
            // An interface that alone would reflect more than was measured is held to that.
            const double held = normal > reflectance ? reflectance / normal : 1.0;
            optics.mirrored = held * interface_here;
            normal *= held;
        }
        const double entering = normal < 1.0 ? (1.0 - optics.mirrored) / (1.0 - normal) : 0.0;
        optics.diffuse = std::max(0.0, reflectance - normal) * entering;
        optics.transmittance *= entering;
    } else if (const auto* table = std::get_if<ByAngle>(&material.finish)) {
        optics.diffuse = std::min(reflectance * factor_at(*table, cosine), 1.0 - transmittance);
    }
    optics.emissivity = 1.0 - optics.mirrored - optics.diffuse - optics.transmittance;
    return optics;
}

DirectionalOptics directional_optics(const Material& material, double wavelength_um,
                                     double cosine) {
    return directional_optics(
        material, wavelength_um, cosine,
        interface_reflectance(material.finish, wavelength_um, cosine),
        interface_reflectance(material.finish, wavelength_um, laboratory_cosine));
}

DirectionalOptics hemispherical_optics(const Material& material, double wavelength_um) {
    if (std::holds_alternative<Lambert>(material.finish)) {
        return directional_optics(material, wavelength_um, laboratory_cosine);
    }
    const auto mean = [&](double DirectionalOptics::*part) {
        return over_hemisphere(
            [&](double c) { return directional_optics(material, wavelength_um, c).*part; });
    };
    DirectionalOptics optics{.emissivity = 0.0,
                             .mirrored = mean(&DirectionalOptics::mirrored),
                             .diffuse = mean(&DirectionalOptics::diffuse),
                             .transmittance = mean(&DirectionalOptics::transmittance)};
    optics.emissivity = 1.0 - optics.mirrored - optics.diffuse - optics.transmittance;
    return optics;
}

}  // namespace diurna
