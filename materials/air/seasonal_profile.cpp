#include "materials/air/seasonal_profile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace diurna {

namespace {

/// From the coldest to the warmest, at every height up to 5 km.
constexpr std::array<const char*, 5> by_warmth = {"SAW", "MLW", "SAS", "MLS", "TROP"};

double logarithmic(double from, double to, double share) {
    constexpr double least = 1e-12;
    return std::exp(
        std::lerp(std::log(std::max(from, least)), std::log(std::max(to, least)), share));
}

/// Both on the same levels, as all AFGL models are.
Profile between(const Profile& cold, const Profile& warm, double share) {
    Profile profile = share < 0.5 ? cold : warm;
    profile.name = fmt::format("{:.0f} % {}, {:.0f} % {}", 100.0 * (1.0 - share), cold.name,
                               100.0 * share, warm.name);
    for (std::size_t i = 0; i < profile.height_km.size(); ++i) {
        profile.temperature[i] = std::lerp(cold.temperature[i], warm.temperature[i], share);
        profile.pressure_hPa[i] = logarithmic(cold.pressure_hPa[i], warm.pressure_hPa[i], share);
        for (std::size_t gas = 0; gas < gas_count; ++gas) {
            profile.mixing_ratio_ppm[gas][i] =
                logarithmic(cold.mixing_ratio_ppm[gas][i], warm.mixing_ratio_ppm[gas][i], share);
        }
    }
    return profile;
}

}  // namespace

Profile seasonal_profile(double height_km, double temperature) {
    const double at = std::clamp(height_km, 0.0, 5.0);
    Profile cold = afgl_profile(by_warmth.front());
    double cold_K = pressure_and_temperature_at(cold, at).second;
    if (!(temperature > cold_K)) return cold;
    for (std::size_t i = 1; i < by_warmth.size(); ++i) {
        Profile warm = afgl_profile(by_warmth[i]);
        const double warm_K = pressure_and_temperature_at(warm, at).second;
        if (temperature < warm_K) {
            return between(cold, warm, (temperature - cold_K) / (warm_K - cold_K));
        }
        cold = std::move(warm);
        cold_K = warm_K;
    }
    return cold;
}

}  // namespace diurna
