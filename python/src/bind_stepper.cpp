#include <pybind11/eigen.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "python/src/bind.hpp"
#include "python/src/long_call.hpp"
#include "scenes/plan/prepared.hpp"
#include "scenes/run/stepper.hpp"

// A scene that Python drives (scenes/run/stepper.hpp).

namespace diurna::python {

namespace {

using Free = py::call_guard<py::gil_scoped_release>;

py::dict picture_of(Stepper& scene, const std::string& name, const Observer& pose) {
    return as_dict(found_by_long_call(
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

}  // namespace

void bind_stepper(py::module_& module) {
    py::class_<Observer>(module, "Observer", "Pose of a camera: change it and pass it to render().")
        .def_readonly("name", &Observer::name)
        .def_readwrite("position_m", &Observer::position, "east, north, up of the site")
        .def_readwrite("azimuth_deg", &Observer::azimuth_deg)
        .def_readwrite("elevation_deg", &Observer::elevation_deg)
        .def_readwrite("roll_deg", &Observer::roll_deg)
        .def_readwrite("horizontal_fov_deg", &Observer::horizontal_fov_deg)
        .def_readwrite("width", &Observer::width)
        .def_readwrite("height", &Observer::height);
    py::class_<Stepper>(module, "Stepper")
        .def(py::init([](const std::filesystem::path& file,
                         const std::vector<std::string>& settings, bool allow_outside) {
            return found_by_long_call(py::none(), [&](const ProgressTo&) {
                return std::make_unique<Stepper>(one_scene(file, settings, allow_outside));
            });
        }))
        .def("now", [](const Stepper& s) { return format_instant(s.now()); })
        .def("advance",
             [](Stepper& s, const std::string& to) {
                 long_call(py::none(), [&](const ProgressTo&) { s.advance(parse_instant(to)); });
             })
        .def(
            "put",
            [](Stepper& s, const std::string& object, double east, double north,
               double heading_deg) { s.put(object, Eigen::Vector2d(east, north), heading_deg); },
            Free())
        .def("pose", [](const Stepper& s,
                        const std::string& object) { return s.pose(object).matrix().eval(); })
        .def("temperature",
             [](Stepper& s) {
                 return as_array(found_by_long_call(
                     py::none(), [&](const ProgressTo&) { return s.temperature(); }));
             })
        .def("facets", &facets_of)
        .def("observer", &Stepper::observer)
        .def("picture", &picture_of)
        .def_property_readonly("steps_solved", &Stepper::steps_solved);
}

}  // namespace diurna::python
