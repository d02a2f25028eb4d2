#include "thermal/weather/sky_series.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/units.hpp"
#include "thermal/weather/apparent_sun.hpp"
#include "thermal/weather/sky_spread.hpp"

namespace diurna {

namespace {

constexpr double one_day = 86400.0;  // [s]
/// What measured sunlight is compared with: a vacuum's sky has no diffuse light to compare with.
ClearSky with_air(ClearSky clear) {
    clear.bare_sun = false;
    return clear;
}

constexpr double least_global = 5.0;  // [W m⁻²]: below, offsets outweigh the albedo they give

}  // namespace

SkySeries::SkySeries(Weather weather, const Site& site, double elevation, const ClearSky& clear,
                     Instant from, Instant to)
    : weather_(std::move(weather)),
      elevation_(elevation),
      clear_(clear),
      course_(weather_, site, elevation, with_air(clear), later(from, -one_day),
              later(to, one_day)) {
    infer_cloud();
    if (const std::string reported = tell(course_.report()); !reported.empty()) {
        weather_.note += (weather_.note.empty() ? "" : "; ") + reported;
    }
    albedo_.reserve(weather_.sample.size());
    for (const Forcing& f : weather_.sample) {
        const bool known = f.shortwave_down > least_global && !std::isnan(f.shortwave_up);
        albedo_.push_back(known ? std::clamp(f.shortwave_up / f.shortwave_down, 0.0, 1.0)
                                : not_measured);
    }
}

void SkySeries::infer_cloud() {
    const std::vector<double>& clearness = course_.clearness();
    double held = not_measured;
    std::size_t waiting = 0;  // samples before the first daylight take its value
    for (std::size_t i = 0; i < weather_.sample.size(); ++i) {
        double& cloud = weather_.sample[i].cloud_fraction;
        if (std::isnan(cloud) && !std::isnan(clearness[i])) {
            held = std::clamp(1.0 - clearness[i], 0.0, 1.0);
            for (; waiting < i; ++waiting) {
                double& earlier = weather_.sample[waiting].cloud_fraction;
                if (std::isnan(earlier)) earlier = held;
            }
            waiting = weather_.sample.size();
        } else if (!std::isnan(cloud)) {
            held = cloud;
        }
        if (std::isnan(cloud)) cloud = held;
    }
}

double SkySeries::albedo_at(Instant when) const {
    const auto& instant = weather_.instant;
    const auto next = std::upper_bound(instant.begin(), instant.end(), when);
    const auto i = static_cast<std::size_t>(next - instant.begin());
    if (next == instant.begin()) return albedo_.front();
    if (next == instant.end()) return albedo_.back();
    const double a = albedo_[i - 1], b = albedo_[i];
    if (std::isnan(a)) return b;
    if (std::isnan(b)) return a;
    const double share =
        seconds_between(instant[i - 1], when) / seconds_between(instant[i - 1], instant[i]);
    return std::lerp(a, b, share);
}

SkyState SkySeries::at(Instant when, const SunPosition& geometric) const {
    Forcing now = weather_.at(when);
    if (weather_.sample.size() == 1)
        return placed(when, sky_state(geometric, elevation_, now, clear_));
    const SunPosition sun = apparent_sun(geometric, now.air, elevation_);
    const Sunlight light = course_.at(
        when, sun.elevation_deg > 0.0 ? clear_sunlight(sun, now.air, elevation_, with_air(clear_))
                                      : Sunlight{0.0, 0.0});
    now.shortwave_down = now.shortwave_up = not_measured;
    now.direct_normal = light.direct_normal;
    now.diffuse = light.diffuse_horizontal;
    SkyState sky = sky_state(geometric, elevation_, now, clear_);
    sky.albedo = albedo_at(when);
    return placed(when, sky);
}

SkyState SkySeries::placed(Instant when, SkyState sky) const {
    sky.by_height = weather_.by_height.get();
    sky.when = when;
    if (weather_.spreads && sky.to_sun.z() > 0.0)
        sky.split = weather_.spreads->at(when, sky.to_sun);
    return sky;
}

SkyState SkySeries::dark(Instant when) const {
    return placed(when,
                  sky_state(SunPosition{0.0, -90.0, 1.0}, elevation_, weather_.at(when), clear_));
}

}  // namespace diurna
