#include "scenes/job/input/read_object.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "materials/base/number_of.hpp"
#include "scenes/job/input/read_copies.hpp"
#include "scenes/job/input/read_stance.hpp"
#include "scenes/job/input/read_target.hpp"
#include "terrain/objects/facing.hpp"
#include "terrain/objects/models/models.hpp"
#include "terrain/objects/models/net.hpp"
#include "terrain/objects/welded_faces.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

constexpr const char* paint = "painted_sheet";  // of a model's parts that have none of their own

double metres_per_unit(const Section& section) {
    const double unit = section.choice_or(
        "unit", "unit of the file's coordinates", 1.0,
        {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"ft", 0.3048}});
    return unit * section.number_or("scale",
                                    "factor on the file's coordinates, in addition to `unit`", 1.0,
                                    {1e-6, 1e6});
}

MeshFile read_mesh(const Section& section, const fs::path& file) {
    if (!section.has("mesh")) {
        section.mistake("mesh",
                        "missing, expected a file (.obj, .ply, .stl, .gltf or .glb) or `model`");
    }
    if (file.empty()) return {};
    try {
        return read_mesh_file(file, section.confines());
    } catch (const InputError& error) {
        section.mistake("mesh",
                        error.mistakes().front().where + ": " + error.mistakes().front().problem);
        return {};
    }
}

/// One of the program's own objects, by name; "": a file's.
std::string model_of(const Section& section) {
    const std::string model =
        section.name_or("model", "a built-in object instead of mesh (`diurna model` lists them)",
                        "", Names{.what = "model", .known = model_names()});
    if (model.empty()) return model;
    for (const char* key : {"mesh", "up", "unit", "scale"}) {
        if (section.has(key)) {
            section.mistake(key, "cannot be combined with model, which is in metres and upright");
        }
    }
    return model;
}

MeshFile read_model(const Section& section, const std::string& model) {
    const Detail detail = section.choice_or(
        "detail",
        "level of detail of a model: about 3 000 to 6 000, 7 000 to 11 000, 16 000 to 18 000 "
        "triangles",
        Detail::medium, {{"low", Detail::low}, {"medium", Detail::medium}, {"high", Detail::high}});
    return model.empty() ? MeshFile{} : model_mesh(model, detail);
}

/// Spreads the object's net, if it has one.
void spread_net(const Section& section, ObjectInput& object) {
    const double clearance = section.number_or("net_clearance_m",
                                               "distance of a net (camouflage_net) that covers a "
                                               "model down to the ground, as its part \"net\"",
                                               {0.0, "none"}, {0.05, 5.0});
    if (!section.has("net_clearance_m")) return;
    if (!object.file.empty()) {
        section.mistake("net_clearance_m", "needs model instead of mesh");
    } else if (!object.mesh->part.empty()) {
        constexpr double squares = 0.35;  // [m]
        add_net(*object.mesh, clearance, squares);
    }
}

/// The names by which a scene may tell a mesh's parts apart.
std::vector<std::string> part_names(const MeshFile& mesh) {
    std::vector<std::string> names;
    for (const MeshFile::Part& part : mesh.part) {
        for (const std::string& name : {part.node, part.material}) {
            if (!name.empty() && std::find(names.begin(), names.end(), name) == names.end()) {
                names.push_back(name);
            }
        }
    }
    return names;
}

/// The material of each part: what [object.parts] says of its node or its material's name, else
/// the object's own.
std::vector<std::string> part_materials(const Section& section, const ObjectInput& object,
                                        const Reading& reading) {
    const MeshFile& mesh = *object.mesh;
    const bool model = object.file.empty();
    const std::string own = section.name_or(
        "material",
        "material of the parts that neither `parts` nor a part file names; required if there are "
        "any",
        {model && !section.has("material") ? paint : "", "none; painted_sheet for a model"},
        reading.materials);
    std::vector<std::string> material(mesh.part.size(), own);
    for (std::size_t p = 0; p < material.size(); ++p) {
        const int part = object.target.given() ? object.target.part_of[p] : -1;
        if (part >= 0 && !object.target.part[std::size_t(part)].material.empty()) {
            material[p] = object.target.part[std::size_t(part)].material;
        } else if (model && !mesh.part[p].material.empty()) {
            material[p] = mesh.part[p].material;  // the net's
        }
    }
    const std::vector<std::string> names = part_names(mesh);
    const Section table = section.section(
        "parts", "materials of parts, by the file's names of groups, nodes or materials");
    for (const std::string& key : table.free_keys()) {
        const std::string chosen =
            table.name(key, "material of the part with this name", reading.materials);
        bool any = false;
        for (std::size_t p = 0; p < mesh.part.size(); ++p) {
            if (mesh.part[p].node != key && mesh.part[p].material != key) continue;
            material[p] = chosen;
            any = true;
        }
        if (!any && !mesh.part.empty()) {
            table.mistake(key, fmt::format("no such part; the mesh has {}", fmt::join(names, ", ")),
                          did_you_mean(key, names));
        }
    }
    for (std::size_t p = 0; p < material.size(); ++p) {
        if (!material[p].empty()) continue;
        section.mistake("material",
                        fmt::format("missing, and [object.parts] does not name part \"{}\"",
                                    mesh.part[p].node));
        break;
    }
    return material;
}

/// The file that reports of an object's parts: the one named, or the one beside its mesh; "": none.
fs::path part_file(const Section& section, const ObjectInput& object, const std::string& model) {
    const std::string named = section.text_or(
        "part_file", "file beside the mesh with the tables part, enclosure, lump, link and stream",
        {"", "NAME.parts.toml beside the mesh NAME.obj; a model has its own"});
    if (!named.empty()) return section.file_named("part_file", named);
    if (!model.empty()) return model_part_file(model);
    fs::path beside = object.file;
    beside.replace_extension(".parts.toml");
    if (object.mesh->part.empty() || !fs::exists(beside)) return {};
    if (const std::string why = why_not(section.confines(), beside); !why.empty()) {
        section.mistake("part_file", beside.string() + " " + why, allow_outside_hint);
        return {};
    }
    return beside;
}

/// Takes out of an object's mesh what lies there twice or has no area, and turns closed pieces
/// outward; notes it.
void weld(const Section& section, ObjectInput& object) {
    if (object.mesh->triangle.empty()) return;
    object.notes.insert(object.notes.end(), object.mesh->notes.begin(), object.mesh->notes.end());
    const std::size_t triangles = object.mesh->triangle.size();
    const WeldedFaces found = weld_faces(*object.mesh, object.material);
    if (object.mesh->triangle.empty()) {
        section.mistake("mesh", fmt::format("found {} triangles, all without area", triangles));
    }
    if (found.contested) {
        const auto [a, b] = *found.contested;
        section.mistake("mesh",
                        fmt::format("found triangles of \"{}\" and \"{}\" in the same place with "
                                    "the same orientation, expected one of them",
                                    object.material[a], object.material[b]),
                        "remove one from the mesh, or give both the same material in parts");
    }
    const std::size_t single = found.removed - std::min(found.removed, found.inner);
    if (found.inner > 0) {
        object.notes.push_back(
            fmt::format("{} of {} triangles are walls between bodies in contact, invisible from "
                        "outside, and are skipped",
                        found.inner + found.removed - single, triangles));
    }
    if (single > 0) {
        object.notes.push_back(
            fmt::format("{} of {} triangles coincide with another and count once: each facet of an "
                        "open mesh already has two sides",
                        single, triangles));
    }
    if (found.back_to_back > 0) {
        object.notes.push_back(
            fmt::format("{} back to back on triangles of another material: two layers without heat "
                        "exchange; for one sheet with two faces use one material with `back`",
                        number_of(found.back_to_back, "triangle lies", "triangles lie")));
    }
    if (found.flat > 0) {
        object.notes.push_back(
            fmt::format("{} of {} triangles have no area and are skipped", found.flat, triangles));
    }
    const std::string facing = facing_note(turn_outward(*object.mesh, object.material));
    if (!facing.empty()) object.notes.push_back(facing);
}

}  // namespace

namespace {

constexpr const char* height_of =
    "height of its lowest point; with pitch_deg or roll_deg that of the middle of its base";

/// Where it stands, or the way it goes.
void read_object_stand(const Section& section, const Reading& reading, ObjectInput& object) {
    if (section.has("copies") || section.has("copies_file")) {  // which say where each stands
        object.stands = read_height(section, height_of, 0.0, {-100.0, 1e4});
        return;
    }
    if (!section.has("trajectory")) {
        object.stands = read_height(section, height_of, 0.0, {-100.0, 1e4});
        object.place = reading.places.one(section, {"place_m", "place"},
                                          "place of the centre of its plan", object.stands);
        return;
    }
    object.trajectory = section.name(
        "trajectory",
        "trajectory of the object, instead of place, heading_deg and height: it is at rest at the "
        "first place before the trajectory's start and at the last place after its end",
        reading.trajectories);
    for (const char* key : {"place_m", "place", "heading_deg"}) {
        if (section.has(key))
            section.mistake(key, "cannot be combined with a trajectory, which gives it");
    }
    refuse_heights(section, "cannot be combined with a trajectory, which gives it");
    for (const char* key : {"texture", "airspeed_m_s"}) {
        if (section.has(key)) section.mistake(key, "not available for an object on a trajectory");
    }
}

}  // namespace

std::vector<ObjectInput> read_object(const Section& section, Reading& reading) {
    ObjectInput object;
    object.name = reading.object(section, "name of the object");
    reading.texture(section, reading.texture_uses.of_object, object.name);
    const std::string model = model_of(section);
    const std::string mesh =
        section.text_or("mesh", "OBJ, PLY, STL or glTF 2 file; required unless model is given", "");
    *object.mesh = read_model(section, model);
    if (!section.has("model")) {
        if (section.has("mesh")) object.file = section.file_named("mesh", mesh);
        *object.mesh = read_mesh(section, object.file);
        if (section.has("detail")) section.mistake("detail", "needs a model");
    }
    spread_net(section, object);
    object.kind = class_of(section, {model.empty() ? object.file.stem().string() : model,
                                     "the name of the model or mesh"});
    read_object_stand(section, reading, object);
    const std::string extension = object.file.extension().string();
    const bool upright = extension == ".stl" || extension == ".ply" || !model.empty();
    const std::string up =
        section.word_or("up", "axis of the file that points up",
                        {upright ? "z" : "y", "z in STL and PLY, otherwise y"}, {"y", "z"});
    object.placing = {
        .heading_deg = section.number_or("heading_deg",
                                         "direction of its front, clockwise from north: the file's "
                                         "+z where y is up, +y where z is",
                                         0.0, {-360.0, 360.0}),
        .up = up == "z" ? UpAxis::z : UpAxis::y,
        .metres = metres_per_unit(section),
        .largest_edge = section.number_or(
            "largest_edge_m", "largest edge of its triangles; longer ones are divided",
            {model.empty() ? 0.5 : 100.0, "0.5; for a model by its detail"}, {0.01, 100.0})};
    object.ground_edge = section.number_or(
        "ground_edge_m",
        "largest edge of the ground's triangles around it, as far as its shadow at 27 degrees sun "
        "elevation; for an object above the ground also where its shadow falls in the months of "
        "the span, there at least a fifth of its width",
        {0.0, "a twelfth of the object's width, at least 0.15"}, {0.05, 100.0});
    object.airspeed =
        section.number_or("airspeed_m_s",
                          "airspeed of flight along its heading, at its place: wind of that speed "
                          "on all its surfaces, with the recovery temperature of the air",
                          {0.0, "0: it has the weather's wind"}, {0.0, 1000.0});
    if (object.airspeed > 0.0 && section.has("texture")) {
        section.mistake("airspeed_m_s", "not available for an object with a texture");
    }
    object.target =
        read_target(section, part_file(section, object, model), *object.mesh, reading.materials);
    if (!object.trajectory.empty() && !object.target.contact.empty()) {
        section.mistake("trajectory",
                        "not available for an object in contact with the ground or with itself");
    }
    object.material = part_materials(section, object, reading);
    if (object.target.given() && section.has("texture")) {
        section.mistake("part", "not available for an object with a texture");
    }
    weld(section, object);
    read_stance(section, stands_upright(model), object);
    const char* height = height_key(section);
    object.where = section.where(section.has(height)          ? height
                                 : !object.trajectory.empty() ? "trajectory"
                                 : section.has("place")       ? "place"
                                                              : "place_m");
    return with_copies(section, std::move(object), reading);
}

}  // namespace diurna
