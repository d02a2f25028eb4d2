#include "thermal/weather/sun_course.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace diurna {

double SunFactor::at(double x) const {
    return std::clamp(first + x * (last - first) + 4.0 * x * (1.0 - x) * bulge, 0.0, most);
}

namespace {

constexpr double most_diffuse = 50.0;  // over the clear sky's
constexpr double unbounded = 1e9;      // [W m⁻²]

/// Factor between two rows that touch: by their clear light, and never so far from the darker one
/// that it would have to fall below zero to keep its own sum.
double between_rows(double a, double a_sum, double b, double b_sum) {
    const double whole = a_sum + b_sum;
    const double mean = whole > 0.0 ? (a * a_sum + b * b_sum) / whole : 0.5 * (a + b);
    return std::min(mean, 2.0 * std::min(a, b));
}

/// Bulges a factor so that it is `wanted` in the mean over nodes of a weight.
template <class Weight>
void fit(SunFactor& factor, double wanted, std::span<const SunNode> nodes, const Weight& weight) {
    double straight = 0.0, bulge = 0.0, whole = 0.0;
    for (const SunNode& n : nodes) {
        const double w = weight(n);
        whole += w;
        straight += w * (factor.first + n.x * (factor.last - factor.first));
        bulge += w * 4.0 * n.x * (1.0 - n.x);
    }
    if (!(bulge > 0.0)) return;
    const auto missing = [&](double c) {
        factor.bulge = c;
        double sum = 0.0;
        for (const SunNode& n : nodes) sum += weight(n) * factor.at(n.x);
        return wanted * whole - sum;
    };
    const double plain = (wanted * whole - straight) / bulge;
    if (std::abs(missing(plain)) <= 1e-12 * whole) return;
    // It is cut off at zero or at the most somewhere: by halving.
    double low = -1e3, high = 1e3;
    for (int i = 0; i < 80; ++i) {
        const double c = 0.5 * (low + high);
        (missing(c) > 0.0 ? low : high) = c;
    }
}

/// What direct light measured across the beam, given its course, leaves on the horizontal of a
/// row's global light beyond what it leaves when it is even; over the clear sky's diffuse light.
double left_by_shape(const SunRow& row, const SunFactor& direct) {
    double beam = 0.0;
    for (const SunNode& n : row.node) beam += n.weight * n.direct * n.sine * direct.at(n.x);
    const double less = row.direct * row.clear.horizontal - beam;
    return row.clear.diffuse > 0.0 ? std::max(-row.diffuse, less / row.clear.diffuse) : 0.0;
}

}  // namespace

/// Ends of the rows' factors where rows touch, then the bulge that keeps each row's sum.
void SunCourse::join(std::vector<SunRow> rows) {
    constexpr double touching = 1.0;  // [s]
    stretch_.resize(rows.size());
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const SunRow& row = rows[r];
        stretch_[r] = {.from = row.from,
                       .to = row.to,
                       .lit_from = row.lit_from,
                       .lit_to = row.lit_to,
                       .direct = {row.direct, row.direct, 0.0, row.most},
                       .diffuse = {row.diffuse, row.diffuse, 0.0, most_diffuse},
                       .known_direct = row.known_direct,
                       .known_diffuse = row.known_diffuse,
                       .plain = !row.lit};
        if (row.lit) continue;
        stretch_[r].direct = {0.0, 0.0, 0.0, 0.0};
        stretch_[r].diffuse = {row.skylight, row.skylight, 0.0, unbounded};
    }
    const auto where_rows_touch = [&](const auto& join_two) {
        for (std::size_t r = 0; r + 1 < rows.size(); ++r) {
            const SunRow &a = rows[r], &b = rows[r + 1];
            if (a.lit && b.lit && std::abs(a.to - b.from) <= touching) join_two(r, a, b);
        }
    };
    where_rows_touch([&](std::size_t r, const SunRow& a, const SunRow& b) {
        if (!a.known_direct || !b.known_direct) return;
        stretch_[r].direct.last = stretch_[r + 1].direct.first =
            std::min(between_rows(a.direct, a.direct_sum(), b.direct, b.direct_sum()),
                     std::min(a.most, b.most));
    });
    for (std::size_t r = 0; r < rows.size(); ++r) {
        SunRow& row = rows[r];
        if (!row.lit) continue;
        fit(stretch_[r].direct, row.direct, row.node,
            [&](const SunNode& n) { return row.direct_weight(n); });
        if (row.rest) row.diffuse += left_by_shape(row, stretch_[r].direct);
    }
    where_rows_touch([&](std::size_t r, const SunRow& a, const SunRow& b) {
        if (!a.known_diffuse || !b.known_diffuse) return;
        stretch_[r].diffuse.last = stretch_[r + 1].diffuse.first =
            between_rows(a.diffuse, a.clear.diffuse, b.diffuse, b.clear.diffuse);
    });
    for (std::size_t r = 0; r < rows.size(); ++r) {
        const SunRow& row = rows[r];
        if (!row.lit) continue;
        fit(stretch_[r].diffuse, row.diffuse, row.node,
            [&](const SunNode& n) { return n.weight * n.diffuse; });
    }
}

/// Straight factors between rows at instants; where the sun is low or down, those of the nearest
/// row that can tell. Between rows ten minutes apart and less light itself runs straight.
void SunCourse::connect(const std::vector<SunRow>& rows) {
    constexpr double far = 6.0 * 3600.0, short_way = 601.0;  // [s]
    std::vector<std::size_t> teller(rows.size(), rows.size());
    for (std::size_t r = 0; r < rows.size(); ++r) {
        double nearest = far;
        for (const int way : {-1, 1}) {
            for (auto k = static_cast<std::ptrdiff_t>(r);
                 k >= 0 && k < static_cast<std::ptrdiff_t>(rows.size()); k += way) {
                const SunRow& other = rows[static_cast<std::size_t>(k)];
                const double away = std::abs(other.from - rows[r].from);
                if (away > nearest) break;
                if (!other.lit) continue;
                nearest = away;
                teller[r] = static_cast<std::size_t>(k);
                break;
            }
        }
    }
    for (std::size_t r = 0; r + 1 < rows.size(); ++r) {
        const SunRow &a = rows[r], &b = rows[r + 1];
        Stretch stretch{.from = a.from,
                        .to = b.from,
                        .lit_from = a.from,
                        .lit_to = b.from,
                        .known_direct = a.known_direct && b.known_direct,
                        .known_diffuse = a.known_diffuse && b.known_diffuse};
        const bool dark = teller[r] == rows.size() || teller[r + 1] == rows.size();
        if (dark || b.from - a.from <= short_way) {
            stretch.plain = true;
            stretch.direct = {a.direct_normal, b.direct_normal, 0.0, unbounded};
            stretch.diffuse = {a.skylight, b.skylight, 0.0, unbounded};
        } else {
            const SunRow &from = rows[teller[r]], &to = rows[teller[r + 1]];
            stretch.direct = {from.direct, to.direct, 0.0, std::max(from.most, to.most)};
            stretch.diffuse = {from.diffuse, to.diffuse, 0.0, most_diffuse};
        }
        stretch_.push_back(stretch);
    }
}

Sunlight SunCourse::at(Instant when, const Sunlight& clear) const {
    Sunlight light{not_measured, not_measured};
    const double s = seconds_between(origin_, when);
    const auto after = std::upper_bound(stretch_.begin(), stretch_.end(), s,
                                        [](double at, const Stretch& t) { return at < t.from; });
    if (after == stretch_.begin()) return light;
    const Stretch& row = *(after - 1);
    if (s <= row.to + 1e-3) {
        const double length = row.lit_to - row.lit_from;
        const double x = length > 0.0 ? std::clamp((s - row.lit_from) / length, 0.0, 1.0) : 0.5;
        const auto part = [&](bool measured, const SunFactor& factor, double clear_light) {
            if (!measured) return not_measured;
            return factor.at(x) * (row.plain ? 1.0 : clear_light);
        };
        light.direct_normal = part(row.known_direct, row.direct, clear.direct_normal);
        light.diffuse_horizontal = part(row.known_diffuse, row.diffuse, clear.diffuse_horizontal);
        return light;
    }
    // In a gap: straight from where the row before ends to where the next begins.
    if (after == stretch_.end()) return light;
    const double x = (s - row.to) / (after->from - row.to);
    const auto bridge = [&](const SunFactor& a, const SunFactor& b, double clear_light) {
        if (row.plain && after->plain) return std::lerp(a.last, b.first, x);
        const double before = row.plain ? b.first : a.last, next = after->plain ? before : b.first;
        return std::lerp(before, next, x) * clear_light;
    };
    if (row.known_direct && after->known_direct) {
        light.direct_normal = bridge(row.direct, after->direct, clear.direct_normal);
    }
    if (row.known_diffuse && after->known_diffuse) {
        light.diffuse_horizontal = bridge(row.diffuse, after->diffuse, clear.diffuse_horizontal);
    }
    return light;
}

SunCourse::SunCourse(const Weather& weather, const Site& site, double elevation,
                     const ClearSky& clear, Instant from, Instant to)
    : origin_(weather.instant.front()), clearness_(weather.sample.size(), not_measured) {
    ClearCourse course(weather, site, elevation, clear);
    // The rows that matter, and one more at either end.
    const auto begin = std::lower_bound(weather.instant.begin(), weather.instant.end(), from);
    const auto end = std::upper_bound(weather.instant.begin(), weather.instant.end(), to);
    constexpr std::ptrdiff_t margin = 2;
    const auto first = static_cast<std::size_t>(
        std::max<std::ptrdiff_t>(0, begin - weather.instant.begin() - margin));
    const auto last = std::min(weather.sample.size(),
                               static_cast<std::size_t>(end - weather.instant.begin() + margin));
    std::vector<SunRow> means, moments;
    for (SunRow& row : sun_rows(weather, course, clear.separation, first, last, report_)) {
        clearness_[row.sample] = row.clearness;
        (weather.span_of(row.sample) > 0.0 ? means : moments).push_back(std::move(row));
    }
    if (moments.empty()) {
        join(std::move(means));
    } else {
        connect(moments);
    }
}

}  // namespace diurna
