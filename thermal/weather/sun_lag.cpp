#include "thermal/weather/sun_lag.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "materials/base/units.hpp"
#include "terrain/place/sun.hpp"

namespace diurna {

namespace {

constexpr double step = 300.0, furthest = 12.0 * 3600.0;  // [s] of shifts
constexpr double least_span = 20.0 * 3600.0;              // [s]
constexpr std::size_t least_samples = 12;

double squeezed(double flux) { return std::log1p(std::max(0.0, flux) / 3.0); }

/// The clear sky's light [J m⁻²] added up from `begin`, a number a step.
class ClearSum {
 public:
    ClearSum(const Site& site, Instant begin, Instant end) : begin_(begin) {
        const auto steps = std::size_t(std::ceil(seconds_between(begin, end) / step)) + 1;
        sum_.push_back(0.0);
        for (std::size_t i = 0; i < steps; ++i) {
            const SunPosition sun = sun_position(site, later(begin, step * (double(i) + 0.5)));
            const double sine = std::sin(radians(sun.elevation_deg));
            const double flux = sine > 0.0 ? 1098.0 * sine * std::exp(-0.057 / sine) : 0.0;
            sum_.push_back(sum_.back() + step * flux);
        }
    }
    /// [W m⁻²], the mean of an interval.
    double mean(double from, double to) const { return (at(to) - at(from)) / (to - from); }
    double since_begin(Instant when) const { return seconds_between(begin_, when); }

 private:
    double at(double seconds) const {
        const double place = std::clamp(seconds / step, 0.0, double(sum_.size() - 1));
        const auto left = std::min(std::size_t(place), sum_.size() - 2);
        return std::lerp(sum_[left], sum_[left + 1], place - double(left));
    }
    Instant begin_;
    std::vector<double> sum_;
};

struct Seen {
    double middle, half;  // [s] of its interval
    double light;         // squeezed
};

double light_of(const Forcing& f) {
    for (const double flux : {f.shortwave_down, f.plane_of_array, f.direct_normal, f.diffuse}) {
        if (!std::isnan(flux)) return flux;
    }
    return not_measured;
}

double correlation(const std::vector<Seen>& seen, const ClearSum& clear, double shift) {
    double x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
    for (const Seen& one : seen) {
        const double at = one.middle + shift;
        const double sun = squeezed(clear.mean(at - one.half, at + one.half));
        x += sun;
        y += one.light;
        xx += sun * sun;
        yy += one.light * one.light;
        xy += sun * one.light;
    }
    const double n = double(seen.size());
    const double spread = (xx - x * x / n) * (yy - y * y / n);
    return spread > 1e-9 * n * n ? (xy - x * y / n) / std::sqrt(spread) : not_measured;
}

}  // namespace

std::optional<SunLag> sun_lag(const Weather& weather, const Site& site, Instant begin,
                              Instant end) {
    const double margin = furthest + 4.0 * 3600.0;
    const ClearSum clear(site, later(begin, -margin), later(end, margin));
    std::vector<Seen> seen;
    for (std::size_t i = 0; i < weather.instant.size(); ++i) {
        if (weather.instant[i] < begin || weather.instant[i] > end) continue;
        const double light = light_of(weather.sample[i]);
        if (std::isnan(light)) continue;
        const double half = std::clamp(0.5 * weather.span_of(i), 0.5 * step, 3.0 * 3600.0);
        seen.push_back({clear.since_begin(weather.instant[i]), half, squeezed(light)});
    }
    if (seen.size() < least_samples || seen.back().middle - seen.front().middle < least_span) {
        return std::nullopt;
    }
    const int most = int(furthest / step);
    std::vector<double> fit;
    for (int shift = -most; shift <= most; ++shift) {
        fit.push_back(correlation(seen, clear, step * shift));
        if (std::isnan(fit.back())) return std::nullopt;
    }
    const auto best = std::size_t(std::max_element(fit.begin(), fit.end()) - fit.begin());
    SunLag lag{.seconds = step * (double(best) - most),
               .fit = fit[best],
               .as_it_is = fit[std::size_t(most)]};
    if (best > 0 && best + 1 < fit.size()) {  // between the steps: a parabola's top
        const double bend = fit[best - 1] - 2.0 * fit[best] + fit[best + 1];
        if (bend < 0.0) lag.seconds += 0.5 * step * (fit[best - 1] - fit[best + 1]) / bend;
    }
    return lag;
}

}  // namespace diurna
