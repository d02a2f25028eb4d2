#include "thermal/weather_file/gaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "materials/base/error.hpp"
#include "materials/base/number_of.hpp"
#include "terrain/place/sun.hpp"

namespace diurna {

namespace {

constexpr double day = 86400.0;  // [s]
/// Rows further apart than this are a hole, even if all are.
constexpr double longest_interval = day;

bool within(const AskedSpan& asked, Instant from, Instant to) {
    return !asked.any() || (to > asked.first() && from < asked.last());
}

InputError large_gap(const std::string& where, const std::string& what, const AskedSpan& asked,
                     Instant from, Instant to) {
    std::string advice = R"(on_gap = "interpolate" or "clear_sky" in [weather] fills it)";
    if (asked.any() && to <= asked.begin) {
        advice += "; the gap is in the days before the span that determine its start";
    }
    return InputError(
        where,
        fmt::format("no {} between {} and {} ({:.1f} h; gaps up to {:g} h are filled)", what,
                    format_instant(from), format_instant(to), seconds_between(from, to) / 3600.0,
                    longest_small_gap / 3600.0),
        advice);
}

/// Puts in rows, all missing, where the file has holes.
void add_missing_rows(WeatherTable& table, OnGap on_gap, const AskedSpan& asked) {
    const double usual = usual_interval(table.stamp);
    const double hole = std::min(1.5 * usual, longest_interval);
    const double every = std::min(usual, longest_small_gap);
    WeatherTable filled = table;
    filled.stamp.clear();
    filled.where.clear();
    for (std::vector<double>& column : filled.value) column.clear();
    const auto copy_row = [&](std::size_t row) {
        filled.stamp.push_back(table.stamp[row]);
        filled.where.push_back(table.where[row]);
        for (std::size_t q = 0; q < quantity_count; ++q) {
            if (!table.value[q].empty()) filled.value[q].push_back(table.value[q][row]);
        }
    };
    for (std::size_t row = 0; row < table.stamp.size(); ++row) {
        const Instant to = table.stamp[row];
        const Instant from = row > 0 ? table.stamp[row - 1] : to;
        if (seconds_between(from, to) > hole && within(asked, from, to)) {
            if (on_gap == OnGap::refuse && seconds_between(from, to) > longest_small_gap) {
                throw large_gap(table.where[row], "weather", asked, from, to);
            }
            for (Instant at = later(from, every); seconds_between(at, to) > 0.5 * every;
                 at = later(at, every)) {
                filled.stamp.push_back(at);
                filled.where.push_back(table.where[row]);
                for (std::size_t q = 0; q < quantity_count; ++q) {
                    if (!table.value[q].empty()) filled.value[q].push_back(not_measured);
                }
            }
        }
        copy_row(row);
    }
    table = std::move(filled);
}

/// Sunlight of cells that are empty at night is none.
void darken_nights(WeatherTable& table, const Site& site) {
    constexpr double below_horizon_deg = -1.0;  // no limb of a refracted sun is up
    // The whole interval before and behind the stamp must be dark.
    const double around = std::min(usual_interval(table.stamp), 3600.0);
    for (std::size_t q = 0; q < quantity_count; ++q) {
        if (facts(quantity_at(q)).kind != QuantityKind::sunlight) continue;
        for (std::size_t row = 0; row < table.value[q].size(); ++row) {
            if (!std::isnan(table.value[q][row])) continue;
            bool dark = true;
            for (const double off : {-around, 0.0, around}) {
                dark = dark && sun_position(site, later(table.stamp[row], off)).elevation_deg <
                                   below_horizon_deg;
            }
            if (dark) table.value[q][row] = 0.0;
        }
    }
}

struct Filled {
    long long by_line = 0, by_formula = 0;
};

/// A run of missing values, from the row `begin` up to but without `end`.
struct Run {
    std::size_t begin, end;
};

std::vector<Run> runs_of(const std::vector<double>& column) {
    std::vector<Run> runs;
    for (std::size_t i = 0; i < column.size();) {
        std::size_t end = i;
        while (end < column.size() && std::isnan(column[end])) ++end;
        if (end > i) runs.push_back({i, end});
        i = end + 1;
    }
    return runs;
}

/// Fills one quantity's gaps.
class GapFiller {
 public:
    GapFiller(WeatherTable& table, OnGap on_gap, const AskedSpan& asked)
        : table_(table), on_gap_(on_gap), asked_(asked) {}

    Filled fill(Quantity quantity) {
        Filled filled;
        std::vector<double>& column = table_.of(quantity);
        const bool state = facts(quantity).kind == QuantityKind::state;
        for (const Run& run : runs_of(column)) {
            const bool inner = run.begin > 0 && run.end < column.size();
            const Instant from = table_.stamp[run.begin == 0 ? 0 : run.begin - 1];
            const Instant to = table_.stamp[std::min(run.end, column.size() - 1)];
            const bool large = seconds_between(from, to) > longest_small_gap;
            const bool asked = within(asked_, from, to);
            if (large && asked && on_gap_ == OnGap::refuse) {
                throw large_gap(table_.where[run.begin], facts(quantity).column, asked_, from, to);
            }
            const bool by_formula = !state && (!inner || (large && on_gap_ != OnGap::interpolate));
            for (std::size_t i = run.begin; i < run.end; ++i) {
                if (!by_formula) column[i] = inner ? on_line(column, run, i) : held(column, run);
                if (by_formula && large) clear(i);
                if (!counts(i)) continue;
                ++(by_formula ? filled.by_formula : filled.by_line);
            }
        }
        return filled;
    }

 private:
    double on_line(const std::vector<double>& column, const Run& run, std::size_t i) const {
        const double share = seconds_between(table_.stamp[run.begin - 1], table_.stamp[i]) /
                             seconds_between(table_.stamp[run.begin - 1], table_.stamp[run.end]);
        return std::lerp(column[run.begin - 1], column[run.end], share);
    }
    static double held(const std::vector<double>& column, const Run& run) {
        return run.begin > 0 ? column[run.begin - 1] : column[run.end];
    }
    bool counts(std::size_t i) const {
        return !asked_.any() ||
               (table_.stamp[i] >= asked_.first() && table_.stamp[i] <= asked_.last());
    }
    /// A cloud that nobody saw is none: infer_cloud would hold the last one.
    void clear(std::size_t i) {
        if (on_gap_ != OnGap::clear_sky) return;
        std::vector<double>& cloud = table_.of(Quantity::cloud_fraction);
        cloud.resize(table_.stamp.size(), not_measured);
        if (std::isnan(cloud[i])) cloud[i] = 0.0;
    }

    WeatherTable& table_;
    OnGap on_gap_;
    const AskedSpan& asked_;
};

void drop_empty_columns(WeatherTable& table) {
    for (std::vector<double>& column : table.value) {
        if (std::all_of(column.begin(), column.end(), [](double x) { return std::isnan(x); })) {
            column.clear();
        }
    }
    if (!table.has(Quantity::air_temperature)) {
        throw InputError(table.file.string(), "has no air temperature");
    }
}

/// Of humidity and dew point the one that has more gaps goes.
void humidity_of_dew_points(WeatherTable& table) {
    if (!table.has(Quantity::dew_point) || !table.has(Quantity::relative_humidity)) return;
    std::vector<double>& dew = table.of(Quantity::dew_point);
    std::vector<double>& humidity = table.of(Quantity::relative_humidity);
    const auto missing = [](const std::vector<double>& column) {
        return std::count_if(column.begin(), column.end(), [](double x) { return std::isnan(x); });
    };
    (missing(dew) < missing(humidity) ? humidity : dew).clear();
}

std::string reported(const std::array<Filled, quantity_count>& filled) {
    long long all = 0;
    std::string by_line, by_formula;
    const auto add = [](std::string& list, long long count, std::size_t q) {
        if (count == 0) return;
        list +=
            fmt::format("{}{} {}", list.empty() ? "" : ", ", count, facts(quantity_at(q)).column);
    };
    for (std::size_t q = 0; q < quantity_count; ++q) {
        all += filled[q].by_line + filled[q].by_formula;
        add(by_line, filled[q].by_line, q);
        add(by_formula, filled[q].by_formula, q);
    }
    if (all == 0) return "";
    std::string line = fmt::format("{} filled in gaps:", number_of(all, "value"));
    if (!by_line.empty()) line += " " + by_line + " by linear interpolation";
    if (!by_formula.empty()) {
        line += fmt::format("{} {} by clear-sky formulas", by_line.empty() ? "" : ",", by_formula);
    }
    return line;
}

}  // namespace

void fill_gaps(WeatherTable& table, OnGap on_gap, const AskedSpan& asked,
               const std::optional<Site>& site) {
    drop_empty_columns(table);
    humidity_of_dew_points(table);
    add_missing_rows(table, on_gap, asked);
    if (site) darken_nights(table, *site);
    GapFiller filler(table, on_gap, asked);
    std::array<Filled, quantity_count> filled{};
    for (std::size_t q = 0; q < quantity_count; ++q) {
        const Quantity quantity = quantity_at(q);
        if (!table.has(quantity) || facts(quantity).kind == QuantityKind::other) continue;
        filled[q] = filler.fill(quantity);
    }
    if (std::string line = reported(filled); !line.empty()) table.notes.push_back(std::move(line));
}

}  // namespace diurna
