#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "python/src/bind.hpp"
#include "python/src/long_call.hpp"
#include "python/src/thread_limit.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/stepper.hpp"

// A scene that Python drives (scenes/job/run/stepper.hpp).

namespace diurna::python {

namespace {

using Free = py::call_guard<py::gil_scoped_release>;

py::dict picture_of(Stepper& scene, const std::string& name, const Observer& pose) {
    return as_dict(result_of_long_call(
        py::none(), [&](const ProgressTo&) { return scene.picture(name, pose).frame; }));
}

py::dict facets_of(const Stepper& scene) {
    const World& world = scene.prepared().world;
    const FacetSet& facets = world.surfaces();
    std::vector<float> vertex, normal;
    std::vector<std::uint32_t> corner;
    std::vector<std::int32_t> material, object;
    for (const auto& v : facets.vertex) vertex.insert(vertex.end(), {v.x(), v.y(), v.z()});
    for (const auto& n : facets.normal) normal.insert(normal.end(), {n.x(), n.y(), n.z()});
    for (const auto& c : facets.corner) corner.insert(corner.end(), c.begin(), c.end());
    for (const MaterialId m : facets.material)
        material.push_back(static_cast<std::int32_t>(index(m)));
    for (const ObjectId o : facets.object) object.push_back(static_cast<std::int32_t>(o));
    const auto vertices = static_cast<py::ssize_t>(facets.vertex.size());
    const auto size = static_cast<py::ssize_t>(facets.size());
    py::dict out;
    out["vertex_m"] = as_array(std::move(vertex), {vertices, 3});
    out["corner"] = as_array(std::move(corner), {size, 3});
    out["normal"] = as_array(std::move(normal), {size, 3});
    out["area_m2"] = as_array(std::vector<float>(facets.area));
    out["material"] = as_array(std::move(material));
    out["object"] = as_array(std::move(object));
    return out;
}

std::vector<std::string> material_names(const Stepper& scene) {
    return scene.prepared().scene.materials.names();
}

std::vector<std::string> object_names(const Stepper& scene) {
    return scene.prepared().world.objects;
}

}  // namespace

void bind_stepper(py::module_& module) {
    py::class_<Observer>(module, "Observer", "Position and direction of a camera.")
        .def_readonly("name", &Observer::name, "The observer's name in the scene.")
        .def_readwrite("position_m", &Observer::position, "East, north, up of the site [m].")
        .def_readwrite("azimuth_deg", &Observer::azimuth_deg,
                       "Of the line of sight, clockwise from north [deg].")
        .def_readwrite("elevation_deg", &Observer::elevation_deg,
                       "Of the line of sight above the horizontal [deg].")
        .def_readwrite("roll_deg", &Observer::roll_deg, "About the line of sight [deg].")
        .def_readwrite("horizontal_fov_deg", &Observer::horizontal_fov_deg,
                       "Horizontal field of view [deg].")
        .def_readwrite("width", &Observer::width, "Pixels of a row.")
        .def_readwrite("height", &Observer::height, "Rows.");
    py::class_<Stepper>(module, "Stepper", "A scene that a program drives.")
        .def(py::init([](const std::filesystem::path& file,
                         const std::vector<std::string>& settings, bool allow_outside) {
                 return result_of_long_call(py::none(), [&](const ProgressTo&) {
                     return std::make_unique<Stepper>(one_scene(file, settings, allow_outside));
                 });
             }),
             py::arg("file"), py::arg("settings"), py::arg("allow_outside"))
        .def(
            "now", [](const Stepper& s) { return format_instant(s.now()); }, "ISO 8601, UTC.")
        .def(
            "advance",
            [](Stepper& s, const std::string& to) {
                const Instant instant = parse_instant(to, "to");
                long_call(py::none(), [&](const ProgressTo&) { s.advance(instant); });
            },
            "Solves up to an instant.", py::arg("to"))
        .def(
            "put",
            [](Stepper& s, const std::string& object, double east, double north,
               double heading_deg) {
                const RunningCall running;
                s.put(object, Eigen::Vector2d(east, north), heading_deg);
            },
            Free(), "Puts an object on the ground at a place.", py::arg("name"), py::arg("east_m"),
            py::arg("north_m"), py::arg("heading_deg"))
        .def(
            "pose",
            [](const Stepper& s, const std::string& object) {
                return s.pose(object).matrix().eval();
            },
            "4 x 4, from the object's frame to the site's.", py::arg("name"))
        .def(
            "temperature",
            [](Stepper& s) {
                return as_array(result_of_long_call(
                    py::none(), [&](const ProgressTo&) { return s.temperature(); }));
            },
            "[K] (facet) now.")
        .def("facets", &facets_of, "Mesh, materials and objects of all facets.")
        .def("material_names", &material_names, "By the numbers of facets().")
        .def("object_names", &object_names, "By the numbers of facets().")
        .def("observer", &Stepper::observer, "Pose of an observer in its first picture.",
             py::arg("name"))
        .def("picture", &picture_of, "What an observer sees now.", py::arg("name"), py::arg("pose"))
        .def_property_readonly("steps_solved", &Stepper::steps_solved,
                               "Steps of the heat balance solved so far.");
}

}  // namespace diurna::python
