#include "scenes/job/input/read_uncertain.hpp"

#include <fmt/format.h>

namespace diurna {

std::string read_uncertain_key(const Section& section) {
    const std::string key = section.text("key", "path of the key: \"weather.changed.wind_factor\"");
    for (const char* own :
         {"crossover", "sweep", "detection", "signature", "observer", "contrast", "sensitivity"}) {
        if (!key.starts_with(std::string(own) + ".")) continue;
        section.mistake(
            "key", fmt::format(
                       "found a key of [{}], expected one that affects light or temperature", own));
    }
    return key;
}

std::string plain_name(std::string name) {
    for (char& c : name) {
        if (c == ' ' || c == '/' || c == ':') c = '_';
    }
    return name;
}

}  // namespace diurna
