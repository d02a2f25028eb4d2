#include "render/light/scene_light.hpp"

namespace diurna {

namespace {

std::vector<BounceOptions> bounces_of(std::span<const BandLight> bands, const LitFacets& lit,
                                      const TemperatureExtent& extent, int bounces,
                                      double tolerance) {
    std::vector<BounceOptions> options;
    for (std::size_t b = 0; b < bands.size(); ++b) {
        options.push_back(bounce_options(bands[b], extent, lit.bounds[b], bounces, tolerance));
    }
    return options;
}

}  // namespace

SceneLight::SceneLight(const RadianceInput& input_of, const LitFacets& lit_of,
                       std::span<const Band> bands, int most_bounces, double tolerance)
    : input(input_of),
      lit(lit_of),
      state(lit_state(input, lit, bands)),
      band(band_lights(bands, input, lit, state.extent)),
      bounces(bounces_of(band, lit, state.extent, most_bounces, tolerance)),
      tables(radiosity_tables(band, temperature_grid(state.extent.coldest, state.extent.hottest))),
      radiosity(lit, state, tables, band, bounces) {}

}  // namespace diurna
