#pragma once

#include <algorithm>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

#include "materials/atmosphere/sun_field.hpp"
#include "render/light/origin.hpp"
#include "render/light/radiance_input.hpp"

namespace diurna {

/// The light that falls on surfaces at one height, per node of a band.
struct IncidentLight {
    std::vector<double> sun;  // (node) irradiance on a plane facing the sun [W m⁻² µm⁻¹]
    std::vector<double> sky;  // (node) cosine-weighted mean radiance [W m⁻² sr⁻¹ µm⁻¹]
    std::vector<double> scattered;  // (node) sunlight in `sky`; empty: none

    /// Radiance of `sky` from an origin at a node.
    double sky_from(Origin origin, std::size_t node) const {
        const double sunlit = scattered.empty() ? 0.0 : scattered[node];
        return origin == Origin::sunlight   ? sunlit
               : origin == Origin::sky_heat ? std::max(0.0, sky[node] - sunlit)
                                            : 0.0;
    }
    LightByOrigin sky_by_origin() const;
    LightByOrigin sun_by_origin() const;
};
/// The mean is ∫ L cosθ dΩ / π = ∫₀¹ L d(cos²θ), by eight points of Gauss and Legendre.
///
/// scattered  of the same nodes, or null: `sky` is then the heat of air and clouds alone
IncidentLight incident_light(const RadianceInput& input, double height_km,
                             std::span<const double> node_um, const SunField* scattered = nullptr);

/// Sunlight scattered by the scene's air at a band's nodes. Empty where there is none: without sun,
/// with the sun below the horizon, beyond 5 µm, in a vacuum and in a table of paths.
std::optional<SunField> scattered_sun(const RadianceInput& input, std::span<const double> node_um);

/// Sunlit share × cosine / π [sr⁻¹]: times irradiance and reflectance, the radiance of sunlight.
///
/// cosine  of the angle between the facet's normal and the sun; negative: none falls on it
template <class Real>
Real sunlight_on(Real sunlit_share, Real cosine) {
    return sunlit_share / std::numbers::pi_v<Real> * std::max(Real{0}, cosine);
}

}  // namespace diurna
