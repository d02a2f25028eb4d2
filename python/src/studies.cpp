#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "python/src/bind.hpp"
#include "python/src/long_call.hpp"
#include "scenes/studies/asked_studies.hpp"

// Studies of a scene, their results as the texts of their files.

namespace diurna::python {

py::dict as_dict(const StudyFindings& found) {
    py::list findings;
    for (const StudyFinding& one : found.finding) {
        py::dict texts;
        texts[".csv"] = one.texts.csv;
        texts[".json"] = one.texts.json;
        texts[".svg"] = one.texts.svg;
        for (const auto& [ending, text] : one.texts.more) texts[ending.c_str()] = text;
        py::dict finding;
        finding["name"] = one.name;
        finding["texts"] = texts;
        finding["text"] = one.reported;
        finding["notes"] = one.notes;
        findings.append(finding);
    }
    py::dict out;
    out["findings"] = findings;
    out["notes"] = found.notes;
    out["not_converged"] = found.not_converged;
    return out;
}

namespace {

py::dict study(const std::string& kind, const std::filesystem::path& file,
               const std::vector<std::string>& settings, bool allow_outside,
               const std::filesystem::path& temperatures, const std::filesystem::path& out,
               const py::object& progress) {
    return as_dict(result_of_long_call(progress, [&](const ProgressTo& to) {
        return study_kind(kind).find({.scene = file,
                                      .settings = settings,
                                      .allow_outside = allow_outside,
                                      .temperatures = temperatures,
                                      .out = out,
                                      .progress = to});
    }));
}

}  // namespace

void bind_studies(py::module_& module) {
    module.def("study", &study, "Results of all tables of one kind of study in a scene.",
               py::arg("kind"), py::arg("file"), py::arg("settings"), py::arg("allow_outside"),
               py::arg("temperatures"), py::arg("out"), py::arg("progress"));
}

}  // namespace diurna::python
