#include "materials/atmosphere/cloud_modification.hpp"

#include <algorithm>
#include <cmath>

#include "materials/atmosphere/sunlit_air.hpp"

namespace diurna {

namespace {

constexpr double usual_albedo = 0.2;
constexpr double thinnest = 0.05, thickest = 300.0;
constexpr double lowest_sun_cosine = 0.05;
constexpr double no_beam = 3e-3;  // of the clear sky's: less says no more of the depth

}  // namespace

CloudEffect kasten_czeplak(double cover) {
    const double c = std::clamp(cover, 0.0, 1.0);
    const double global = 1.0 - 0.75 * std::pow(c, 3.4);
    return {.global = global, .beam = global * (1.0 - c * c)};
}

double cloud_transmittance(double optical_depth, double sun_cosine) {
    const double mu = std::max(sun_cosine, lowest_sun_cosine);
    const double back = (1.0 - cloud_asymmetry) * optical_depth;
    const double alone =
        (2.0 + 3.0 * mu + (2.0 - 3.0 * mu) * std::exp(-optical_depth / mu)) / (4.0 + 3.0 * back);
    // What the ground sends up comes back from the cloud again and again.
    const double above = 0.75 * back / (1.0 + 0.75 * back);
    return std::min(1.0, alone / (1.0 - usual_albedo * above));
}

SunlitCloud cloud_of_effect(const CloudEffect& effect, double sun_cosine) {
    const double mu = std::max(sun_cosine, lowest_sun_cosine);
    const double beam = std::clamp(effect.beam, 0.0, 1.0);
    if (beam >= 1.0) return {};
    // (T53) of docs/theory.md
    const auto lost = [&](double depth) { return -std::expm1(-depth / mu); };
    // Of the same loss of beam thicker clouds over less of the sky take more of the global light.
    const double wanted = (1.0 - std::clamp(effect.global, 0.0, 1.0)) / (1.0 - beam);
    double low = std::clamp(-mu * std::log(std::max(beam, no_beam)), thinnest, thickest);
    double high = thickest;
    for (int i = 0; i < 50; ++i) {
        const double middle = std::sqrt(low * high);
        const double taken = (1.0 - cloud_transmittance(middle, mu)) / lost(middle);
        (taken < wanted ? low : high) = middle;
    }
    const double depth = std::sqrt(low * high);
    return {.fraction = std::min(1.0, (1.0 - beam) / lost(depth)), .optical_depth = depth};
}

}  // namespace diurna
