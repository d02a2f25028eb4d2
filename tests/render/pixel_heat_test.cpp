#include "render/view/pixel_heat.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "tests/support/box_shadow.hpp"

using namespace diurna;
using namespace diurna::testing;

namespace {

constexpr float shaded = 290.0f, sunlit = 315.0f;  // [K]

/// A facet as warm as its share of the sun makes it.
std::vector<float> by_share(const std::vector<float>& share) {
    std::vector<float> kelvins;
    for (const float s : share) kelvins.push_back(shaded + s * (sunlit - shaded));
    return kelvins;
}

struct Warmed {
    BoxStage::Picture picture;
    std::vector<float> kelvins;  // (entry) of the pixel

    Warmed(BoxStage& stage, const std::vector<float>& temperature) : picture(stage.picture()) {
        const RayScene rays(stage.facets);
        set_pixel_heat(picture.view, {rays, stage.facets, stage.fraction, stage.to_sun},
                       stage.materials, temperature, nullptr, picture.sun);
        for (std::size_t e = 0; e < picture.sun.sighting.size(); ++e) {
            kelvins.push_back(temperature[facet(e)] + picture.sun.warmer[e]);
        }
    }
    std::size_t facet(std::size_t e) const {
        return index(picture.view.surface[picture.view.sighting[picture.sun.sighting[e]].target]);
    }
};

}  // namespace

// Where heat has followed the sun at once, a place is as warm as its own share makes it.
TEST_CASE("a pixel is as warm as its share of the sun makes facets about it",
          "[render][pixel_heat]") {
    BoxStage stage(1.5, GENERATE(20.0, 50.0));
    stage.picture();  // for its shares
    const Warmed warmed(stage, by_share(stage.fraction));
    const std::vector<float> expected = by_share(warmed.picture.sun.share);
    std::size_t found = 0, ground = 0;
    for (std::size_t e = 0; e < expected.size(); ++e) {
        if (warmed.facet(e) >= stage.ground) continue;
        ++ground;
        found += std::abs(warmed.kelvins[e] - expected[e]) < 0.01f;
    }
    CAPTURE(found, ground);
    CHECK(found > 9 * ground / 10);  // others have no fully lit or shaded facet beside them
}

TEST_CASE("no pixel is colder or warmer than the facets about it", "[render][pixel_heat]") {
    BoxStage stage(1.0, 35.0);
    stage.picture();
    std::vector<float> temperature = by_share(stage.fraction);
    // Heat that lags: some facets are as the shadow left them.
    for (std::size_t f = 0; f < temperature.size(); f += 3) temperature[f] = 300.0f;
    const Warmed warmed(stage, temperature);
    const auto [low, high] = std::minmax_element(temperature.begin(), temperature.end());
    for (const float k : warmed.kelvins) {
        CHECK(k > *low - 0.01f);
        CHECK(k < *high + 0.01f);
    }
}

// Seen from straight above, where pixels are shares of area: a facet's pixels have its temperature
// in the mean. Their shares of the sun are samples, and so is the facet's, of 1024.
TEST_CASE("the mean over a facet stays", "[render][pixel_heat]") {
    BoxStage stage(2.0, 40.0);
    stage.sun_samples = 1024;
    stage.eye.projection = Projection::orthographic;
    stage.eye.picture_width = 40.0;
    stage.eye.width = stage.eye.height = 400;
    stage.eye.position = {0.0, 0.0, 50.0};
    stage.eye.elevation_deg = -90.0;
    stage.picture();
    const Warmed warmed(stage, by_share(stage.fraction));
    std::vector<double> sum(stage.facets.size()), area(sum), most(sum);
    for (std::size_t e = 0; e < warmed.kelvins.size(); ++e) {
        const double weight =
            warmed.picture.view.sighting[warmed.picture.sun.sighting[e]].weight * 0.01;
        const double warmer = warmed.picture.sun.warmer[e];
        sum[warmed.facet(e)] += weight * warmer;
        area[warmed.facet(e)] += weight;
        most[warmed.facet(e)] = std::max(most[warmed.facet(e)], std::abs(warmer));
    }
    int split = 0;
    for (std::size_t f = 0; f < stage.ground; ++f) {
        if (area[f] < 0.99 * double(stage.facets.area[f])) continue;  // the box hides some
        split += most[f] > 5.0;
        CHECK(std::abs(sum[f] / area[f]) < 0.02 * double(sunlit - shaded));
    }
    CHECK(split > 5);
}
