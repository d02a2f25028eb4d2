#include "render/light/scene_basis.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <tuple>
#include <vector>

#include "materials/radiation/planck.hpp"
#include "render/light/node_spectra.hpp"

namespace diurna {

namespace {

using Spectra = std::vector<std::vector<double>>;
using ThreeHeights = std::array<IncidentLight, 3>;

/// Black bodies over the scene's temperatures; the first at the middle one.
Spectra black_bodies(const Band& band, const TemperatureExtent& extent) {
    const double cold = extent.coldest, hot = extent.hottest;
    Spectra black = {black_body(band, extent.middle())};
    // Denser at both ends, where a polynomial through the samples errs most.
    constexpr int steps = 12;
    for (int s = 0; s <= steps; ++s) {
        const double place = 0.5 - 0.5 * std::cos(std::numbers::pi * s / steps);
        black.push_back(black_body(band, cold + (hot - cold) * place));
    }
    return black;
}

/// Light of sky and sun reflected once by a material, at the least and the greatest height, and of
/// the sky that walls see.
std::vector<LightByOrigin> reflected_once(const NodeOptics& optics, const ThreeHeights& incident) {
    std::vector<LightByOrigin> once;
    for (const std::size_t h : {std::size_t{0}, std::size_t{2}}) {
        once.push_back(times(optics.reflectance, incident[h].sky_by_origin()));
        once.push_back(times(optics.reflectance, incident[h].sun_by_origin()));
        for (double& x : from(once.back(), Origin::sunlight)) x /= std::numbers::pi;
    }
    for (const bool sunward : {false, true}) {
        const LightByOrigin wall = incident[1].sky_on(0.5, uneven_view_of_wall(sunward));
        once.push_back(times(optics.reflectance, wall));
    }
    return once;
}

/// The greatest radiance of sunlight that a material reflects [W m⁻² sr⁻¹].
double greatest_sunlit(const Band& band, std::span<const NodeOptics> optics,
                       const ThreeHeights& incident) {
    double sunlit = 0.0;
    for (const NodeOptics& a : optics) {
        if (a.reflectance.empty()) continue;
        for (const LightByOrigin& light : reflected_once(a, incident)) {
            const std::vector<double>& sun = from(light, Origin::sunlight);
            if (!sun.empty()) sunlit = std::max(sunlit, band_sum_nodes(band, sun));
        }
    }
    return sunlit;
}

/// Light that radiosities are sums of: emitted, reflected once, reflected twice.
///
/// - black: black_bodies()
std::vector<LightByOrigin> radiosity_samples(std::span<const NodeOptics> optics,
                                             const ThreeHeights& incident, const Spectra& black) {
    std::vector<LightByOrigin> samples;
    const std::array<const std::vector<double>*, 3> heat = {&black[1], &black[0], &black.back()};
    for (const NodeOptics& a : optics) {
        if (a.reflectance.empty()) continue;
        for (const auto* b : heat) {
            samples.push_back(from_surface(times(a.emissivity, *b)));
            samples.push_back(from_surface(times(a.reflectance, *b)));
        }
        if (!a.room.empty()) samples.push_back(from_surface(a.room));
        const auto once = reflected_once(a, incident);
        for (const NodeOptics& b : optics) {
            if (b.reflectance.empty()) continue;
            for (const LightByOrigin& light : once) samples.push_back(times(b.reflectance, light));
            samples.push_back(from_surface(times(b.reflectance, times(a.reflectance, black[0]))));
        }
        samples.insert(samples.end(), once.begin(), once.end());
    }
    return samples;
}

/// What becomes of light that arrives: what a facet reflects reaches the eye through the air, as it
/// is, and where the air lets through what the sky does not send.
Spectra receivers_of(std::span<const NodeOptics> optics, const IncidentLight& light,
                     std::span<const double> black, double surrounded) {
    Spectra receivers;
    for (const NodeOptics& a : optics) {
        if (a.reflectance.empty()) continue;
        receivers.push_back(a.reflectance);
        for (double& x : receivers.back()) x *= surrounded;
        receivers.push_back(receivers.back());
        for (std::size_t n = 0; n < receivers.back().size(); ++n) {
            const double share = black[n] > 0.0 ? light.sky[n] / black[n] : 1.0;
            receivers.back()[n] *= std::clamp(1.0 - share, 0.0, 1.0);
        }
    }
    return receivers;
}

/// Those that are used and differ from all before them. Samples go with the square of their number,
/// and the parts of twenty trucks are three hundred materials of fifteen finishes.
std::vector<NodeOptics> distinct(std::span<const NodeOptics> optics) {
    using Key = std::tuple<std::vector<double>, std::vector<double>, std::vector<double>>;
    std::set<Key> known;
    std::vector<NodeOptics> some;
    for (const NodeOptics& a : optics) {
        if (a.reflectance.empty()) continue;
        if (known.emplace(a.reflectance, a.emissivity, a.room).second) some.push_back(a);
    }
    return some;
}

}  // namespace

SpectralBasis scene_basis(const Band& band, std::span<const NodeOptics> all_optics,
                          const ThreeHeights& incident, float surrounded,
                          const TemperatureExtent& extent) {
    const std::vector<NodeOptics> optics = distinct(all_optics);
    const Spectra black = black_bodies(band, extent);
    const auto samples = radiosity_samples(optics, incident, black);
    const Spectra receivers = receivers_of(optics, incident[1], black[0], double{surrounded});
    const double sunlit = greatest_sunlit(band, optics, incident);
    // Σ w f g ≤ √(Σ w f²) √(Σ w g²): a rest of norm r contributes at most r √width.
    const double width = std::sqrt(std::max(1e-30, band.width_um()));
    const double kelvin = band_radiance_derivative(band, double{extent.coldest});
    const double fine = std::max(1e-4 * kelvin, 1e-8 * sunlit) / width;
    return spectral_basis(band, black, fine, samples, receivers,
                          std::max(2e-4 * kelvin, 1e-7 * sunlit));
}

std::vector<Probe> probes(const Band& band, const Channels& channels, const RadianceInput& input,
                          const IncidentLight& light, const TemperatureExtent& extent) {
    std::vector<Probe> all = {{channel_sums(band, channels, black_body(band, extent.coldest)), {}},
                              {channel_sums(band, channels, black_body(band, extent.hottest)), {}}};
    all.push_back(all.front());
    for (float& x : all.back().heat) x *= 0.2f;
    if (input.sun_fraction.empty() || input.sun_zenith_deg >= 90.0) return all;
    // Where sunlight exceeds heat, an error corresponds to more kelvins.
    std::vector<double> sunlit(band.node_um.size());
    for (std::size_t n = 0; n < sunlit.size(); ++n) {
        sunlit[n] = 0.1 * (light.sun[n] / std::numbers::pi + light.sky[n]);
    }
    all.push_back({all.front().heat, channel_sums(band, channels, sunlit)});
    return all;
}

}  // namespace diurna
