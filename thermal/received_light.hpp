#pragma once

#include <span>
#include <vector>

#include "materials/matter/library.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/receiver_views.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/heat_flux_field.hpp"
#include "thermal/temperature_field.hpp"
#include "thermal/weather/sky_state.hpp"

namespace diurna {

/// Radiosity of every facet at an instant, diffuse [W m⁻²].
struct LeavingLight {
    std::vector<float> sunlight;  // (facet) reflected
    std::vector<float> longwave;  // (facet) emitted and reflected
};

/// From a solved heat balance: emission ε σ T⁴ plus the part of the incident light that is not
/// absorbed. Incident sunlight is absorbed sunlight over 1 − albedo − transmittance, with the
/// albedo under snow and water as in the balance. Of see-through facets it is per area that stops
/// light. A facet that is transparent to all longwave, or absorbs no sunlight at all, has none.
///
/// - at: index of the instant in both fields, which have the same instants
/// - measured_albedo: (material) replaces its own at that instant; NaN or empty: its own
LeavingLight leaving_light(const FacetSet& facets, const MaterialLibrary& materials,
                           const TemperatureField& field, const HeatFluxField& heat, std::size_t at,
                           std::span<const double> measured_albedo = {});

/// Irradiance of a receiver [W m⁻²].
struct ReceivedLight {
    double sun = 0.0;        // beam, and the light around the sun that shares its shadow
    double sky = 0.0;        // the rest of the sky's sunlight
    double reflected = 0.0;  // sunlight from facets
    double sky_longwave = 0.0;
    double facet_longwave = 0.0;

    double shortwave() const { return sun + sky + reflected; }
    double longwave() const { return sky_longwave + facet_longwave; }
};

/// View of a receiver, thermal and solar (two if panes distinguish them), and the ground beyond the
/// scene's edge: the mean of these facets.
struct ReceiverView {
    const FacetViews& heat;
    const FacetViews& sunlight;
    std::span<const float> beyond;  // (facet) weights that add up to one; empty: black and cold
};

/// Irradiance of receiver r from the same sky, sky shares and facets as in the heat balance.
///
/// - seen: normal · to_sun, not below 0, times the share of the sun's disc in view
ReceivedLight received_light(const ReceiverView& view, std::size_t r, double seen,
                             const SkyState& sky, const LeavingLight& leaving);

/// Mean radiant temperature [K] of a standing person (Höppe 1992; VDI 3787): absorptance 0.7 in
/// sunlight, 0.97 in longwave, weights 0.22 for each side, 0.06 up and down.
///
/// - shortwave, longwave: from above, from below, from north, east, south and west [W m⁻²]
double mean_radiant_temperature(std::span<const double, 6> shortwave,
                                std::span<const double, 6> longwave);

}  // namespace diurna
