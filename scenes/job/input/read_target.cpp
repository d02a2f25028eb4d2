#include "scenes/job/input/read_target.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/document.hpp"
#include "scenes/job/input/read_contact.hpp"
#include "scenes/job/input/read_hours.hpp"
#include "scenes/job/input/read_jet.hpp"
#include "scenes/job/input/read_lumps.hpp"

namespace diurna {

namespace {

/// Gives what runs the hours of `running`; without them it is off.
void read_running(const Section& object, TargetInput& target) {
    const std::vector<ClockHours::Window> hours =
        windows_of(object, "running",
                   object.texts_or("running",
                                   "operating hours of the parts, lumps and jets with `runs` (an "
                                   "engine, its exhaust), and their share, in the form of `hours`",
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

PartInput read_part(const Section& section, const Names& materials) {
    PartInput part;
    part.name = section.text("name",
                             "name of a group, node or material of the mesh; \"*\": everything "
                             "that no other part names");
    part.material = section.name_or(
        "material", "material of the part; default: as the object declares", "", materials);
    part.inside = section.text_or("inside", "enclosure that its inner face faces", "");
    part.inner_emissivity = section.number_or(
        "inner_emissivity", "emissivity of its inner face",
        {not_given, "that of the material's `back`, otherwise of its front"}, {0.0, 1.0});
    part.watts = section.number_or("heat_W", "heat released in the whole part, at its inner face",
                                   0.0, {-1e7, 1e7});
    part.watts_m2 = section.number_or("heat_W_m2", "heat released per area", 0.0, {-1e5, 1e5});
    part.kelvin = section.number_or("temperature_K", "fixed temperature of its inner face",
                                    {not_given, "none: computed"}, {150.0, 2500.0});
    part.welded =
        section.flag_or("welded", "conduct heat across the edges shared with other parts", true);
    part.hours = read_hours(section);
    part.runs = read_runs(section);
    part.where = section.where();
    if (!std::isnan(part.kelvin) && (part.watts != 0.0 || part.watts_m2 != 0.0)) {
        section.mistake(part.watts != 0.0 ? "heat_W" : "heat_W_m2",
                        "has no effect on a part with a fixed temperature_K");
    }
    if ((!part.hours.empty() || part.runs) && std::isnan(part.kelvin) && part.watts == 0.0 &&
        part.watts_m2 == 0.0) {
        section.mistake(part.runs ? "runs" : "hours",
                        "has no effect without heat or temperature_K");
    }
    if (part.watts != 0.0 && part.watts_m2 != 0.0) {
        section.mistake("heat_W_m2", "cannot be combined with heat_W");
    }
    return part;
}

void read_tables(const Section& root, const Names& materials, TargetInput& target) {
    for (const Section& section :
         root.sections("part",
                       "a part of the mesh in the thermal network: its facets conduct along the "
                       "sheet, and its inner face has its own surroundings")) {
        PartInput part = read_part(section, materials);
        if (!part.name.empty() && target.find_part(part.name) >= 0) {
            section.mistake("name", fmt::format("'{}' is defined twice, expected once", part.name));
        }
        target.part.push_back(std::move(part));
    }
    for (const Section& section :
         root.sections("enclosure",
                       "a room behind parts: its air, and the radiation between its inner faces")) {
        target.enclosure.push_back(read_enclosure(section, target));
    }
    for (const Section& section :
         root.sections("lump", "a body of one temperature inside the object")) {
        target.lump.push_back(read_lump(section, target));
    }
    for (const Section& section : root.sections("link", "conductance between two of them")) {
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
        ContactInput contact = read_contact(section, parts);
        for (const ContactInput& other : target.contact) {
            const bool same = other.part == contact.part && other.on == contact.on;
            if (!same && !(other.part == contact.on && other.on == contact.part)) continue;
            section.mistake(
                "between", fmt::format("connects '{}' and '{}' as {} does, expected one connection",
                                       contact.part, contact.on, other.where));
        }
        target.contact.push_back(std::move(contact));
    }
    std::vector<std::string> lumps;
    for (const LumpInput& lump : target.lump) lumps.push_back(lump.name);
    for (const EnclosureInput& room : target.enclosure) lumps.push_back(room.name);
    for (const Section& section : root.sections("jet",
                                                "a jet of hot gas that heats surfaces in its path: "
                                                "the object's facets, others, the ground")) {
        JetInput jet = read_jet(section, lumps);
        const bool known =
            std::any_of(target.jet.begin(), target.jet.end(),
                        [&](const JetInput& other) { return other.name == jet.name; });
        if (known) {
            section.mistake("name", fmt::format("'{}' is defined twice, expected once", jet.name));
        }
        target.jet.push_back(std::move(jet));
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
                section.mistake(
                    "part",
                    fmt::format(
                        "{}: \"{}\" is inside of '{}', which is not an enclosure of this object",
                        part.where, part.name, part.inside));
            }
        }
    }
}

}  // namespace

TargetInput read_target(const Section& object, const std::filesystem::path& file,
                        const MeshFile& mesh, const Names& materials) {
    TargetInput target;
    read_tables(object, materials, target);
    target.file = file;
    if (!file.empty()) {
        if (!target.part.empty() || !target.lump.empty() || !target.enclosure.empty()) {
            object.mistake("part",
                           fmt::format("cannot be combined with the part file {}", file.string()));
        }
        try {
            const Document document = Document::from_file(file, object.confines());
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
            "[[object.part]] with name = \"*\" is the whole mesh");
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
