#include "render/light/band_light.hpp"

#include "materials/base/parallel.hpp"
#include "render/light/incident_at_heights.hpp"

namespace diurna {

std::vector<BandLight> band_lights(std::span<const Band> bands, const RadianceInput& input,
                                   const LitFacets& lit, const TemperatureExtent& extent) {
    std::vector<BandLight> all(bands.size());
    for_each_index(
        bands.size(),
        [&](std::size_t b) {
            const Band& band = bands[b];
            BandLight& of = all[b];
            of.band = band;
            of.channels = channels_of(band);
            of.scattered = scattered_sun(input, band.node_um);
            of.incident = incident_at_heights(input, lit.height_km, band.node_um, of.sun_field());
            of.sky = sky_modes(band, of.incident);
            of.optics = node_optics(band, input.materials, lit.material_used);
            of.probe = probes(band, of.channels, input, of.incident[1], extent);
            of.far_ground =
                far_ground_light(input, band.node_um, lit.height_km, of.incident, of.sun_field());
            if (!from(of.far_ground, Origin::sunlight).empty()) {
                of.from_far_ground.emplace(onward_from_plain(input, band.node_um));
            }
            of.basis = scene_basis(band, of.optics, of.incident, lit.bounds[b].surrounded, extent);
        },
        1);
    return all;
}

}  // namespace diurna
