#include "scenes/job/input/read_uncertain.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace diurna {

std::string read_uncertain_key(const Section& section) {
    const std::string key = section.text("key", "path of the key: \"weather.changed.wind_factor\"");
    for (const char* own :
         {"crossover", "sweep", "detection", "signature", "observer", "contrast", "sensitivity",
          "uncertain", "scene", "time", "labels", "output", "instrument", "bands", "cubes"}) {
        if (!key.starts_with(std::string(own) + ".")) continue;
        section.mistake(
            "key", fmt::format("found a key of [{}], expected one of the world that affects light "
                               "or temperature",
                               own));
    }
    if (key == "tolerance_K" || key == "exact") {
        section.mistake("key", fmt::format("found {}, expected a value of the world", key));
    }
    return key;
}

std::vector<UncertainInput> read_uncertain_values(const Section& section, const char* says) {
    std::vector<UncertainInput> found;
    for (const Section& one : section.sections("uncertain", says)) {
        const std::string key = read_uncertain_key(one);
        if (std::any_of(found.begin(), found.end(), [&](const auto& f) { return f.key == key; })) {
            one.mistake("key", fmt::format("{} is uncertain twice, expected each key once", key));
        }
        found.push_back(
            {.key = key,
             .one_sigma = one.number("one_sigma",
                                     "the key's value one standard deviation (68 %) away from the "
                                     "scene's, not the deviation: 1.1 for a factor of 1 that is "
                                     "uncertain by 10 %"),
             .where = one.where()});
    }
    return found;
}

std::string plain_name(std::string name) {
    for (char& c : name) {
        if (c == ' ' || c == '/' || c == ':') c = '_';
    }
    return name;
}

}  // namespace diurna
