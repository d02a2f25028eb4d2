#include "terrain/objects/models/models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "materials/base/data_folder.hpp"
#include "materials/base/error.hpp"
#include "terrain/objects/models/families.hpp"

namespace diurna {

namespace {

struct Model {
    const char* name;
    const char* what;
    void (*make)(Workpiece&);
    std::array<double, 3> edge;  // (detail) [m]
    bool upright = false;        // whatever the ground's slope
};

constexpr std::array<Model, 11> models{{
    {"truck",
     "six-wheeled cargo truck with a bonnet and a canvas cover",
     make_truck,
     {0.8, 0.4, 0.19}},
    {"tracked_vehicle", "tracked vehicle with a turret", make_tracked_vehicle, {1.5, 0.55, 0.25}},
    {"tractor_and_trailer",
     "road tractor with a box trailer",
     make_tractor_and_trailer,
     {1.2, 0.6, 0.275}},
    {"fuel_tank", "horizontal tank on saddles, half full", make_fuel_tank, {0.38, 0.2, 0.115}},
    {"generator", "diesel set under a canopy", make_generator, {0.5, 0.167, 0.085}},
    {"mast", "lattice mast with two dishes", make_mast, {1.0, 0.45, 0.23}, true},
    {"house",
     "house of two storeys with four rooms and a loft",
     make_house,
     {1.0, 0.5, 0.28},
     true},
    {"hangar", "arched hall of sheet steel", make_hangar, {3.0, 1.3, 0.75}, true},
    {"steel_shed", "gabled shed of corrugated sheet", make_steel_shed, {1.6, 0.7, 0.375}, true},
    {"container", "freight container of 20 feet", make_container, {0.8, 0.3, 0.231}},
    {"aircraft", "twin-engined propeller aircraft, parked", make_aircraft, {1.0, 0.5, 0.23}},
}};

const Model* find_model(const std::string& name) {
    const auto found = std::find_if(models.begin(), models.end(),
                                    [&](const Model& model) { return model.name == name; });
    return found == models.end() ? nullptr : &*found;
}

}  // namespace

std::vector<std::string> model_names() {
    std::vector<std::string> names;
    for (const Model& model : models) names.emplace_back(model.name);
    return names;
}

bool stands_upright(const std::string& name) {
    const Model* model = find_model(name);
    return model != nullptr && model->upright;
}

std::string model_line(const std::string& name) {
    const Model* model = find_model(name);
    return model == nullptr ? "" : model->what;
}

MeshFile model_mesh(const std::string& name, Detail detail) {
    const Model* model = find_model(name);
    if (model == nullptr) {
        const std::vector<std::string> names = model_names();
        const std::string hint = did_you_mean(name, names);
        throw InputError("model", fmt::format("unknown model '{}'", name),
                         hint.empty() ? fmt::format("{}", fmt::join(names, ", ")) : hint);
    }
    const auto level = static_cast<std::size_t>(detail);
    Workpiece work{.mesh = {}, .fine = {.edge = model->edge[level], .arc = 2 + int(level)}};
    model->make(work);
    return work.mesh;
}

std::filesystem::path model_part_file(const std::string& name) {
    return data_folder() / "models" / (name + ".parts.toml");
}

}  // namespace diurna
