#pragma once

#include <algorithm>
#include <array>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "render/light/directional_sky.hpp"
#include "render/light/origin.hpp"
#include "render/light/radiance_input.hpp"

namespace diurna {

/// The light incident on surfaces at one height, per node of a band.
struct IncidentLight {
    std::vector<double> sun;  // (node) irradiance on a plane facing the sun [W m⁻² µm⁻¹]
    std::vector<double> sky;  // (node) cosine-weighted mean radiance [W m⁻² sr⁻¹ µm⁻¹]
    std::vector<double> scattered;  // (node) sunlight in `sky`; empty: none
    /// (node) The circumsolar part of scattered sunlight, on a plane facing the sun; not in `sky`.
    /// Empty: none.
    std::vector<double> aureole = {};
    /// Directional distribution of thermal and scattered light about their means, (function)(node),
    /// see directional_sky.hpp; empty: none.
    std::array<std::vector<double>, 3> uneven_heat = {};
    std::array<std::vector<double>, uneven_functions> uneven_scattered = {};
    /// Residual of scattered sunlight without these, (direction of half_sky)(node); empty: none.
    std::vector<std::vector<double>> left_scattered = {};

    /// Radiance of `sky` from an origin at a node.
    double sky_from(Origin origin, std::size_t node) const {
        const double sunlit = scattered.empty() ? 0.0 : scattered[node];
        return origin == Origin::sunlight   ? sunlit
               : origin == Origin::sky_heat ? std::max(0.0, sky[node] - sunlit)
                                            : 0.0;
    }
    /// Coefficient of an uneven function of light from an origin at a node.
    double uneven_from(std::size_t function, Origin origin, std::size_t node) const {
        const auto at = [node](const std::vector<double>& c) { return c.empty() ? 0.0 : c[node]; };
        if (origin == Origin::sunlight) return at(uneven_scattered[function]);
        const bool has = origin == Origin::sky_heat && function < uneven_heat.size();
        return has ? at(uneven_heat[function]) : 0.0;
    }
    /// Sun and aureole at a node.
    double from_sun(std::size_t node) const {
        return sun[node] + (aureole.empty() ? 0.0 : aureole[node]);
    }
    /// Radiance incident on a facet from the sky, as its mean over the whole hemisphere.
    ///
    /// - narrow: its NarrowView, or empty
    LightByOrigin sky_on(double sky_view, const UnevenView& uneven,
                         std::span<const float> narrow = {}) const;
    LightByOrigin sky_by_origin() const { return sky_on(1.0, {}); }
    LightByOrigin sun_by_origin() const;
};
/// The mean is ∫ L cosθ dΩ / π = ∫₀¹ L d(cos²θ), by eight Gauss-Legendre points.
///
/// scattered  of the same nodes, or null: `sky` is then thermal light of air and clouds only
IncidentLight incident_light(const RadianceInput& input, double height_km,
                             std::span<const double> node_um,
                             const ScatteredSun* scattered = nullptr);

/// Whether there is sunlight scattered by the scene's air at any of these wavelengths.
bool has_scattered_sun(const RadianceInput& input, std::span<const double> node_um);

/// Scattered sunlight at a band's nodes. Nothing without sun, with the sun below the horizon,
/// beyond 5 µm, in a vacuum and in a table of paths.
std::optional<ScatteredSun> scattered_sun(const RadianceInput& input,
                                          std::span<const double> node_um);

/// Sunlit share × cosine / π [sr⁻¹]: times irradiance and reflectance, the radiance of sunlight.
///
/// cosine  of the angle between the facet's normal and the sun; negative: no sunlight on it
template <class Real>
Real sunlight_on(Real sunlit_share, Real cosine) {
    return sunlit_share / std::numbers::pi_v<Real> * std::max(Real{0}, cosine);
}

}  // namespace diurna
