#include "thermal/point/calibration_section.hpp"

#include <fmt/format.h>

#include <set>

#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_sought = 4;

struct KeyUnit {
    double factor, zero;
    bool operator==(const KeyUnit&) const = default;
};

std::vector<SoughtNumber> read_sought(const Section& section) {
    std::vector<SoughtNumber> sought;
    std::set<std::string> keys;
    const std::vector<Section> given =
        section.sections("sought", "a value of this file to be fitted");
    for (const Section& one : given) {
        SoughtNumber number;
        number.key = one.text("key", "path of the key: \"material.layers.0.conductivity_W_mK\"");
        number.low = one.number("low", "lowest value");
        number.high = one.number("high", "highest value");
        number.start =
            one.number_or("start", "initial value of the fit",
                          {0.5 * (number.low + number.high), "the mean of low and high"});
        number.where = one.where();
        if (!one.has_mistakes()) {
            if (!(number.low < number.high)) {
                one.mistake("high", fmt::format("found {:g}, expected above low = {:g}",
                                                number.high, number.low));
            } else if (number.start < number.low || number.start > number.high) {
                one.mistake("start", fmt::format("found {:g}, expected {:g} to {:g}", number.start,
                                                 number.low, number.high));
            }
            for (const char* own : {"calibrate.", "time.", "weather.file"}) {
                if (!number.key.starts_with(own)) continue;
                one.mistake("key", "expected a value that affects the heat balance");
            }
            if (!keys.insert(number.key).second) {
                one.mistake("key", fmt::format("\"{}\" is used twice", number.key));
            }
        }
        sought.push_back(std::move(number));
    }
    if (sought.empty() || sought.size() > most_sought) {
        section.mistake("sought", fmt::format("found {}, expected one to four tables with key, "
                                              "low, high",
                                              sought.size()));
    }
    return sought;
}

}  // namespace

std::optional<Calibration> read_calibration(const Section& root) {
    const Section section =
        root.section("calibrate", "measurement, and the values to be fitted: diurna calibrate");
    if (!root.has("calibrate")) return std::nullopt;
    Calibration asked;
    asked.file = section.file("measured",
                              "CSV file of time (instants with UTC offset) and a temperature; "
                              "empty cells are missing values");
    asked.column = section.text_or("column", "column of the temperature",
                                   {std::string(), "the only one besides time"});
    const KeyUnit unit = section.choice_or("unit", "unit of that column", KeyUnit{1.0, 0.0},
                                           {{"K", {1.0, 0.0}},
                                            {"degC", {1.0, zero_celsius}},
                                            {"degF", {5.0 / 9.0, zero_celsius - 160.0 / 9.0}}});
    asked.factor = unit.factor;
    asked.zero = unit.zero;
    asked.of = section.choice_or(
        "of", "temperature of the facet, or with a canopy of the ground or its leaves",
        MeasuredOf::surface,
        {{"surface", MeasuredOf::surface},
         {"back", MeasuredOf::back},
         {"ground", MeasuredOf::ground},
         {"leaf", MeasuredOf::leaf}});
    asked.depth = section.number_or("depth_m", "depth of a thermometer below the surface",
                                    {0.0, "of"}, {0.0, 100.0});
    if (asked.depth > 0.0 && section.has("of")) {
        section.mistake("depth_m", "has no effect with of");
    }
    asked.sought = read_sought(section);
    asked.where = section.where();
    return asked;
}

}  // namespace diurna
