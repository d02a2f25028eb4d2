#include "scenes/job/input/read_lumps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "materials/base/error.hpp"
#include "scenes/job/input/read_hours.hpp"

namespace diurna {

namespace {

constexpr double water_heat_capacity = 4186.0;

/// A name of its own among those an object's links may give.
std::string own_name(const Section& section, const char* says, const TargetInput& target) {
    std::string name = section.text("name", says);
    if (name == outdoors_name || name == ground_name || target.has_enclosure(name) ||
        target.has_lump(name) || (!name.empty() && target.find_part(name) >= 0)) {
        section.mistake("name", fmt::format("the name '{}' is already in use", name));
    }
    return name;
}

/// One of the object's parts, enclosures and lumps, or the air outdoors.
void check_end(const Section& section, const std::string& key, const std::string& name,
               const TargetInput& target, bool parts) {
    std::vector<std::string> known{outdoors_name};
    for (const EnclosureInput& room : target.enclosure) known.push_back(room.name);
    for (const LumpInput& lump : target.lump) known.push_back(lump.name);
    if (parts) {
        for (const PartInput& part : target.part) known.push_back(part.name);
    }
    if (name.empty() || std::find(known.begin(), known.end(), name) != known.end()) return;
    section.mistake(
        key, fmt::format("unknown '{}' in this object, which has {}", name, fmt::join(known, ", ")),
        did_you_mean(name, known));
}

}  // namespace

EnclosureInput read_enclosure(const Section& section, const TargetInput& target) {
    EnclosureInput room;
    room.name = own_name(section, "name by which parts refer to it", target);
    room.volume = section.number("volume_m3", "volume of its air", {1e-6, 1e7});
    room.air_changes = section.number_or("air_changes_per_h",
                                         "air changes per hour with outdoor air", 0.5, {0.0, 1e5});
    room.film = section.number_or("film_W_m2K",
                                  "convective coefficient between its air and its inner faces", 3.0,
                                  {0.0, 1000.0});
    return room;
}

LumpInput read_lump(const Section& section, const TargetInput& target) {
    LumpInput lump;
    lump.name =
        own_name(section, "name of a body of one temperature: an engine, coolant, oil", target);
    lump.capacity =
        section.number_or("heat_capacity_J_K", "heat capacity of the whole body", 0.0, {0.0, 1e12});
    lump.watts = section.number_or("heat_W", "heat released in it", 0.0, {-1e8, 1e8});
    lump.kelvin = section.number_or("temperature_K", "fixed temperature",
                                    {not_given, "none: computed"}, {150.0, 2500.0});
    lump.hours = read_hours(section);
    lump.runs = read_runs(section);
    if ((!lump.hours.empty() || lump.runs) && std::isnan(lump.kelvin) && lump.watts == 0.0) {
        section.mistake(lump.runs ? "runs" : "hours",
                        "has no effect without heat_W or temperature_K");
    }
    if (!std::isnan(lump.kelvin) && lump.capacity != 0.0) {
        section.mistake("heat_capacity_J_K", "has no effect on a lump with a fixed temperature_K");
    }
    if (!std::isnan(lump.kelvin) && lump.watts != 0.0) {
        section.mistake("heat_W", "has no effect on a lump with a fixed temperature_K");
    }
    return lump;
}

LinkInput read_link(const Section& section, TargetInput& target) {
    LinkInput link;
    const std::vector<std::string> between = section.texts_or(
        "between", "two names of lumps, enclosures, parts (at most one) and \"outdoors\"",
        {std::vector<std::string>{}, "required"});
    if (between.size() != 2) {
        section.mistake("between", fmt::format("found {} names, expected two", between.size()));
        return link;
    }
    link.a = between[0];
    link.b = between[1];
    for (const std::string& name : between) check_end(section, "between", name, target, true);
    if (target.find_part(link.a) >= 0) std::swap(link.a, link.b);
    if (target.find_part(link.a) >= 0) {
        section.mistake("between", "connects two parts, expected a lump between them",
                        "parts with common edges conduct across them; connect others by a lump");
    }
    if (link.a == link.b) section.mistake("between", "connects a name with itself");
    const bool to_part = target.find_part(link.b) >= 0;
    link.conductance =
        section.number_or("conductance_W_K", "total conductance",
                          {not_given, "required unless film_W_m2K is given"}, {0.0, 1e9});
    link.film =
        section.number_or("film_W_m2K", "conductance per area of a part's inner face",
                          {not_given, "required unless conductance_W_K is given"}, {0.0, 1e6});
    if (std::isnan(link.conductance) == std::isnan(link.film)) {
        section.mistake("conductance_W_K", "expected exactly one of this and film_W_m2K");
    } else if (!to_part && !std::isnan(link.film)) {
        section.mistake("film_W_m2K", "needs a part, whose area it is multiplied by");
    }
    link.where = section.where();
    return link;
}

StreamInput read_stream(const Section& section, const TargetInput& target) {
    StreamInput stream;
    stream.from = section.text("from", "lump or enclosure that the fluid leaves, or \"outdoors\"");
    stream.to = section.text("to", "lump or enclosure that the fluid enters, or \"outdoors\"");
    check_end(section, "from", stream.from, target, false);
    check_end(section, "to", stream.to, target, false);
    if (stream.from == stream.to) section.mistake("to", "is the same as from");
    const double flow = section.number("flow_kg_s", "mass flow", {0.0, 1e6});
    stream.conductance =
        flow * section.number_or("heat_capacity_J_kgK", "specific heat of the fluid",
                                 {water_heat_capacity, "water's"}, {10.0, 2e4});
    return stream;
}

/// As much must leave each lump and enclosure as enters it, or heat comes of nothing.
void check_streams(const Section& section, const TargetInput& target) {
    std::map<std::string, double> more, all;
    for (const StreamInput& stream : target.stream) {
        more[stream.to] += stream.conductance;
        more[stream.from] -= stream.conductance;
        all[stream.to] += stream.conductance;
        all[stream.from] += stream.conductance;
    }
    for (const auto& [name, watts] : more) {
        if (name == outdoors_name || std::abs(watts) <= 1e-3 * all[name]) continue;
        section.mistake("stream",
                        fmt::format("the flow into '{}' is {:g} W/K larger than the flow out of "
                                    "it, expected equal flows",
                                    name, watts),
                        "close the loop, or let it end at \"outdoors\"");
    }
}

}  // namespace diurna
