#include <pybind11/stl.h>

#include "materials/base/data_folder.hpp"
#include "materials/base/error.hpp"
#include "python/src/bind.hpp"
#include "python/src/thread_limit.hpp"

// The compiled module diurna._core. python/diurna is its public interface.

namespace diurna::python {

py::object as_datetimes(const std::vector<Instant>& instants) {
    std::vector<std::int64_t> milliseconds;
    for (const Instant& instant : instants)
        milliseconds.push_back(instant.time_since_epoch().count());
    return as_array(std::move(milliseconds)).attr("view")("datetime64[ms]");
}

namespace {

/// InputError as diurna.Error: its mistakes as (where, problem, hint).
void translate(const InputError& error) {
    py::list mistakes;
    for (const Mistake& mistake : error.mistakes())
        mistakes.append(py::make_tuple(mistake.where, mistake.problem, mistake.hint));
    const py::object kind = py::module_::import("diurna.errors").attr("Error");
    PyErr_SetObject(kind.ptr(), kind(mistakes).ptr());
}

}  // namespace

}  // namespace diurna::python

PYBIND11_MODULE(_core, module) {
    using namespace diurna;
    namespace py = pybind11;
    module.attr("version") = DIURNA_VERSION;
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const InputError& error) {
            python::translate(error);
        }
    });
    module.doc() = "The compiled part of diurna; use the package instead.";
    module.def(
        "data_folder", [] { return data_folder().string(); },
        "Folder of the library, spectra and tables.");
    module.def("set_threads", &python::set_threads, "Worker threads of all later calls.",
               py::arg("threads"));
    python::bind_column(module);
    python::bind_lists(module);
    python::bind_point(module);
    python::bind_scene(module);
    python::bind_stepper(module);
    python::bind_studies(module);
}
