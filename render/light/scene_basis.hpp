#pragma once

#include <array>
#include <span>
#include <vector>

#include "render/light/band_channels.hpp"
#include "render/light/incident_light.hpp"
#include "render/light/lit_facets.hpp"
#include "render/light/node_optics.hpp"
#include "render/light/spectral_basis.hpp"

namespace diurna {

/// Modes for the radiosities of a scene's surfaces in a band: black bodies to 0.1 mK at the scene's
/// cold end, and a visible facet's reflection of its surroundings to 0.2 mK, or 1e-7 of the
/// reflected sunlight, whichever is more.
///
/// - incident: at the three heights of LitFacets
/// - surrounded: the largest 1 − sky view of a visible facet (ReflectionBounds)
SpectralBasis scene_basis(const Band& band, std::span<const NodeOptics> optics,
                          const std::array<IncidentLight, 3>& incident, float surrounded,
                          const TemperatureExtent& extent);

/// Radiance per channel of a representative surface of the scene.
struct Probe {
    std::vector<float> heat;      // (channel) emitted
    std::vector<float> sunlight;  // (channel) reflected; empty: none
};
/// Black bodies at the scene's lowest and highest temperature, a mirror of a cold sky, and by day a
/// white surface in the sun.
std::vector<Probe> probes(const Band& band, const Channels& channels, const RadianceInput& input,
                          const IncidentLight& light, const TemperatureExtent& extent);

}  // namespace diurna
