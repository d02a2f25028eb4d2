#include "thermal/weather_file/weather_section.hpp"

#include <cmath>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

std::optional<double> height_or(const Section& section, const char* key, const char* says,
                                const char* usual, Range range) {
    const double height = section.number_or(key, says, {std::nan(""), usual}, range);
    return std::isnan(height) ? std::nullopt : std::optional(height);
}

std::vector<DeclaredColumn> read_columns(const Section& columns) {
    std::vector<DeclaredColumn> declared;
    for (const std::string& name : columns.free_keys()) {
        const std::string says = columns.text(
            name,
            "content and unit of the file's column of this name: \"time UTC\", "
            "\"air_temperature degC\", \"wind_speed kn\"; for a time in several "
            "columns: \"year UTC\", \"month\", \"day\", \"hour\", \"minute\"; for dates that begin "
            "with the month or the day: \"time_mdy UTC\", \"time_dmy UTC\"; "
            "thermal/weather_file/README.md lists quantities and units");
        try {
            declared.push_back(declared_column(name, says, columns.where(name)));
        } catch (const InputError& error) {
            columns.mistake(name, error.mistakes().front().problem, error.mistakes().front().hint);
        }
    }
    return declared;
}

}  // namespace

WeatherOptions read_weather_options(const Section& section, double lowest_wind) {
    const std::string stated =
        section.word_or("interval",
                        "meaning of a row's stamp: the row is the mean over the interval that "
                        "starts or ends there, or the value at that instant; formats other than "
                        "CSV have a fixed meaning, which the key must match",
                        {"", "that of the format; end for CSV"}, {"start", "end", "instant"});
    WeatherOptions options;
    if (stated == "start") options.interval = Stamp::start;
    if (stated == "end") options.interval = Stamp::end;
    if (stated == "instant") options.interval = Stamp::instant;
    options.wind_height =
        height_or(section, "wind_height_m",
                  "height of the wind measurement; speeds below 0.3 m/s are raised to 0.3",
                  "that of the format; 10 for CSV", {lowest_wind, 200.0});
    options.air_height = height_or(section, "air_height_m",
                                   "height of the air temperature and humidity measurements",
                                   "that of the format; 2 for CSV", {0.1, 200.0});
    options.on_gap =
        section.choice_or("on_gap",
                          "gaps of more than 3 h in the span (shorter gaps are interpolated "
                          "linearly): refuse the file, interpolate linearly, or use clear-sky "
                          "formulas for radiation; the report counts all filled values",
                          OnGap::refuse,
                          {{"refuse", OnGap::refuse},
                           {"interpolate", OnGap::interpolate},
                           {"clear_sky", OnGap::clear_sky}});
    options.missing = section.numbers_or(
        "missing", "numbers that mark missing values in a CSV file, such as [-9999]",
        {std::vector<double>{}, "none"});
    options.skip_lines = section.integer_or(
        "skip_lines", "number of lines before the line of column names in a CSV file", 0,
        {0.0, 1000.0});
    if (!options.missing.empty()) options.where_missing = section.where("missing");
    options.columns =
        read_columns(section.section("columns", "names and units of the columns of a CSV file"));
    options.change = read_weather_change(section);
    if (section.has("changed")) options.where_changed = section.where("changed");
    if (!stated.empty()) options.where = section.where("interval");
    return options;
}

HeightKeys read_height_keys(const Section& section, bool sounded, WeatherOptions& options) {
    constexpr double per_km = 1e-3;
    options.at_station = true;
    options.height = height_or(section, "height_m",
                               "height above the sea of the ground at the weather station: air, "
                               "sky and sun are adjusted from there to the height of each facet",
                               "that of the file (EPW, TMY3, NSRDB, SolarAnywhere, PVGIS, SURFRAD, "
                               "BSRN), otherwise of the ground at the site",
                               {-500.0, 9000.0});
    const auto lapse = section.number_or_word(
        "lapse",
        "change of air temperature with height along the ground and along lines of sight, K per "
        "km, or \"profile\": as in the profile of [atmosphere], inversions included, shifted to "
        "match the weather at its station, with a transition up to 1.5 km above; 0: all ground has "
        "the air, pressure, sky and sun of the station",
        {-6.5, "-6.5; \"profile\" with a sounding"}, {-15.0, 30.0}, {"profile"});
    HeightKeys keys;
    keys.by_profile = lapse.word == "profile" || (sounded && !section.has("lapse"));
    if (lapse.word.empty()) keys.lapse = per_km * lapse.number;
    return keys;
}

std::string read_measured_over(const Section& section, const std::vector<std::string>& materials) {
    return section.name_or("measured_over",
                           "material whose albedo is replaced by the measured shortwave_up / "
                           "shortwave_down, for absorption and reflection",
                           {"", "the only material, otherwise none"}, {"material", materials});
}

}  // namespace diurna
