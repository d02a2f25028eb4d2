#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "materials/atmosphere/onward_light.hpp"
#include "materials/radiation/band.hpp"
#include "render/light/band_channels.hpp"
#include "render/light/far_ground.hpp"
#include "render/light/incident_light.hpp"
#include "render/light/lit_facets.hpp"
#include "render/light/node_optics.hpp"
#include "render/light/scene_basis.hpp"
#include "render/light/sky_modes.hpp"
#include "render/light/spectral_basis.hpp"

namespace diurna {

/// All quantities of a band at an instant that do not depend on the facet.
struct BandLight {
    Band band;
    Channels channels = {};
    std::optional<ScatteredSun> scattered = {};  // sunlight scattered by the air
    std::array<IncidentLight, 3> incident = {};  // at the heights of LitFacets
    SkyModes sky = {};                           // of these
    std::vector<NodeOptics> optics = {};         // (material)
    std::vector<Probe> probe = {};               // probes()
    SpectralBasis basis = {};
    LightByOrigin far_ground = {};                    // far_ground_light(); empty: there is none
    std::optional<OnwardLight> from_far_ground = {};  // its sunlight; empty: it has none

    const ScatteredSun* sun_field() const { return scattered ? &*scattered : nullptr; }
    const OnwardLight* from_plain() const { return from_far_ground ? &*from_far_ground : nullptr; }
};
/// - extent: of the temperatures of the facets lit
std::vector<BandLight> band_lights(std::span<const Band> bands, const RadianceInput& input,
                                   const LitFacets& lit, const TemperatureExtent& extent);

}  // namespace diurna
