#include "scenes/input/read_target.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "materials/base/document.hpp"
#include "scenes/input/read_contact.hpp"
#include "scenes/input/read_hours.hpp"
#include "scenes/input/read_jet.hpp"

namespace diurna {

namespace {

constexpr double water_heat_capacity = 4186.0;

bool read_runs(const Section& section) {
    const bool runs = section.flag_or(
        "runs", "its heat is released in the hours of the object's `running` alone", false);
    if (runs && section.has("hours")) {
        section.mistake("hours", "stands beside runs = true, expected one of the two");
    }
    return runs;
}

/// Gives what runs the hours of `running`; without them it is off.
void read_running(const Section& object, TargetInput& target) {
    const std::vector<ClockHours::Window> hours =
        windows_of(object, "running",
                   object.texts_or(
                       "running",
                       "when what has `runs` in its parts, lumps and jets (an engine, its exhaust) "
                       "releases heat or blows, and the share of it, as their `hours`",
                       {std::vector<std::string>{}, "never"}));
    bool any = false;
    const auto set = [&](auto& source) {
        if (!source.runs) return;
        any = true;
        source.hours = hours;
        if (!hours.empty()) return;
        source.watts = 0.0;
        source.kelvin = not_given;
    };
    for (PartInput& part : target.part) {
        set(part);
        if (part.runs && hours.empty()) part.watts_m2 = 0.0;
    }
    for (LumpInput& lump : target.lump) set(lump);
    for (JetInput& jet : target.jet) {
        if (!jet.runs) continue;
        any = true;
        jet.hours = hours;
    }
    if (hours.empty()) {  // no hours are all hours
        std::erase_if(target.jet, [](const JetInput& jet) { return jet.runs; });
    }
    if (object.has("running") && !any) {
        object.mistake("running", "none of its parts, lumps and jets has runs = true");
    }
}

/// A name of its own among those an object's links may give.
std::string own_name(const Section& section, const char* says, const TargetInput& target) {
    std::string name = section.text("name", says);
    if (name == outdoors_name || target.has_enclosure(name) || target.has_lump(name) ||
        (!name.empty() && target.find_part(name) >= 0)) {
        section.mistake("name", fmt::format("'{}' stands for something else already", name));
    }
    return name;
}

PartInput read_part(const Section& section, const Names& materials) {
    PartInput part;
    part.name = section.text("name",
                             "of a group, node or material of the mesh; \"*\": whatever no other "
                             "part names");
    part.material = section.name_or("material", "of it; else as the object says", "", materials);
    part.inside = section.text_or("inside", "the enclosure that its inner face looks into", "");
    part.inner_emissivity = section.number_or(
        "inner_emissivity", "of that face",
        {not_given, "that of the material's `back`, else of its front"}, {0.0, 1.0});
    part.watts =
        section.number_or("heat_W", "released in all of it, at its inner face", 0.0, {-1e7, 1e7});
    part.watts_m2 = section.number_or("heat_W_m2", "released in it, by its area", 0.0, {-1e5, 1e5});
    part.kelvin = section.number_or("temperature_K", "that its inner face is held at",
                                    {not_given, "none: it finds its own"}, {150.0, 2500.0});
    part.welded =
        section.flag_or("welded", "heat goes on over the edges it shares with other parts", true);
    part.hours = read_hours(section);
    part.runs = read_runs(section);
    part.where = section.where();
    if (!std::isnan(part.kelvin) && (part.watts != 0.0 || part.watts_m2 != 0.0)) {
        section.mistake(part.watts != 0.0 ? "heat_W" : "heat_W_m2",
                        "of a part that is held at temperature_K does nothing");
    }
    if (!part.hours.empty() && std::isnan(part.kelvin) && part.watts == 0.0 &&
        part.watts_m2 == 0.0) {
        section.mistake("hours", "of no heat and no temperature");
    }
    if (part.watts != 0.0 && part.watts_m2 != 0.0) {
        section.mistake("heat_W_m2", "stands beside heat_W, expected one of the two");
    }
    return part;
}

EnclosureInput read_enclosure(const Section& section, const TargetInput& target) {
    EnclosureInput room;
    room.name = own_name(section, "by which parts name it", target);
    room.volume = section.number("volume_m3", "of its air", {1e-6, 1e7});
    room.air_changes =
        section.number_or("air_changes_per_h", "of its air with that outdoors", 0.5, {0.0, 1e5});
    room.film =
        section.number_or("film_W_m2K", "between its air and its inner faces", 3.0, {0.0, 1000.0});
    return room;
}

LumpInput read_lump(const Section& section, const TargetInput& target) {
    LumpInput lump;
    lump.name = own_name(section, "of a thing of one temperature: an engine, coolant, oil", target);
    lump.capacity = section.number_or("heat_capacity_J_K", "of all of it", 0.0, {0.0, 1e12});
    lump.watts = section.number_or("heat_W", "released in it", 0.0, {-1e8, 1e8});
    lump.kelvin = section.number_or("temperature_K", "that it is held at",
                                    {not_given, "none: it finds its own"}, {150.0, 2500.0});
    lump.hours = read_hours(section);
    lump.runs = read_runs(section);
    if (!std::isnan(lump.kelvin) && lump.watts != 0.0) {
        section.mistake("heat_W", "of a lump that is held at temperature_K does nothing");
    }
    return lump;
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
        key, fmt::format("no '{}' in this object, which has {}", name, fmt::join(known, ", ")),
        did_you_mean(name, known));
}

LinkInput read_link(const Section& section, TargetInput& target) {
    LinkInput link;
    const std::vector<std::string> between = section.texts_or(
        "between", "two of the names of lumps, enclosures, parts (one at most) and \"outdoors\"",
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
        section.mistake("between", "joins two parts, expected a lump between them",
                        "parts that share edges conduct over them; others touch by way of a lump");
    }
    if (link.a == link.b) section.mistake("between", "joins a thing with itself");
    const bool to_part = target.find_part(link.b) >= 0;
    link.conductance = section.number_or("conductance_W_K", "of all of it",
                                         {not_given, "needed, or film_W_m2K"}, {0.0, 1e9});
    link.film = section.number_or("film_W_m2K", "of a part's inner face, by its area",
                                  {not_given, "needed, or conductance_W_K"}, {0.0, 1e6});
    if (std::isnan(link.conductance) == std::isnan(link.film)) {
        section.mistake("conductance_W_K", "expected either this or film_W_m2K");
    } else if (!to_part && !std::isnan(link.film)) {
        section.mistake("film_W_m2K", "needs a part, whose area it counts by");
    }
    link.where = section.where();
    return link;
}

StreamInput read_stream(const Section& section, const TargetInput& target) {
    StreamInput stream;
    stream.from = section.text("from", "the lump or enclosure that it leaves, or \"outdoors\"");
    stream.to = section.text("to", "the lump or enclosure that it enters, or \"outdoors\"");
    check_end(section, "from", stream.from, target, false);
    check_end(section, "to", stream.to, target, false);
    if (stream.from == stream.to) section.mistake("to", "leads where it comes from");
    const double flow = section.number("flow_kg_s", "of mass", {0.0, 1e6});
    stream.conductance = flow * section.number_or("heat_capacity_J_kgK", "of the fluid",
                                                  {water_heat_capacity, "water's"}, {10.0, 2e4});
    return stream;
}

void read_tables(const Section& root, const Names& materials, TargetInput& target) {
    for (const Section& section :
         root.sections("part",
                       "a part of the mesh as a body of heat: its facets conduct along the "
                       "sheet, and its inner face has surroundings of its own")) {
        PartInput part = read_part(section, materials);
        if (!part.name.empty() && target.find_part(part.name) >= 0) {
            section.mistake("name", fmt::format("'{}' stands twice, expected once", part.name));
        }
        target.part.push_back(std::move(part));
    }
    for (const Section& section :
         root.sections("enclosure",
                       "a room behind parts: its air, and the radiation between its "
                       "inner faces")) {
        target.enclosure.push_back(read_enclosure(section, target));
    }
    for (const Section& section : root.sections("lump", "something of one temperature within")) {
        target.lump.push_back(read_lump(section, target));
    }
    for (const Section& section : root.sections("link", "what conducts between two of them")) {
        target.link.push_back(read_link(section, target));
    }
    for (const Section& section :
         root.sections("stream", "fluid that carries heat from one to another, one way")) {
        target.stream.push_back(read_stream(section, target));
    }
    std::vector<std::string> parts;
    for (const PartInput& part : target.part) parts.push_back(part.name);
    for (const Section& section :
         root.sections("contact", "outer faces of a part that lie on the ground or on a part")) {
        target.contact.push_back(read_contact(section, parts));
    }
    std::vector<std::string> lumps;
    for (const LumpInput& lump : target.lump) lumps.push_back(lump.name);
    for (const EnclosureInput& room : target.enclosure) lumps.push_back(room.name);
    for (const Section& section :
         root.sections("jet",
                       "a stream of hot gas that warms what it blows over: the object's "
                       "facets, others, the ground")) {
        target.jet.push_back(read_jet(section, lumps));
    }
}

/// Which of the parts each part of the mesh is.
void match_parts(const Section& section, const MeshFile& mesh, TargetInput& target) {
    target.part_of.assign(mesh.part.size(), -1);
    std::vector<std::string> names;
    for (const MeshFile::Part& part : mesh.part) {
        for (const std::string& name : {part.node, part.material}) {
            const bool known = std::find(names.begin(), names.end(), name) != names.end();
            if (!name.empty() && !known) names.push_back(name);
        }
    }
    for (const bool others : {false, true}) {
        for (std::size_t k = 0; k < target.part.size(); ++k) {
            const PartInput& part = target.part[k];
            if ((part.name == "*") != others) continue;
            bool any = others;
            for (std::size_t p = 0; p < mesh.part.size(); ++p) {
                const bool named =
                    mesh.part[p].node == part.name || mesh.part[p].material == part.name;
                if (!(others ? target.part_of[p] < 0 : named)) continue;
                target.part_of[p] = int(k);
                any = true;
            }
            if (!any && !mesh.part.empty()) {
                section.mistake("part",
                                fmt::format("{}: no part \"{}\" in the mesh, which has {}",
                                            part.where, part.name, fmt::join(names, ", ")),
                                did_you_mean(part.name, names));
            }
            if (!part.inside.empty() && !target.has_enclosure(part.inside)) {
                section.mistake("part", fmt::format("{}: \"{}\" is inside of '{}', which is no "
                                                    "enclosure of this object",
                                                    part.where, part.name, part.inside));
            }
        }
    }
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
        section.mistake(
            "stream",
            fmt::format("'{}' gets {:g} W/K more than leaves it, expected as much", name, watts),
            "close the loop, or lead it to \"outdoors\"");
    }
}

}  // namespace

bool TargetInput::has_enclosure(const std::string& name) const {
    return std::any_of(enclosure.begin(), enclosure.end(),
                       [&](const EnclosureInput& room) { return room.name == name; });
}
bool TargetInput::has_lump(const std::string& name) const {
    return std::any_of(lump.begin(), lump.end(),
                       [&](const LumpInput& one) { return one.name == name; });
}
int TargetInput::find_part(const std::string& name) const {
    const auto found = std::find_if(part.begin(), part.end(),
                                    [&](const PartInput& one) { return one.name == name; });
    return found == part.end() ? -1 : int(found - part.begin());
}

TargetInput read_target(const Section& object, const std::filesystem::path& file,
                        const MeshFile& mesh, const Names& materials) {
    TargetInput target;
    read_tables(object, materials, target);
    target.file = file;
    if (!file.empty()) {
        if (!target.part.empty() || !target.lump.empty() || !target.enclosure.empty()) {
            object.mistake("part", fmt::format("stands beside the part file {}, expected one of "
                                               "the two",
                                               file.string()));
        }
        try {
            const Document document = Document::from_file(file);
            read_tables(document.root(), materials, target);
            document.finish();
        } catch (const InputError& error) {
            for (const Mistake& mistake : error.mistakes()) {
                object.mistake("part_file", mistake.where + ": " + mistake.problem, mistake.hint);
            }
        }
    }
    if (target.part.empty() &&
        (!target.lump.empty() || !target.enclosure.empty() || !target.link.empty() ||
         !target.stream.empty() || !target.contact.empty() || !target.jet.empty())) {
        object.mistake(
            "part",
            "missing, expected at least one: lumps, enclosures, contacts and jets act on parts",
            "[[object.part]] with name = \"*\" is all of the mesh");
    }
    read_running(object, target);
    match_parts(object, mesh, target);
    check_streams(object, target);
    for (const EnclosureInput& room : target.enclosure) {
        const bool used =
            std::any_of(target.part.begin(), target.part.end(),
                        [&](const PartInput& part) { return part.inside == room.name; });
        if (!used) {
            object.mistake("enclosure", fmt::format("no part is inside of '{}'", room.name));
        }
    }
    return target;
}

}  // namespace diurna
