#include "scenes/job/input/read_height.hpp"

#include <array>
#include <string>

namespace diurna {

namespace {

constexpr std::array keys{"height_above_ground_m", "height_above_sea_m",
                          "height_above_ellipsoid_m"};
constexpr std::array overs{HeightOver::ground, HeightOver::sea, HeightOver::ellipsoid};
constexpr std::array<const char*, 3> froms{"", ", above the sea instead of the ground",
                                           ", above the WGS84 ellipsoid, as given by GPS"};
constexpr Range absolute{-1000.0, 60000.0};

}  // namespace

HeightInput read_height(const Section& section, const char* says, std::optional<double> fallback,
                        Range above_ground) {
    HeightInput height{.metres = fallback.value_or(1.0)};
    bool given = false;
    for (std::size_t k = 1; k < keys.size(); ++k) {
        if (!section.has(keys[k])) continue;
        if (given || section.has(keys[0])) {
            section.mistake(keys[k], "found two heights, expected only one of " +
                                         std::string(keys[0]) + ", " + keys[1] + ", " + keys[2]);
        }
        given = true;
        const std::string line = std::string(says) + froms[k];
        height = {section.number(keys[k], line.c_str(), absolute), overs[k]};
    }
    if (given && !section.has(keys[0])) return height;
    const double metres = fallback ? section.number_or(keys[0], says, *fallback, above_ground)
                                   : section.number(keys[0], says, above_ground);
    return given ? height : HeightInput{metres, HeightOver::ground};
}

const char* height_key(const Section& section) {
    for (const char* key : keys) {
        if (section.has(key)) return key;
    }
    return keys[0];
}

void refuse_heights(const Section& section, const char* problem) {
    for (const char* key : keys) {
        if (section.has(key)) section.mistake(key, problem);
    }
}

}  // namespace diurna
