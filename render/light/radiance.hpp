#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <span>
#include <vector>

#include "materials/atmosphere/atmosphere.hpp"
#include "materials/atmosphere/sun_field.hpp"
#include "materials/matter/library.hpp"
#include "materials/radiation/band.hpp"
#include "render/view/view.hpp"
#include "terrain/facets.hpp"
#include "terrain/place/instant.hpp"
#include "terrain/visibility/view_factors.hpp"

namespace diurna {

/// The state of the scene at one instant: all that a picture depends on besides the view.
struct RadianceInput {
    const FacetSet& facets;
    const FacetViews& views;
    const MaterialLibrary& materials;
    const Atmosphere& atmosphere;
    std::span<const float> temperature;                 // (facet) [K], 1 to 5000
    std::span<const float> sun_fraction = {};           // (facet) 0 to 1; empty: no sun
    Eigen::Vector3d to_sun = Eigen::Vector3d::UnitZ();  // unit
    double sun_zenith_deg = 180.0;
    double sun_distance_au = 1.0;
    double ground_height_km = 0.0;  // of the scene's origin above the sea
    Instant instant{};
};

/// The terms of the signature equation; `path` is the air between surface and eye.
enum class Term { emitted, sun, sky, surroundings, behind, path };
inline constexpr std::size_t term_count = 6;
inline constexpr std::array<const char*, term_count> term_names = {
    "emitted", "reflected_sun", "reflected_sky", "reflected_surroundings", "transmitted", "path"};

/// The light that falls on surfaces at one height, per node of a band.
struct Light {
    std::vector<double> sun;  // (node) irradiance on a plane facing the sun [W m⁻² µm⁻¹]
    std::vector<double> sky;  // (node) cosine-weighted mean radiance [W m⁻² sr⁻¹ µm⁻¹]
};
/// Sunlight scattered by the scene's air at a band's nodes. Empty where there is none: without sun,
/// with the sun below the horizon, beyond 5 µm, in a vacuum and in a table of paths.
std::optional<SunField> scattered_sun(const RadianceInput& input, std::span<const double> node_um);

/// scattered  of the same nodes, or null: `sky` is then the heat of air and clouds alone
Light light_at(const RadianceInput& input, double height_km, std::span<const double> node_um,
               const SunField* scattered = nullptr);

/// Temperature [K] of what shines through a facet of a transparent material: the air of the room
/// behind it (Interior), else its own.
double temperature_behind(const Material& material, double facet_temperature);

/// Sunlit share × cosine / π [sr⁻¹]: times irradiance and reflectance, the radiance of sunlight.
double sunlight_on(const RadianceInput& input, FacetId facet);

/// Zenith angle [deg] below which a ray from `height_km` ends on the far plain of background_at().
double horizon_zenith_deg(const RadianceInput& input, double height_km);

/// Thermal radiance of the background in a direction in which the scene ends, per node
/// [W m⁻² sr⁻¹ µm⁻¹]: sky, or below the horizontal the air down to a far plain at the height of the
/// scene's origin, black and as warm as the air on it.
std::vector<double> background_at(const RadianceInput& input, double height_km, double zenith_deg,
                                  std::span<const double> node_um);
/// Sunlight that comes from there: of the sky, or of the air before the plain.
std::vector<double> scattered_background_at(const RadianceInput& input, const SunField& scattered,
                                            double height_km, double zenith_deg,
                                            double azimuth_from_sun_deg);
/// The same under several azimuths, (azimuth)(node): they cost little more than one.
std::vector<std::vector<double>> scattered_backgrounds_at(
    const RadianceInput& input, const SunField& scattered, double height_km, double zenith_deg,
    std::span<const double> azimuth_from_sun_deg);

/// Spectral radiance that leaves a facet, term by term, summed node by node: the reference that
/// the tables of tracer.hpp are measured against.
///
///     ε B(T) + ρ [f cosθ E_sun / π + V L_sky + Σ F_j J_j] + τ B(T_behind)
///
/// L_sky is the mean of air, clouds and the sunlight they scatter (diffuse irradiance / π).
///
/// V is the sky view, F the exchange row, scaled to 1 − V (so that ground beyond the scene's edge
/// looks like the surroundings that are there; like the facet itself if there are none). J_j is
/// the same sum for facet j, and so on; after `bounces` the surroundings count as black at the
/// facet's own temperature, so that an isothermal enclosure is exactly black. With two, what is
/// neglected is ρ ρ_j ρ_k (1 − V)(1 − V_j)(1 − V_k) times the difference of two black bodies.
/// `behind` is black at the temperature of the room behind (Interior), else of the facet.
///
/// scattered  scattered_sun() of these nodes; null: made for this call
/// returns    (term, node) [W m⁻² sr⁻¹ µm⁻¹]; Term::path is zero
std::array<std::vector<double>, term_count> leaving_radiance(const RadianceInput& input,
                                                             FacetId facet,
                                                             std::span<const double> node_um,
                                                             int bounces = 2,
                                                             const SunField* scattered = nullptr);

/// Band radiance [W m⁻² sr⁻¹] at the eye of a facet seen from `observer_height` [m] over a range,
/// term by term and node by node; heights [m] above the origin's level surface.
std::array<double, term_count> radiance_at_eye(const RadianceInput& input, const Band& band,
                                               double observer_height, FacetId facet, double range,
                                               double height, int segments = 0,
                                               const SunField* scattered = nullptr);

}  // namespace diurna
