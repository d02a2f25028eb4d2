#include "materials/atmosphere/light_of_instant.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "materials/atmosphere/cloud_modification.hpp"
#include "materials/atmosphere/ground_sky.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr double least_light = 1e-3;  // [W m⁻²] of the model's: less is no shape to scale
constexpr double shut_out = 3e-3;     // of the clear sky's

/// The model with a share of black cloud in its sky, seen as thinner cloud over what was observed.
BandModel with_black_share(const BandModel& model, double share) {
    BandModel clouded = model;
    clouded.cloud.fraction = std::max(model.cloud.fraction, share);
    clouded.cloud.emissivity =
        clouded.cloud.fraction > 0.0 ? share / clouded.cloud.fraction : model.cloud.emissivity;
    return clouded;
}

/// - most_cloud: share of cloud that sunlight allows
/// - got: written: the longwave of what is returned
BandModel with_longwave(const BandModel& model, double height_km, double wanted, double most_cloud,
                        double& got) {
    const LightScale as_is{};
    std::optional<GroundSky> sky(std::in_place, model, height_km);
    const double clear = sky->longwave(0.0, as_is);
    double share = 0.0;
    if (wanted > clear && most_cloud > 0.0) {
        const double full = sky->longwave(1.0, as_is);
        if (full > clear + 1.0)
            share = std::clamp((wanted - clear) / (full - clear), 0.0, most_cloud);
    }
    BandModel fitted = with_black_share(model, share);
    if (share > 0.0 && model.cloud.fraction <= 0.0) sky.emplace(fitted, height_km);
    const auto longwave = [&] { return sky->longwave(share, fitted.scale); };
    fitted.scale.sky_column = fitted.scale.sky_heat = 1.0;
    got = longwave();
    constexpr double close = 0.05;  // [W m⁻²]
    if (std::abs(got - wanted) < close) return fitted;
    // Secants in the logarithm of the column, which longwave rises with.
    const double least = std::log(0.02), most = std::log(50.0);
    double last = 0.0, last_got = got, here = got < wanted ? 0.2 : -0.2;
    double& now = got;
    for (int i = 0; i < 12; ++i) {
        fitted.scale.sky_column = std::exp(here);
        now = longwave();
        const double slope = (now - last_got) / (here - last);
        if (std::abs(now - wanted) < close || !(slope > 0.0)) break;
        last = here;
        last_got = now;
        const double next = here + std::clamp((wanted - now) / slope, -1.5, 1.5);
        here = std::clamp(next, least, most);
        if (here == last) break;
    }
    if (std::abs(now - wanted) < close) return fitted;
    // Longwave is linear in the grey factor; beyond 28 µm it is the air's near by.
    fitted.scale.sky_heat = 1.1;
    const double slope = (longwave() - now) / 0.1;
    fitted.scale.sky_heat = slope > 0.0 ? std::max(0.0, 1.0 + (wanted - now) / slope) : 1.0;
    got = longwave();
    return fitted;
}

/// 1 where the model has too little to be scaled.
double scale_of(double wanted, double own) {
    return own > least_light ? std::max(0.0, wanted) / own : 1.0;
}

/// Sunlight under a cloudless sky.
SunField clear_sunlight(const BandModel& model, const SunLight& sun) {
    BandModel clear = model;
    clear.cloud.sunlit_fraction = 0.0;
    return {clear, sun, sunlight_band().node_um};
}

/// The share of the sky that can be cloud where so much of the clear model's beam is left: a warm
/// sky behind a clear beam is warm air, not cloud. All of it under a sun too low to tell.
double cloud_allowed(const SunField* clear, const SunLight& sun, double height_km, double beam) {
    constexpr double lowest_sun_deg = 5.0;
    if (sun.zenith_deg > 90.0 - lowest_sun_deg || clear == nullptr || std::isnan(beam)) return 1.0;
    const double own = ground_sunlight(*clear, height_km).sun_direct;
    return 1.0 - std::clamp(scale_of(beam, own), 0.0, 1.0);
}

/// An overcast made as thick as its diffuse light says, so that none is left for a grey factor:
/// what it sends back is then what it does not pass or absorb.
void fit_depth(const SunField& clear, double height_km, double diffuse, BandModel& fitted,
               GroundFluxes& sums) {
    constexpr double close = 0.02, thinnest = 0.05, thickest = 300.0;
    double& depth = fitted.cloud.optical_depth;
    for (int i = 0; i < 4; ++i) {
        const double more = scale_of(diffuse, sums.sun_diffuse);
        if (std::abs(more - 1.0) < close || !(more > 0.0)) return;
        // Light passes nearly as 1 / (1 + 0.1 depth).
        const double next = (1.0 + 0.1 * depth) / more - 1.0;
        const double last = std::exchange(depth, std::clamp(10.0 * next, thinnest, thickest));
        if (depth == last) return;
        sums = ground_sunlight(clear.under(fitted.cloud), height_km);
    }
}

/// Beam and diffuse made to be the known ones, and reported in `sums`.
BandModel with_sunlight(const BandModel& model, bool observed_clear, const SunLight& sun,
                        const SunField& clear, double height_km, const KnownLight& known,
                        GroundFluxes& sums) {
    BandModel fitted = model;
    fitted.cloud.sunlit_fraction = 0.0;
    sums = ground_sunlight(clear, height_km);
    const double cosine = std::max(0.0, std::cos(radians(sun.zenith_deg)));
    const double global = sums.sun_direct * cosine + sums.sun_diffuse;
    const double beam = scale_of(known.direct_normal, sums.sun_direct);
    if (beam < 1.0 && global > least_light && !observed_clear) {
        const double all = known.direct_normal * cosine + known.diffuse;
        const SunlitCloud cloud =
            cloud_of_effect({.global = std::max(0.0, all) / global, .beam = beam}, cosine);
        fitted.cloud.sunlit_fraction = cloud.fraction;
        fitted.cloud.optical_depth = cloud.optical_depth;
        sums = ground_sunlight(clear.under(fitted.cloud), height_km);
        if (cloud.fraction == 1.0 && beam < shut_out) {
            fit_depth(clear, height_km, known.diffuse, fitted, sums);
        }
    }
    fitted.scale.beam = scale_of(known.direct_normal, sums.sun_direct);
    fitted.scale.diffuse = scale_of(known.diffuse, sums.sun_diffuse);
    sums.sun_direct *= fitted.scale.beam;
    sums.sun_diffuse *= fitted.scale.diffuse;
    return fitted;
}

}  // namespace

LightOfInstant light_of_instant(const BandModel& model, const SunLight& sun, double height_km,
                                const KnownLight& known) {
    BandModel fitted = model;
    const bool heat_known = !std::isnan(known.longwave_down);
    std::optional<SunField> clear;
    if (sun.zenith_deg < 90.0 && !sun.moon) clear = clear_sunlight(model, sun);
    const SunField* const sunlight = clear ? &*clear : nullptr;
    double longwave = 0.0;
    if (heat_known) {
        fitted =
            with_longwave(model, height_km, known.longwave_down,
                          cloud_allowed(sunlight, sun, height_km, known.direct_normal), longwave);
    }
    GroundFluxes sums;
    const bool sun_known = !std::isnan(known.direct_normal) && !std::isnan(known.diffuse);
    if (sunlight != nullptr) {
        if (sun_known) {
            fitted = with_sunlight(fitted, model.cloud.fraction == 0.0, sun, *sunlight, height_km,
                                   known, sums);
        } else {
            sums = ground_sunlight(fitted, sun, height_km);
        }
    }
    sums.thermal = heat_known ? longwave : ground_longwave(fitted, height_km);
    return {.air = fitted, .sums = sums, .cloud_cover = fitted.cloud.fraction};
}

}  // namespace diurna
