#include "scenes/input/read_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"

namespace diurna {

ContactInput read_contact(const Section& section, std::span<const std::string> parts) {
    ContactInput contact;
    contact.where = section.where();
    const std::vector<std::string> between = section.texts_or(
        "between",
        "a part whose outer faces lie on another part's, or on \"ground\", which then is one body "
        "of heat with the object where they lie",
        {std::vector<std::string>{}, "required"});
    contact.film = section.number("conductance_W_m2K", "of the area that touches", {0.0, 1e6});
    contact.gap = section.number_or(
        "gap_m", "by which facets that touch may be apart, or in one another", 0.02, {0.0, 1.0});
    if (between.size() != 2) {
        section.mistake("between", fmt::format("found {} names, expected two", between.size()));
        return contact;
    }
    contact.part = between[0];
    contact.on = between[1];
    if (contact.part == ground_name) std::swap(contact.part, contact.on);
    std::vector<std::string> known{ground_name};
    known.insert(known.end(), parts.begin(), parts.end());
    for (const std::string& name : between) {
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        section.mistake(
            "between",
            fmt::format("no part '{}' in this object, which has {}", name, fmt::join(known, ", ")),
            did_you_mean(name, known));
    }
    if (contact.part == contact.on) section.mistake("between", "joins a thing with itself");
    return contact;
}

}  // namespace diurna
