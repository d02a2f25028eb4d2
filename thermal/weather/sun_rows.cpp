#include "thermal/weather/sun_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include "materials/base/number_of.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr double least_row_sine = 0.0175;     // 1°: below, light over clear light says nothing
constexpr double low_sine = 0.139;            // 8°
constexpr double most_beyond_clear = 1.1;     // direct light over the clear sky's
constexpr double most_diffuse_of_row = 50.0;  // the same of diffuse light
constexpr double dark_noise = 10.0;           // [W m⁻²] of pyranometers by night

/// What a row was measured to bring, over its interval [J m⁻²]; NaN: not known.
struct Measured {
    double direct_normal, diffuse, global;
    bool has_direct() const { return !std::isnan(direct_normal); }
    bool has_diffuse() const { return !std::isnan(diffuse); }
    bool has_global() const { return !std::isnan(global); }
};

double seconds_of(const Weather& weather, std::size_t i) {
    return weather.span_of(i) > 0.0 ? weather.span_of(i) : 1.0;
}

Measured measured(const Weather& weather, std::size_t i) {
    const Forcing& f = weather.sample[i];
    const auto over = [&](double flux) {
        return std::isnan(flux) ? flux : seconds_of(weather, i) * std::max(0.0, flux);
    };
    return {over(f.direct_normal), over(f.diffuse), over(f.shortwave_down)};
}

/// Three instruments that should agree: what is left over is the diffuse light's, the weakest. More
/// than a quarter apart, one is dirty or shaded: the global is not believed.
bool diffuse_is_rest(const Measured& light, double beam) {
    if (!light.has_global() || !light.has_diffuse()) return light.has_global();
    const double rest = std::max(0.0, light.global - beam);
    return std::abs(rest - light.diffuse) <= 0.25 * light.global;
}

/// The moments of a row: three Gauss points to five minutes of sun, thirty at least.
SunRow survey(const Weather& weather, std::size_t i, ClearCourse& clear) {
    constexpr std::array<std::array<double, 2>, 3> gauss{
        {{0.11270166537925831, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.88729833462074169, 5.0 / 18.0}}};
    const Instant origin = weather.instant.front();
    const double span = weather.span_of(i), middle = seconds_between(origin, weather.instant[i]);
    SunRow row{.sample = i,
               .from = middle - 0.5 * span,
               .to = middle + 0.5 * span,
               .clearness = not_measured};
    std::array<double, 2> lit{middle, middle};
    if (span > 0.0) lit = clear.sunlit(origin, row.from, row.to);
    row.lit = lit[0] <= lit[1];
    row.lit_from = lit[0];
    row.lit_to = lit[1];
    const double length = std::max(0.0, lit[1] - lit[0]);
    const int parts = span > 120.0 ? std::max(10, static_cast<int>(std::ceil(length / 300.0))) : 1;
    for (int p = 0; row.lit && p < parts; ++p) {
        for (const auto& [x, w] : gauss) {
            const double share = span > 0.0 ? (p + x) / parts : 0.5;
            const ClearMoment at = clear.at(later(origin, lit[0] + share * length));
            const double weight = span > 0.0 ? w * length / parts : w;
            row.node.push_back({share, weight, at.light.direct_normal, std::max(0.0, at.sine),
                                at.light.diffuse_horizontal});
            row.clear.add(at, weight);
        }
    }
    const Measured light = measured(weather, i);
    row.known_direct = light.has_direct() || light.has_global();
    row.known_diffuse = light.has_diffuse() || light.has_global();
    const bool dark = !row.lit || !(row.clear.global() > 0.0);
    const bool grazing = span == 0.0 && row.clear.mean_sine() < least_row_sine;
    row.lit = !dark && !grazing;
    row.skylight = std::fmax(light.global, light.diffuse) / seconds_of(weather, i);
    if (row.lit && row.clear.mean_sine() > low_sine && row.known_direct && row.known_diffuse) {
        const double beam = light.direct_normal / row.clear.direct * row.clear.horizontal;
        const bool three = light.has_global() && light.has_direct() && light.has_diffuse();
        const bool believed = light.has_global() && (!three || diffuse_is_rest(light, beam));
        row.clearness = (believed ? light.global : beam + light.diffuse) / row.clear.global();
    }
    return row;
}

/// The haze of each row's day, over the clear sky's own: from how bright the clear hours were
/// around noon.
std::vector<double> haze_of_days(const std::vector<SunRow>& rows) {
    constexpr double day_around = 9.0 * 3600.0, clear_from = 0.97, all_gone = 0.08;
    std::vector<double> haze;
    std::size_t begin = 0;
    for (const SunRow& row : rows) {
        while (rows[begin].to < row.from - day_around) ++begin;
        double highest = 0.0;
        const auto each = [&](const auto& use) {
            for (std::size_t k = begin; k < rows.size() && rows[k].from < row.to + day_around;
                 ++k) {
                use(rows[k]);
            }
        };
        each([&](const SunRow& r) { highest = std::max(highest, r.clear.mean_sine()); });
        double bright = 0.0, whole = 0.0;
        each([&](const SunRow& r) {
            if (!(r.clearness > clear_from) || r.clear.mean_sine() < 0.6 * highest) return;
            bright += r.clear.top * r.clearness;
            whole += r.clear.top;
        });
        const double beyond = whole > 0.0 ? bright / whole - 1.0 : 0.0;
        haze.push_back(1.0 - 0.95 * std::clamp(beyond / all_gone, 0.0, 1.0));
    }
    return haze;
}

/// A row's clear sky in other haze, by every third node.
ClearSums in_haze(const SunRow& row, ClearCourse& clear, Instant origin, double haze) {
    if (haze == 1.0) return row.clear;
    ClearSums sums;
    for (std::size_t k = 1; k < row.node.size(); k += 3) {
        const double s = row.lit_from + row.node[k].x * (row.lit_to - row.lit_from);
        sums.add(clear.at(later(origin, s), haze), 3.0 * row.node[k].weight);
    }
    return sums;
}

/// Diffuse share of a row's global light where it alone was measured.
double share_of_diffuse(const Weather& weather, const SunRow& row, double global,
                        ClearCourse& clear, const ClearSums& air, Separation separation) {
    const Instant when = weather.instant[row.sample];
    const auto year =
        std::chrono::year_month_day(std::chrono::floor<std::chrono::days>(when)).year();
    const double since = seconds_between(std::chrono::sys_days(year / 1 / 1), when);
    const double middle = 0.5 * (row.lit_from + row.lit_to);
    const SunPosition sun = clear.at(later(weather.instant.front(), middle)).sun;
    const double span = weather.span_of(row.sample);
    const double modelled =
        diffuse_share(separation, {.clearness = global / row.clear.top,
                                   .minutes = span > 0.0 ? span / 60.0 : 1.0,
                                   .zenith_deg = 90.0 - degrees(std::asin(row.clear.mean_sine())),
                                   .solar_hour = clear.solar_hour(sun),
                                   .day_of_year = 1.0 + std::floor(since / 86400.0),
                                   .top = row.clear.top_normal / row.clear.seconds});
    // As bright as a clear sky an hour is clear, and its light divides as a clear sky's: the
    // models, fitted to all kinds of air, make a tenth too little direct light of it.
    const double bright = std::clamp((global / air.global() - 0.9) / 0.1, 0.0, 1.0);
    return std::lerp(modelled, air.diffuse / air.global(), bright * bright * (3.0 - 2.0 * bright));
}

/// A row's light over the clear sky's.
void divide(const Weather& weather, SunRow& row, ClearCourse& clear, Separation separation,
            double haze, SunCourseReport& report) {
    Measured light = measured(weather, row.sample);
    row.horizontal = !light.has_direct();
    if (light.has_direct()) {
        row.direct = row.clear.direct > 0.0 ? light.direct_normal / row.clear.direct : 0.0;
        const double beam = row.direct * row.clear.horizontal;
        const bool rest = diffuse_is_rest(light, beam);
        if (rest) light.diffuse = std::max(0.0, light.global - beam);
        row.rest = rest && light.global > beam;
        row.most = std::max(most_beyond_clear, 1.02 * row.direct);
    } else if (light.has_global()) {
        double direct = light.global - light.diffuse;
        if (!light.has_diffuse()) {
            ++report.separated;
            const ClearSums air = in_haze(row, clear, weather.instant.front(), haze);
            const double share =
                share_of_diffuse(weather, row, light.global, clear, air, separation);
            direct = (1.0 - share) * light.global;
            row.most = most_beyond_clear * air.horizontal / row.clear.horizontal;
        }
        const double most = 0.98 * row.most * row.clear.horizontal;
        if (direct > most && direct - most > 0.02 * light.global) {
            ++report.capped;
            report.most_capped =
                std::max(report.most_capped, (direct - most) / seconds_of(weather, row.sample));
        }
        direct = std::clamp(direct, 0.0, most);
        row.direct = row.clear.horizontal > 0.0 ? direct / row.clear.horizontal : 0.0;
        light.diffuse = light.global - direct;
    }
    row.diffuse = row.clear.diffuse > 0.0
                      ? std::min(most_diffuse_of_row, light.diffuse / row.clear.diffuse)
                      : 0.0;
    if (weather.span_of(row.sample) == 0.0) {
        row.direct_normal = row.direct * row.clear.direct;
        row.skylight = light.diffuse;
    }
}

}  // namespace

std::string tell(const SunCourseReport& report) {
    std::string line;
    const auto say = [&](const std::string& what) { line += (line.empty() ? "" : "; ") + what; };
    if (report.separated > 0) {
        say(fmt::format("global sunlight of {} is split by a model",
                        number_of(report.separated, "row")));
    }
    if (report.in_the_dark > 0) {
        say(fmt::format(
            "{} sunlight with the sun below the horizon, up to {:.0f} W/m2, which is used as "
            "skylight: check the time stamps",
            number_of(report.in_the_dark, "row has", "rows have"), report.brightest_dark));
    }
    if (report.capped > 0) {
        say(
            fmt::format("direct sunlight of {} exceeds the clear-sky value by more than a tenth; "
                        "the excess, up to {:.0f} W/m2, is used as diffuse light: check time "
                        "stamps and calibration, or reduce the haze (a larger "
                        "atmosphere.visibility_km; of a column, a smaller sky.aerosol_500nm)",
                        number_of(report.capped, "row"), report.most_capped));
    }
    return line;
}

std::vector<SunRow> sun_rows(const Weather& weather, ClearCourse& clear, Separation separation,
                             std::size_t first, std::size_t last, SunCourseReport& report) {
    std::vector<SunRow> rows;
    for (std::size_t i = first; i < last; ++i) rows.push_back(survey(weather, i, clear));
    const std::vector<double> haze = haze_of_days(rows);
    for (std::size_t r = 0; r < rows.size(); ++r) {
        SunRow& row = rows[r];
        if (row.lit) {
            divide(weather, row, clear, separation, haze[r], report);
        } else if (row.skylight > dark_noise && !(row.clear.mean_sine() > 0.0)) {
            // Light without a sun is skylight.
            ++report.in_the_dark;
            report.brightest_dark = std::max(report.brightest_dark, row.skylight);
        }
    }
    return rows;
}

}  // namespace diurna
