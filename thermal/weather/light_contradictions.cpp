#include "thermal/weather/light_contradictions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/number_of.hpp"
#include "materials/base/units.hpp"
#include "terrain/place/sun.hpp"

namespace diurna {

namespace {

constexpr double low_sun_sine = 0.174;  // 10 degrees
constexpr double dim = 50.0;            // [W m⁻²]

/// Samples that contradict themselves in one manner.
struct Contradiction {
    std::string hint;
    std::string first{};
    std::size_t count = 0;

    void add(std::string found) {
        if (count++ == 0) first = std::move(found);
    }
    void report(const std::string& where, std::vector<Mistake>& warnings) const {
        if (count == 0) return;
        const std::string more =
            count > 1 ? fmt::format(" (and {})", number_of(count - 1, "more sample")) : "";
        warnings.push_back({where, first + more, hint});
    }
};

/// Mean sine of the sun's elevation over a sample's interval, 0 while it is down.
double mean_sun_sine(const Site& site, Instant middle, double span) {
    const int points = span > 0.0 ? 5 : 1;
    double sum = 0.0;
    for (int i = 0; i < points; ++i) {
        const double share = (i + 0.5) / points - 0.5;
        const SunPosition sun = sun_position(site, later(middle, share * span));
        sum += std::max(0.0, std::sin(radians(sun.elevation_deg)));
    }
    return sum / points;
}

}  // namespace

std::vector<Mistake> light_contradictions(const Weather& weather, const Site& site, Instant begin,
                                          Instant end, const std::string& where) {
    Contradiction sums{
        "direct and diffuse light are used, the global is not: check the units of the three "
        "columns, and that direct is on a plane facing the sun"};
    Contradiction parts{
        "diffuse light is a part of the global: the global is used and all of it is diffuse; check "
        "the columns"};
    Contradiction beams{
        "direct light on the horizontal is a part of the global: check the units of the two "
        "columns, and that direct is on a plane facing the sun"};
    Contradiction returned{
        "the ground cannot reflect more than it receives: check the two columns"};
    Contradiction overcast{
        "an overcast sky has no beam: sunlight is used as it was measured; check the cloud "
        "column's unit and time"};
    for (std::size_t i = 0; i < weather.sample.size(); ++i) {
        const Instant when = weather.instant[i];
        const Forcing& f = weather.sample[i];
        const bool compares =
            !std::isnan(f.direct_normal) || !std::isnan(f.diffuse) || !std::isnan(f.shortwave_up);
        if (when < begin || when > end || !compares) continue;
        const double sine = mean_sun_sine(site, when, weather.span_of(i));
        if (sine < low_sun_sine) continue;
        const double global = f.shortwave_down;
        const double sum = f.direct_normal * sine + f.diffuse;  // NaN: one is unknown
        if (!std::isnan(sum) && std::max(global, sum) > dim &&
            std::abs(sum - global) > 0.25 * global) {
            sums.add(fmt::format(
                "found shortwave_down_W_m2 = {:.4g} at {}, but direct_normal_W_m2 = {:.4g} and "
                "diffuse_W_m2 = {:.4g} give {:.4g} on the horizontal",
                global, format_instant(when), f.direct_normal, f.diffuse, sum));
        } else if (std::isnan(f.direct_normal) && f.diffuse > 1.1 * global + 10.0 &&
                   f.diffuse > dim) {
            parts.add(
                fmt::format("found diffuse_W_m2 = {:.4g} above shortwave_down_W_m2 = {:.4g} "
                            "at {}",
                            f.diffuse, global, format_instant(when)));
        }
        const double beam = f.direct_normal * sine;
        if (std::isnan(f.diffuse) && beam > dim && beam > 1.25 * global + 10.0) {
            beams.add(fmt::format(
                "found direct_normal_W_m2 = {:.4g} at {}, which gives {:.4g} on the horizontal, "
                "above shortwave_down_W_m2 = {:.4g}",
                f.direct_normal, format_instant(when), beam, global));
        }
        if (f.shortwave_up > dim && f.shortwave_up > 1.1 * global) {
            returned.add(
                fmt::format("found shortwave_up_W_m2 = {:.4g} above shortwave_down_W_m2 = {:.4g} "
                            "at {}",
                            f.shortwave_up, global, format_instant(when)));
        }
        if (f.cloud_fraction >= 0.95 && f.direct_normal >= 400.0) {
            overcast.add(fmt::format(
                "found cloud_fraction = {:.3g} beside direct_normal_W_m2 = {:.4g} at {}",
                f.cloud_fraction, f.direct_normal, format_instant(when)));
        }
    }
    std::vector<Mistake> warnings;
    for (const Contradiction& kind : {sums, parts, beams, returned, overcast})
        kind.report(where, warnings);
    return warnings;
}

}  // namespace diurna
