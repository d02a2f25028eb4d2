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
            "what the file's column of this name holds, and its unit: \"time UTC\", "
            "\"air_temperature degC\", \"wind_speed kn\"; a time in several columns: "
            "\"year UTC\", \"month\", \"day\", \"hour\", \"minute\"; quantities and units are "
            "listed in thermal/weather_file/README.md");
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
    const std::string stated = section.word_or(
        "interval",
        "a row is the mean over the time that starts or ends at its stamp, or is of that instant; "
        "formats other than CSV say it themselves, and another word is a mistake",
        {"", "the format's; of CSV end"}, {"start", "end", "instant"});
    WeatherOptions options;
    if (stated == "start") options.interval = Stamp::start;
    if (stated == "end") options.interval = Stamp::end;
    if (stated == "instant") options.interval = Stamp::instant;
    options.wind_height = height_or(section, "wind_height_m",
                                    "at which wind was measured; less than 0.3 m/s counts as 0.3",
                                    "the format's; of CSV 10", {lowest_wind, 200.0});
    options.air_height = height_or(section, "air_height_m",
                                   "at which the air's temperature and humidity were measured",
                                   "the format's; of CSV 2", {0.1, 200.0});
    options.on_gap = section.choice_or(
        "on_gap",
        "where values are missing for more than 3 h within the span (less is filled straight): "
        "refuse the file, fill straight, or leave radiation there to the clear sky's formulas; "
        "every value filled is counted in the report",
        OnGap::refuse,
        {{"refuse", OnGap::refuse},
         {"interpolate", OnGap::interpolate},
         {"clear_sky", OnGap::clear_sky}});
    options.missing = section.numbers_or(
        "missing", "numbers that a CSV file has where nothing was measured, such as [-9999]",
        {std::vector<double>{}, "none"});
    options.skip_lines = section.integer_or(
        "skip_lines", "of a CSV file: lines above the one that names its columns", 0,
        {0.0, 1000.0});
    if (!options.missing.empty()) options.where_missing = section.where("missing");
    options.columns =
        read_columns(section.section("columns", "of a CSV file with names and units of its own"));
    options.change = read_weather_change(section);
    if (section.has("changed")) options.where_changed = section.where("changed");
    if (!stated.empty()) options.where = section.where("interval");
    return options;
}

HeightKeys read_height_keys(const Section& section, bool sounded, WeatherOptions& options) {
    constexpr double per_km = 1e-3;
    options.at_station = true;
    options.height = height_or(
        section, "height_m",
        "above the sea, of the ground where the weather was measured: air, sky and sun "
        "are taken from there to the height of each facet",
        "the file's (EPW, TMY3, NSRDB, SolarAnywhere, PVGIS, SURFRAD, BSRN), else the ground's "
        "at the site",
        {-500.0, 9000.0});
    const auto lapse = section.number_or_word(
        "lapse",
        "of the air along the ground and along lines of sight, K per km upward, or \"profile\": as "
        "that of [atmosphere], inversions included, moved to meet the weather at its station, "
        "less so up to 1.5 km above; 0: all ground has the station's air, pressure, sky and sun",
        {-6.5, "-6.5; with a sounding profile"}, {-15.0, 30.0}, {"profile"});
    HeightKeys keys;
    keys.by_profile = lapse.word == "profile" || (sounded && !section.has("lapse"));
    if (lapse.word.empty()) keys.lapse = per_km * lapse.number;
    return keys;
}

std::string read_measured_over(const Section& section, const std::vector<std::string>& materials) {
    return section.name_or("measured_over",
                           "whose albedo measured shortwave_up over shortwave_down is, in place of "
                           "its own, in what it takes in and what it reflects",
                           {"", "the only material, else none"}, {"material", materials});
}

}  // namespace diurna
