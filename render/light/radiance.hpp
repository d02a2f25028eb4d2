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

// The reference that the tables of a picture are measured against: every term of a facet's radiance
// summed node by node, with nothing tabulated. The program itself does not call it; the tests do.

/// (term, node) [W m⁻² sr⁻¹ µm⁻¹]
using NodeTerms = std::array<std::vector<double>, term_count>;

/// The radiosity of a facet as radiance (over π), term by term:
///
///     J = ε B(T) + ρ [f cosθ E_sun / π + V L_sky + Σ F_j J_j] + τ B(T_behind)
///
/// V L_sky stands for what the open sky of the facet sends, air, clouds and the sunlight they
/// scatter, by direction (directional_sky.hpp); what is scattered next to the sun is in E_sun.
///
/// V is the sky view, F its row of view factors, scaled to 1 − V (so that ground beyond the scene's
/// edge looks like the surroundings that are there; like the facet itself if there are none). J_j
/// is the same sum for facet j, and so on; after `bounces` the surroundings count as black at the
/// facet's own temperature, so that an isothermal enclosure is exactly black. With two, what is
/// neglected is ρ ρ_j ρ_k (1 − V)(1 − V_j)(1 − V_k) times the difference of two black bodies.
/// `behind` is black at the temperature of the room behind (Interior), else of the facet.
///
/// - scattered: scattered_sun() of these nodes; null: made for this call
/// - returns: Term::path is zero
NodeTerms radiosity_terms(const RadianceInput& input, FacetId facet,
                          std::span<const double> node_um, int bounces = 2,
                          const ScatteredSun* scattered = nullptr);

/// The same taken apart by where the light was before: (term)(origin)(node).
using TermsByOrigin = std::array<LightByOrigin, term_count>;
TermsByOrigin radiosity_by_origin(const RadianceInput& input, FacetId facet,
                                  std::span<const double> node_um, int bounces = 2,
                                  const ScatteredSun* scattered = nullptr);

/// Share of the light of each origin at a place that arrives at the eye, (origin)(node), both of
/// its ways taken for one path:
///
///     surface   transmittance of the way to the eye
///     sunlight  the direct sun's, of both ways over that of the first
///     sky_heat  of the mean sky
///
/// - line: from the eye to the place
LightByOrigin onward_shares(const RadianceInput& input, const SightLine& line, double height_km,
                            std::span<const double> node_um);

/// A facet as an observer sees it [m]; heights above the origin's level surface.
struct FacetSight {
    double observer_height;
    FacetId facet;
    double range, height;
};
/// Band radiance [W m⁻² sr⁻¹] at the eye, term by term: J through the air of the way, each origin's
/// share of it, and what that air sends itself.
std::array<double, term_count> radiance_at_eye(const RadianceInput& input, const Band& band,
                                               const FacetSight& sight, int segments = 0,
                                               const ScatteredSun* scattered = nullptr);

/// sunlight_on() of a facet of the scene.
double sunlight_on(const RadianceInput& input, FacetId facet);

}  // namespace diurna
