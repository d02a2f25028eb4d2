#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "materials/atmosphere/beam_aerosol.hpp"
#include "materials/atmosphere/ground_fluxes.hpp"
#include "materials/atmosphere/ground_sky.hpp"
#include "materials/atmosphere/scaled_aerosol.hpp"
#include "materials/atmosphere/sun_field.hpp"

// Results that are computed once and reused equal those computed each time.

using namespace diurna;

namespace {

BandModel hazy(const std::string& aerosol, double visibility_km) {
    return {.profile = afgl_profile("MLS"), .aerosol = aerosol, .visibility_km = visibility_km};
}

}  // namespace

TEST_CASE("aerosol gathered by humidity is the sum over segments of what each holds",
          "[materials][light]") {
    BandModel model = hazy(GENERATE("rural", "desert", "fog_advective", "none"), 8.0);
    model.rain_mm_h = GENERATE(0.0, 4.0);
    const Medium medium(model, bins_of(sunlight_band().node_um));
    const SightLine line = line_of(model, 0.05, 70.0);
    BeamAerosol gathered(medium);
    const std::size_t bins = medium.bins().size();
    std::vector<double> scaled(bins, 0.0), peak(bins, 0.0), sum(bins, 0.0), peak_sum(bins, 0.0);
    for (std::size_t i = 0; i < line.size(); ++i) {
        gathered.add(line.height_km[i], line.length_km[i]);
        const ScaledAerosol here = scaled_aerosol(medium, line.height_km[i]);
        for (std::size_t b = 0; b < bins; ++b) {
            sum[b] += line.length_km[i] * here.extinction[b];
            peak_sum[b] += line.length_km[i] * here.peak(b);
        }
    }
    gathered.put(scaled, peak);
    double worst = 0.0;
    for (std::size_t b = 0; b < bins; ++b) {
        worst = std::max({worst, std::abs(scaled[b] - sum[b]) / std::max(sum[b], 1e-6),
                          std::abs(peak[b] - peak_sum[b]) / std::max(peak_sum[b], 1e-6)});
    }
    CAPTURE(model.aerosol, model.rain_mm_h);
    CHECK(worst < 1e-6);
    if (model.aerosol != "none") CHECK(sum[0] > 0.01);
}

TEST_CASE("longwave under a share of cloud and a scale is that of the model with both",
          "[materials][light]") {
    BandModel model = hazy("rural", 23.0);
    model.cloud.fraction = 0.6;
    model.cloud.base_km = 1.4;
    GroundSky sky(model, 0.1);
    for (const double share : {0.0, 0.25, 0.6}) {
        for (const double column : {1.0, 0.4, 1.7}) {
            BandModel same = model;
            same.cloud.emissivity = share / model.cloud.fraction;
            same.scale.sky_column = column;
            same.scale.sky_heat = column > 1.0 ? 1.05 : 1.0;
            CAPTURE(share, column);
            CHECK(sky.longwave(share, same.scale) ==
                  Approx(ground_longwave(same, 0.1)).epsilon(1e-10));
        }
    }
}

TEST_CASE("sunlight under another cloud is that of air made with it", "[materials][light]") {
    BandModel model = hazy("rural", 15.0);
    const SunLight sun{.zenith_deg = 55.0};
    const std::vector<double> um = {0.45, 0.65, 0.9, 1.6, 2.2, 3.8};
    model.cloud.sunlit_fraction = 0.0;
    const SunField clear(model, sun, um);
    model.cloud = {.fraction = 0.5, .base_km = 1.2, .optical_depth = 6.0, .sunlit_fraction = 0.7};
    const SunField made(model, sun, um), changed = clear.under(model.cloud);
    for (const double height_km : {0.0, 0.4, 3.0}) {
        const SunFlux a = made.flux(height_km), b = changed.flux(height_km);
        for (std::size_t n = 0; n < um.size(); ++n) {
            CHECK(b.direct[n] == a.direct[n]);
            CHECK(b.down[n] == a.down[n]);
            CHECK(b.up[n] == a.up[n]);
        }
        CHECK(changed.sky(height_km, 40.0, 90.0) == made.sky(height_km, 40.0, 90.0));
    }
    // It is another light than the clear sky's, or nothing would have been compared.
    CHECK(made.flux(0.0).direct[1] < 0.5 * clear.flux(0.0).direct[1]);
}
