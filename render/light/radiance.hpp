#pragma once

#include <array>
#include <span>
#include <vector>

#include "materials/air/sight_line.hpp"
#include "materials/radiation/band.hpp"
#include "render/light/incident_light.hpp"
#include "render/light/origin.hpp"
#include "render/light/radiance_input.hpp"
#include "render/light/radiance_terms.hpp"

namespace diurna {

// Reference for the tables of a picture: every term of a facet's radiance summed node by node,
// without tables. Used by the tests only.

/// (term, node) [W m⁻² sr⁻¹ µm⁻¹]
using NodeTerms = std::array<std::vector<double>, term_count>;

/// The radiosity of a facet as radiance (over π), term by term:
///
///     J = ε B(T) + ρ [f cosθ E_sun / π + V L_sky + Σ F_j J_j] + τ B(T_behind)
///
/// V L_sky is the light of the facet's visible sky, air, clouds and the sunlight they scatter, by
/// direction (directional_sky.hpp); scattered light close to the sun is in E_sun.
///
/// V is the sky view, F its row of view factors, scaled to 1 − V (so ground beyond the scene's edge
/// looks like the visible surroundings, or like the facet itself without any). J_j is the same sum
/// for facet j, and so on; after `bounces` the surroundings count as black at the facet's own
/// temperature, so that an isothermal enclosure is exactly black. With two, the neglected part is ρ
/// ρ_j ρ_k (1 − V)(1 − V_j)(1 − V_k) times the difference of two black bodies. `behind` is black at
/// the temperature of the room behind (Interior), else of the facet.
///
/// - scattered: scattered_sun() of these nodes; null: computed here
/// - returns: Term::path is zero
NodeTerms radiosity_terms(const RadianceInput& input, SurfaceId facet,
                          std::span<const double> node_um, int bounces = 2,
                          const ScatteredSun* scattered = nullptr);

/// The same by origin of the light: (term)(origin)(node).
using TermsByOrigin = std::array<LightByOrigin, term_count>;
TermsByOrigin radiosity_by_origin(const RadianceInput& input, SurfaceId facet,
                                  std::span<const double> node_um, int bounces = 2,
                                  const ScatteredSun* scattered = nullptr);

/// Share of the light of each origin at a place that arrives at the eye, (origin)(node), with both
/// parts of its way treated as one path:
///
///     surface   transmittance of the path to the eye
///     sunlight  direct sun over both paths, divided by that over the first
///     sky_heat  the same for the mean sky
///
/// - line: from the eye to the place
LightByOrigin onward_shares(const RadianceInput& input, const SightLine& line, double height_km,
                            std::span<const double> node_um);

/// A facet as an observer sees it [m]; heights above the origin's level surface.
struct FacetSight {
    double observer_height;
    SurfaceId facet;
    double range, height;
};
/// Band radiance [W m⁻² sr⁻¹] at the eye, term by term: J attenuated by the air, by origin, plus
/// the emission of that air.
std::array<double, term_count> radiance_at_eye(const RadianceInput& input, const Band& band,
                                               const FacetSight& sight, int segments = 0,
                                               const ScatteredSun* scattered = nullptr);

/// sunlight_on() of a facet of the scene.
double sunlight_on(const RadianceInput& input, SurfaceId facet);

}  // namespace diurna
