#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/picture/frame.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/studies/study_request.hpp"
#include "terrain/place/instant.hpp"

// Conversions that several sources of the module use.

namespace diurna::python {

namespace py = pybind11;

/// A vector as an array of this shape that owns it: nothing is copied.
template <typename T>
py::array_t<T> as_array(std::vector<T>&& values, std::vector<py::ssize_t> shape) {
    auto owned = std::make_unique<std::vector<T>>(std::move(values));
    T* const first = owned->data();
    const py::capsule owner(owned.get(), [](void* it) { delete static_cast<std::vector<T>*>(it); });
    owned.release();
    return py::array_t<T>(std::move(shape), first, owner);
}
template <typename T>
py::array_t<T> as_array(std::vector<T>&& values) {
    const auto size = static_cast<py::ssize_t>(values.size());
    return as_array(std::move(values), {size});
}

/// Instants as numpy's datetime64[ms], in UTC.
py::object as_datetimes(const std::vector<Instant>& instants);

/// A scene file. Throws InputError where it has a [sweep]: that is many scenes.
Scene one_scene(const std::filesystem::path& file, const std::vector<std::string>& settings,
                bool allow_outside);

/// A picture's planes by name, as arrays (row, column), and their units, instant and attributes.
py::dict as_dict(Frame&& frame);

/// Results of studies: of each its name, the texts of its files, its printed lines and its notes.
py::dict as_dict(const StudyFindings& found);

void bind_column(py::module_& module);
void bind_lists(py::module_& module);
void bind_point(py::module_& module);
void bind_scene(py::module_& module);
void bind_stepper(py::module_& module);
void bind_studies(py::module_& module);

}  // namespace diurna::python
