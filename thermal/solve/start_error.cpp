#include "thermal/solve/start_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>

namespace diurna {

namespace {

constexpr double day_length = 86400.0;       // [s]
constexpr int most_days = 30;                // of a better start
constexpr double followed = 2 * day_length;  // [s] of the span

/// A level triangle of each material that facets are of, all in the open.
struct LevelGround {
    FacetSet facets;
    FacetViews views;

    LevelGround(const FacetSet& of, const MaterialLibrary& materials) {
        std::vector<Eigen::Vector3d> vertex;
        std::vector<std::array<std::uint32_t, 3>> triangle;
        std::vector<MaterialId> material = of.material;
        std::sort(material.begin(), material.end());
        material.erase(std::unique(material.begin(), material.end()), material.end());
        // The backs of sheets are no surfaces of their own.
        std::erase_if(material,
                      [&](MaterialId id) { return materials[id].thermal.layers.empty(); });
        for (std::size_t i = 0; i < material.size(); ++i) {
            const double east = 10.0 * double(i);
            for (const auto& [x, y] : {std::pair{0.0, 0.0}, {5.0, 0.0}, {0.0, 5.0}}) {
                vertex.emplace_back(east + x, y, 0.0);
            }
            const auto v = static_cast<std::uint32_t>(3 * i);
            triangle.push_back({v, v + 1, v + 2});
        }
        append_facets(facets, vertex, triangle, material, ObjectId{0});
        views.sky.assign(facets.size(), 1.0f);
        views.below.assign(facets.size(), 0.0f);
        views.others.row.assign(facets.size() + 1, 0);
    }
};

TemperatureField through(const SolveInput& scene, const Weather& weather, const LevelGround& ground,
                         const SpanOptions& options) {
    const SunExposure none;
    const auto exposure = [](const std::vector<Instant>& instants) {
        return SunExposure{.instant = instants, .fraction = {}};
    };
    return solve_span({.facets = ground.facets,
                       .views = ground.views,
                       .sun = none,
                       .materials = scene.materials,
                       .weather = weather,
                       .site = scene.site,
                       .utc_offset = scene.utc_offset,
                       .elevation = scene.elevation,
                       .clear_sky = scene.clear_sky,
                       .measured_share = scene.measured_share},
                      exposure, options)
        .temperature;
}

/// Rows of a series from `first` on for so many days that stand at the same times of each day: how
/// many a day; 0 where they do not.
std::size_t rows_a_day(const Weather& weather, std::size_t first, int days) {
    const auto& when = weather.instant;
    const auto next = std::lower_bound(when.begin(), when.end(), later(when[first], day_length));
    const auto rows = static_cast<std::size_t>(next - when.begin()) - first;
    for (std::size_t i = first; i < first + rows * std::size_t(days - 1); ++i) {
        if (i + rows >= when.size() || when[i + rows] != later(when[i], day_length)) return 0;
    }
    return rows;
}

/// The series from so many days before an instant on, and before them the mean of these days: what
/// lies deep then begins in balance with their mean, not with the weather of one of them. As it is,
/// where days are not of the same rows.
Weather with_mean_day_before(const Weather& weather, Instant start, int days) {
    const auto begin = std::lower_bound(weather.instant.begin(), weather.instant.end(),
                                        later(start, -day_length * days));
    const auto first = static_cast<std::size_t>(begin - weather.instant.begin());
    const std::size_t rows = rows_a_day(weather, first, days);
    if (rows == 0) return weather;
    Weather result = weather;
    result.instant.assign(begin, weather.instant.end());
    result.sample.assign(weather.sample.begin() + std::ptrdiff_t(first), weather.sample.end());
    if (!weather.span.empty()) {
        result.span.assign(weather.span.begin() + std::ptrdiff_t(first), weather.span.end());
    }
    for (std::size_t row = rows; row-- > 0;) {
        Forcing mean = weather.sample[first + row];
        for (int k = 1; k < days; ++k) {
            mean =
                between(mean, weather.sample[first + row + std::size_t(k) * rows], 1.0 / (k + 1.0));
        }
        result.instant.insert(result.instant.begin(),
                              later(weather.instant[first + row], -day_length));
        result.sample.insert(result.sample.begin(), mean);
        if (!weather.span.empty()) {
            result.span.insert(result.span.begin(), weather.span[first + row]);
        }
    }
    return result;
}

/// How the better start goes; Against::nothing where none is known.
StartError better_start(const SolveInput& input, const SpanOptions& given, SpanOptions& better) {
    const int known = days_known_before(input.weather, given.start);
    const bool by_weather =
        known > 0 && (given.begin == SpanStart::known || given.begin == SpanStart::weather);
    const int used = by_weather ? std::min(known, given.days_before) : 0;
    StartError error;
    better.begin = SpanStart::weather;
    error.days = std::min(known, used + most_days);
    better.days_before = error.days + 1;
    if (known > used) {
        error.against = StartError::Against::more_days;
    } else if (given.begin == SpanStart::steady) {
        error.against = StartError::Against::repeated_day;
        better.begin = SpanStart::periodic;
    } else if (used > 0) {
        error.against = StartError::Against::a_day_less;
        error.days = better.days_before = used - 1;
        if (used == 1) better.begin = SpanStart::periodic;
    }
    return error;
}

}  // namespace

StartError measure_start(const SolveInput& input, const SpanOptions& options) {
    assert(options.begin != SpanStart::state && !options.wanted.empty());
    SpanOptions given = options;
    given.heat = given.goes_on = false;
    given.day.progress = {};
    given.day.tell = {};
    const Instant first = options.wanted.front();
    given.end = std::min(options.end, later(first, followed));
    given.wanted = {first};
    if (first < given.end) given.wanted.push_back(given.end);
    if (first == options.start && given.end == first) return {};
    SpanOptions better = given;
    StartError error = better_start(input, given, better);
    if (error.against == StartError::Against::nothing) return error;
    const LevelGround ground(input.facets, input.materials);
    const bool more = error.against == StartError::Against::more_days;
    const TemperatureField one = through(input, input.weather, ground, given),
                           other = through(
                               input,
                               more ? with_mean_day_before(input.weather, options.start, error.days)
                                    : input.weather,
                               ground, better);
    double square = 0.0;
    for (std::size_t f = 0; f < one.facets; ++f) {
        const double apart = std::abs(double(one.at(0)[f]) - double(other.at(0)[f]));
        square += apart * apart / double(one.facets);
        if (apart > error.at_first || error.worst.empty()) {
            error.at_first = apart;
            error.worst = input.materials[ground.facets.material[f]].kind();
        }
    }
    error.mean = std::sqrt(square);
    if (one.instant.size() < 2) return error;
    error.later_h = seconds_between(first, one.instant[1]) / 3600.0;
    for (std::size_t f = 0; f < one.facets; ++f) {
        error.at_later =
            std::max(error.at_later, std::abs(double(one.at(1)[f]) - double(other.at(1)[f])));
    }
    return error;
}

std::string reported(const StartError& error) {
    std::string than;
    switch (error.against) {
        case StartError::Against::nothing:
            return "the effect of earlier weather is not included";
        case StartError::Against::more_days:
            than = fmt::format("with {} days of earlier weather", error.days);
            break;
        case StartError::Against::repeated_day:
            than = "with the first day repeated";
            break;
        case StartError::Against::a_day_less:
            than = fmt::format("with one day less of earlier weather ({} day{} known)",
                               error.days + 1, error.days == 0 ? "" : "s");
            break;
    }
    std::string line = fmt::format(
        "effect on level ground of each material: {}, temperatures at the first stored instant "
        "differ by up to {:.2g} K ({}; rms over the materials {:.2g} K)",
        than, error.at_first, error.worst, error.mean);
    if (error.later_h > 0.0)
        line += fmt::format(", {:g} h later by up to {:.2g} K", error.later_h, error.at_later);
    return line;
}

}  // namespace diurna
