#include "materials/matter/directional_optics.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

#include "materials/base/quadrature.hpp"
#include "materials/base/units.hpp"
#include "materials/matter/pane.hpp"

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

/// body(c, weight) with ∫₀¹ f(c) 2c dc = Σ weight f(c), by eight points in each of three parts,
/// which crowd where reflectances rise.
template <class Body>
void each_over_hemisphere(const Body& body) {
    static const std::array<Quadrature, 3> parts = {
        gauss_legendre(8, 0.0, 0.15), gauss_legendre(8, 0.15, 0.5), gauss_legendre(8, 0.5, 1.0)};
    for (const Quadrature& part : parts) {
        for (std::size_t i = 0; i < part.size(); ++i) {
            body(part.node[i], part.weight[i] * 2.0 * part.node[i]);
        }
    }
}

template <class F>
double over_hemisphere(const F& f) {
    double sum = 0.0;
    each_over_hemisphere([&](double c, double weight) { sum += weight * f(c); });
    return sum;
}

/// A pane's, whatever is reflected more than its faces do being dirt.
///
/// - reflectance, transmittance: as measured, at 10°
DirectionalOptics optics_of_pane(double reflectance, double transmittance, const Glossy& pane,
                                 double wavelength_um, double cosine) {
    const std::complex<double> index(pane.index.at(wavelength_um),
                                     pane.extinction.at(wavelength_um));
    const double inside = inside_of_pane(transmittance, index);
    const PaneOptics here = pane_optics(cosine, index, inside);
    const PaneOptics upright = pane_optics(laboratory_cosine, index, inside);
    const double left = std::max(0.0, 1.0 - here.reflectance - here.transmittance);
    const double more = std::max(0.0, reflectance - upright.reflectance);
    return {.emissivity = std::max(0.0, left - more),
            .mirrored = here.reflectance,
            .diffuse = std::min(left, more),
            .transmittance = here.transmittance};
}

/// A metal held to what it sends back at 10°: of a duller one than its index says oxide and dirt
/// take a share everywhere; of a brighter one all that is absorbed is less.
double reflectance_of_metal(double reflectance, double interface_here, double interface_normal) {
    if (reflectance <= interface_normal) return interface_here * reflectance / interface_normal;
    return 1.0 - (1.0 - reflectance) * (1.0 - interface_here) / (1.0 - interface_normal);
}

}  // namespace

double smooth_reflectance(const Glossy& finish, double wavelength_um, double cosine) {
    if (finish.metal && finish.index.empty()) return std::pow(1.0 - cosine, 5);
    const std::complex<double> index(finish.index.at(wavelength_um),
                                     finish.extinction.at(wavelength_um));
    return fresnel(cosine, index);
}

double interface_reflectance(const Finish& finish, double wavelength_um, double cosine) {
    const auto* glossy = std::get_if<Glossy>(&finish);
    if (glossy == nullptr) return 0.0;
    return microfacet_reflectance(microfacets_of(*glossy), cosine, [&](double c) {
        return smooth_reflectance(*glossy, wavelength_um, c);
    });
}

namespace {

/// Of a finish whose surface has such a reflectance and transmittance at 10°.
DirectionalOptics optics_of_finish(const Finish& finish, double reflectance, double transmittance,
                                   double wavelength_um, double cosine, double interface_here,
                                   double interface_normal) {
    DirectionalOptics optics{
        .emissivity = 0.0, .mirrored = 0.0, .diffuse = reflectance, .transmittance = transmittance};
    const auto* glossy = std::get_if<Glossy>(&finish);
    if (glossy && glossy->pane) {
        return optics_of_pane(reflectance, transmittance, *glossy, wavelength_um, cosine);
    }
    if (glossy) {
        double normal = interface_normal;
        if (glossy->metal && !glossy->index.empty()) {
            optics.mirrored = reflectance_of_metal(reflectance, interface_here, interface_normal);
            normal = reflectance;
        } else if (glossy->metal) {
            optics.mirrored = reflectance + (1.0 - reflectance) * interface_here;
            normal = reflectance + (1.0 - reflectance) * interface_normal;
        } else {
            // An interface that alone would reflect more than was measured is held to that; but
            // water, whose waves change what was measured.
            const double held = normal > reflectance && !glossy->waves ? reflectance / normal : 1.0;
            optics.mirrored = held * interface_here;
            normal *= held;
        }
        const double entering = normal < 1.0 ? (1.0 - optics.mirrored) / (1.0 - normal) : 0.0;
        optics.diffuse = std::max(0.0, reflectance - normal) * entering;
        optics.transmittance *= entering;
    } else if (const auto* table = std::get_if<ByAngle>(&finish)) {
        optics.diffuse = std::min(reflectance * factor_at(*table, cosine), 1.0 - transmittance);
    }
    optics.emissivity = 1.0 - optics.mirrored - optics.diffuse - optics.transmittance;
    return optics;
}

}  // namespace

DirectionalOptics directional_optics(const Material& material, double wavelength_um, double cosine,
                                     double interface_here, double interface_normal) {
    const auto bare = [&](const Spectrum& reflectance, const Spectrum& transmittance) {
        return optics_of_finish(material.finish, reflectance.at(wavelength_um),
                                transmittance.at(wavelength_um), wavelength_um, cosine,
                                interface_here, interface_normal);
    };
    const SnowOver* const snow = material.snow_over.get();
    if (!snow) return bare(material.reflectance, material.transmittance);
    const DirectionalOptics open = bare(snow->bare_reflectance, snow->bare_transmittance);
    const double sent = snow->reflectance.at(wavelength_um);
    return {.emissivity = std::lerp(open.emissivity, 1.0 - sent, snow->share),
            .mirrored = (1.0 - snow->share) * open.mirrored,
            .diffuse = std::lerp(open.diffuse, sent, snow->share),
            .transmittance = (1.0 - snow->share) * open.transmittance};
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

std::vector<DirectionalOptics> hemispherical_optics_at(const Material& material,
                                                       std::span<const double> wavelengths_um) {
    std::vector<DirectionalOptics> all;
    const auto* glossy = std::get_if<Glossy>(&material.finish);
    if (glossy == nullptr || glossy->pane) {
        for (const double um : wavelengths_um) all.push_back(hemispherical_optics(material, um));
        return all;
    }
    // The optics are linear in what the interface reflects, and that in the microfacets' angles.
    const Microfacets surface = microfacets_of(*glossy);
    const std::vector<double> upright = facing_shares(surface, laboratory_cosine);
    std::vector<double> mean(facing_nodes, 0.0);
    each_over_hemisphere([&](double cosine, double weight) {
        const std::vector<double> shares = facing_shares(surface, cosine);
        for (std::size_t k = 0; k < mean.size(); ++k) mean[k] += weight * shares[k];
    });
    for (const double um : wavelengths_um) {
        double here = 0.0, normal = 0.0;
        for (std::size_t k = 0; k < facing_nodes; ++k) {
            const double reflected = smooth_reflectance(*glossy, um, facing_cosine(k));
            here += mean[k] * reflected;
            normal += upright[k] * reflected;
        }
        all.push_back(directional_optics(material, um, 1.0, here, normal));
    }
    return all;
}

}  // namespace diurna
