#include "scenes/job/input/read_contact.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"

namespace diurna {

ContactInput read_contact(const Section& section, std::span<const std::string> parts) {
    ContactInput contact;
    contact.where = section.where();
    const std::vector<std::string> between =
        section.texts_or("between",
                         "two names: a part whose outer faces touch another part, or \"ground\", "
                         "which then joins the object's thermal network below it",
                         {std::vector<std::string>{}, "required"});
    contact.film =
        section.number("conductance_W_m2K", "thermal conductance per area of contact", {0.0, 1e6});
    contact.gap = section.number_or("gap_m", "largest distance (or overlap) of facets in contact",
                                    0.02, {0.0, 1.0});
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
    if (contact.part == contact.on) section.mistake("between", "connects a part with itself");
    return contact;
}

}  // namespace diurna
