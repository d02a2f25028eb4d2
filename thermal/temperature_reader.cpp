#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <string_view>

#include "materials/base/error.hpp"
#include "thermal/netcdf/netcdf_reader.hpp"
#include "thermal/temperature_field.hpp"
#include "thermal/temperature_names.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

constexpr const char* a_temperature_field = "a temperature field";

/// Which facets have the temperatures of others, as far as the file reports it.
std::vector<std::uint32_t> read_solved_as(const NetcdfReader& file, std::size_t facets) {
    if (!file.has(solved_as_name)) return {};
    file.check_dimensions(solved_as_name, {"facet"});
    const std::vector<int> number = file.values<int>(solved_as_name);
    if (!std::all_of(number.begin(), number.end(),
                     [&](int n) { return n >= 0 && std::size_t(n) < facets; })) {
        throw file.refused("solved_as does not name a facet for each facet");
    }
    return {number.begin(), number.end()};
}

/// What lies on facets, as far as the file reports it: each 0 to 1, none where it does not.
CoveredFacets read_cover(const NetcdfReader& file, std::size_t instants, std::size_t facets) {
    CoveredFacets all;
    for (const CoverName& of : cover_names) {
        if (!file.has(of.name)) continue;
        file.check_dimensions(of.name, {"time", "facet"});
        if (all.empty()) {
            all.facet.resize(facets);
            std::iota(all.facet.begin(), all.facet.end(), 0u);
            all.cover.resize(instants * facets);
        }
        const std::vector<float> values = file.values<float>(of.name);
        for (std::size_t n = 0; n < values.size(); ++n) {
            if (!(values[n] >= 0.0f && values[n] <= 1.0f)) {
                throw file.refused(fmt::format("{} has values outside 0 to 1", of.name));
            }
            all.cover[n].*of.value = values[n];
        }
    }
    return all.kept();
}

/// Seconds since 1970 in UTC, in one of the ways in which programs that change such files put it.
bool counts_from_1970(const NetcdfReader& file) {
    const std::string units = file.text("time", "units").value_or("");
    const std::string_view begin = "seconds since 1970-01-01";
    if (!units.starts_with(begin)) return false;
    static constexpr std::array<std::string_view, 8> ends{
        "",          "T00:00:00Z", " 00:00:00",       " 00:00:00Z",
        "T00:00:00", " 00:00:0.0", " 00:00:00+00:00", " 00:00:00 UTC"};
    return std::find(ends.begin(), ends.end(), std::string_view(units).substr(begin.size())) !=
           ends.end();
}

}  // namespace

void check_covers(const TemperatureField& field, std::span<const Instant> wanted,
                  const fs::path& file) {
    double apart = 0.0;
    for (std::size_t i = 1; i < field.instant.size(); ++i) {
        apart = std::max(apart, seconds_between(field.instant[i - 1], field.instant[i]));
    }
    for (const Instant when : wanted) {
        if (seconds_between(when, field.instant.front()) <= apart &&
            seconds_between(field.instant.back(), when) <= apart) {
            continue;
        }
        throw InputError(file.string(),
                         fmt::format("has temperatures from {} to {}, expected some at {}",
                                     format_instant(field.instant.front()),
                                     format_instant(field.instant.back()), format_instant(when)));
    }
}

TemperatureField load_temperature_field(const fs::path& path) {
    const NetcdfReader file(path, a_temperature_field);
    const std::size_t instants = file.length("time"), facets = file.length("facet");
    file.check_dimensions("time", {"time"});
    file.check_dimensions("surface_temperature", {"time", "facet"});
    if (!counts_from_1970(file)) {
        throw file.refused("its time is not in 'seconds since 1970-01-01T00:00:00Z'");
    }
    if (instants == 0 || facets == 0) throw file.refused("has no temperatures");
    TemperatureField field{
        .instant = {}, .facets = facets, .kelvin = file.values<float>("surface_temperature")};
    for (const double s : file.values<double>("time")) {
        if (!std::isfinite(s) || std::abs(s) > 1e12) {
            throw file.refused("has times that are not finite");
        }
        field.instant.push_back(later(Instant{}, s));
    }
    if (std::adjacent_find(field.instant.begin(), field.instant.end(), std::greater_equal<>()) !=
        field.instant.end()) {
        throw file.refused("has times that are not ascending");
    }
    if (std::any_of(field.kelvin.begin(), field.kelvin.end(),
                    [](float t) { return !(t >= 1.0f && t <= 5000.0f); })) {
        throw file.refused("has temperatures outside 1 to 5000 K");
    }
    field.solved_as = read_solved_as(file, facets);
    if (!field.solved_as.empty()) {
        const double rms = file.number(solved_as_name, representative_rms_name).value_or(0.0);
        if (!(rms >= 0.0 && rms < 1e4)) {
            throw file.refused(
                fmt::format("{} is {}, expected 0 K or more", representative_rms_name, rms));
        }
        field.representative_rms = rms;
    }
    field.water = read_cover(file, instants, facets);
    return field;
}

std::vector<float> load_heat_term(const fs::path& path, HeatTerm term,
                                  const TemperatureField& field) {
    const std::string name = heat_term_names[static_cast<std::size_t>(term)].name;
    const NetcdfReader file(path, a_temperature_field);
    if (!file.has(name)) return {};
    file.check_dimensions(name, {"time", "facet"});
    if (file.size(name) != field.instant.size() * field.facets) {
        throw file.refused(name + " does not have the shape of the temperatures");
    }
    std::vector<float> watts = file.values<float>(name);
    if (!std::all_of(watts.begin(), watts.end(), [](float w) { return std::isfinite(w); })) {
        throw file.refused(name + " has values that are not finite");
    }
    return watts;
}

}  // namespace diurna
