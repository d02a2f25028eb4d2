#include "scenes/job/input/read_radiometer.hpp"

#include <fmt/format.h>

#include "scenes/job/input/read_signature.hpp"

namespace diurna {

namespace {

/// The way one receiver faces; none for six of them.
std::optional<Eigen::Vector3d> read_normal(const Section& section) {
    const std::vector<double> axes =
        section.numbers_or_word("normal",
                                "[east, north, up] normal of one receiver; \"six\": six receivers "
                                "face up, down, north, east, south and west",
                                "six", 3, {-1e6, 1e6});
    if (axes.empty()) return std::nullopt;
    const Eigen::Vector3d normal(axes[0], axes[1], axes[2]);
    if (!(normal.stableNorm() > 1e-6)) {
        section.mistake("normal", "has no direction, expected [east, north, up] such as [0, 0, 1]");
        return Eigen::Vector3d::UnitZ();
    }
    return normal.stableNormalized();
}

}  // namespace

std::vector<RadiometerInput> read_radiometers(const Section& root, const ScenePlaces& places) {
    std::vector<RadiometerInput> radiometers;
    std::vector<std::string> names;
    for (const Section& section :
         root.sections("radiometer",
                       "pyranometers and pyrgeometers at a place: shortwave and longwave "
                       "irradiance at every step of the heat balance, in radiometer_NAME.csv")) {
        RadiometerInput input{
            .name = study_name(section, {"", "required"}, names),
            .stands = read_height(section, "height of the receivers", 1.1, {0.02, 1e4}),
            .where = section.where()};
        constexpr double highest = 2e4;  // [m] above: no air as near the ground
        if (input.stands.over != HeightOver::ground && input.stands.metres > highest) {
            section.mistake(height_key(section),
                            fmt::format("found {:g}, expected a number up to {:g}",
                                        input.stands.metres, highest));
        }
        if (input.name.empty()) section.mistake("name", "missing, expected a name");
        input.place =
            places.one(section, {"place_m", "place"}, "place of the receivers", input.stands);
        input.normal = read_normal(section);
        radiometers.push_back(std::move(input));
    }
    return radiometers;
}

}  // namespace diurna
