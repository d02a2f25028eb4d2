#include "render/light/scene_light.hpp"

namespace diurna {

namespace {

std::vector<BounceOptions> bounces_of(std::span<const BandLight> bands,
                                      const TemperatureExtent& extent, int bounces,
                                      double tolerance) {
    std::vector<BounceOptions> options;
    for (const BandLight& band : bands) {
        options.push_back(bounce_options(band, extent, bounces, tolerance));
    }
    return options;
}

}  // namespace

SceneLight::SceneLight(const RadianceInput& input_of, const LitFacets& lit_of,
                       std::span<const Band> bands, int most_bounces, double tolerance)
    : input(input_of),
      lit(lit_of),
      state(lit_state(input, lit)),
      band(band_lights(bands, input, lit, state.extent)),
      bounces(bounces_of(band, state.extent, most_bounces, tolerance)),
      tables(radiosity_tables(band, temperature_grid(state.extent.coldest, state.extent.hottest))),
      radiosity(lit, state, tables, bounces) {}

}  // namespace diurna
