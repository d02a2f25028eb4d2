#include "render/light/scene_basis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

using Spectra = std::vector<std::vector<double>>;

std::vector<double> black_body(const Band& band, double temperature) {
    std::vector<double> b(band.node_um.size());
    for (std::size_t n = 0; n < b.size(); ++n) b[n] = planck(band.node_um[n], temperature);
    return b;
}

std::vector<double> times(std::span<const double> a, std::span<const double> b) {
    std::vector<double> out(a.size());
    std::transform(a.begin(), a.end(), b.begin(), out.begin(), std::multiplies<>());
    return out;
}

/// Difference of what two surroundings can send, from above [W m⁻² sr⁻¹].
double greatest_contrast(const Band& band, const TemperatureExtent& extent, const Light& light,
                         bool scattered) {
    const double warmth =
        band_radiance(band, double{extent.hottest}) - band_radiance(band, double{extent.coldest});
    return warmth + band_sum_nodes(band, light.sun) / std::numbers::pi +
           (scattered ? band_sum_nodes(band, light.sky) : 0.0);
}

}  // namespace

SpectralBasis scene_basis(const Band& band, std::span<const NodeOptics> optics,
                          const std::array<Light, 3>& light, const LitFacets::Worth& worth,
                          const TemperatureExtent& extent) {
    const double cold = extent.coldest, hot = extent.hottest, middle = extent.middle();
    Spectra black = {black_body(band, middle)};
    // Denser at both ends, where a polynomial through the samples errs most.
    constexpr int steps = 12;
    for (int s = 0; s <= steps; ++s) {
        const double place = 0.5 - 0.5 * std::cos(std::numbers::pi * s / steps);
        black.push_back(black_body(band, cold + (hot - cold) * place));
    }
    Spectra sent;
    double sunlit = 0.0;
    const std::array<const std::vector<double>*, 3> heat = {&black[1], &black[0], &black.back()};
    for (const NodeOptics& a : optics) {
        if (a.reflectance.empty()) continue;
        for (const auto* b : heat) {
            sent.push_back(times(a.emissivity, *b));
            sent.push_back(times(a.reflectance, *b));
        }
        if (!a.room.empty()) sent.push_back(a.room);
        Spectra once;
        for (const std::size_t h : {std::size_t{0}, std::size_t{2}}) {
            once.push_back(times(a.reflectance, light[h].sky));
            once.push_back(times(a.reflectance, light[h].sun));
            for (double& x : once.back()) x /= std::numbers::pi;
            sunlit = std::max(sunlit, band_sum_nodes(band, once.back()));
        }
        // Light reflected twice.
        for (const NodeOptics& b : optics) {
            if (b.reflectance.empty()) continue;
            for (const auto& spectrum : once) sent.push_back(times(b.reflectance, spectrum));
            sent.push_back(times(b.reflectance, times(a.reflectance, black[0])));
        }
        sent.insert(sent.end(), once.begin(), once.end());
    }
    // What a facet reflects reaches the eye through the air: as it is, and where the air lets
    // through what the sky does not send.
    Spectra receivers;
    for (const NodeOptics& a : optics) {
        if (a.reflectance.empty()) continue;
        receivers.push_back(a.reflectance);
        for (double& x : receivers.back()) x *= worth.closed;
        receivers.push_back(receivers.back());
        for (std::size_t n = 0; n < receivers.back().size(); ++n) {
            const double share = black[0][n] > 0.0 ? light[1].sky[n] / black[0][n] : 1.0;
            receivers.back()[n] *= std::clamp(1.0 - share, 0.0, 1.0);
        }
    }
    // Σ w f g ≤ √(Σ w f²) √(Σ w g²): a rest of norm r is worth at most r √width.
    const double width = std::sqrt(std::max(1e-30, band.width_um()));
    const double kelvin = band_radiance_derivative(band, cold);
    const double fine = std::max(1e-4 * kelvin, 1e-8 * sunlit) / width;
    return spectral_basis(band, black, fine, sent, receivers,
                          std::max(2e-4 * kelvin, 1e-7 * sunlit));
}

std::vector<std::vector<float>> probes(const Band& band, const Channels& channels,
                                       const RadianceInput& input, const Light& light,
                                       const TemperatureExtent& extent) {
    const std::vector<double> one(band.node_um.size(), 1.0);
    std::vector<std::vector<float>> all = {
        channel_sums(band, channels, one, black_body(band, extent.coldest)),
        channel_sums(band, channels, one, black_body(band, extent.hottest))};
    all.push_back(all.front());
    for (float& x : all.back()) x *= 0.2f;
    if (input.sun_fraction.empty() || input.sun_zenith_deg >= 90.0) return all;
    // Where sunlight outshines heat, an error is worth more kelvins.
    std::vector<double> sunlit(one.size());
    for (std::size_t n = 0; n < sunlit.size(); ++n) {
        sunlit[n] = 0.1 * (light.sun[n] / std::numbers::pi + light.sky[n]);
    }
    all.push_back(channel_sums(band, channels, one, sunlit));
    for (std::size_t c = 0; c < all.back().size(); ++c) all.back()[c] += all.front()[c];
    return all;
}

BounceOptions bounce_options(const Band& band, const TemperatureExtent& extent, const Light& light,
                             bool scattered, int bounces, double tolerance) {
    const double slope = band_radiance_derivative(band, double{extent.coldest});
    const double contrast = greatest_contrast(band, extent, light, scattered);
    return {.bounces = bounces,
            .tolerance = static_cast<float>(tolerance),
            .most_change =
                static_cast<float>(std::clamp(contrast / std::max(slope, 1e-300), 1e-3, 1e30))};
}

double left_over(const Band& band, const TemperatureExtent& extent, const Light& light,
                 bool scattered, const LitFacets::Worth& worth, int bounces,
                 const BounceOptions& options) {
    const double contrast = greatest_contrast(band, extent, light, scattered);
    const float most_twice =
        worth.twice.empty() ? 0.0f : *std::max_element(worth.twice.begin(), worth.twice.end());
    if (bounces < 2) return contrast * double{most_twice};
    const double skipped = double{options.tolerance} / double{options.most_change};
    return contrast * (double{worth.thrice} + std::min(skipped, double{most_twice}));
}

}  // namespace diurna
