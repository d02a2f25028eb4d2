#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <optional>

#include "materials/matter/library_parts.hpp"
#include "python/src/bind.hpp"
#include "python/src/long_call.hpp"
#include "scenes/studies/calibrate_study.hpp"
#include "thermal/point/point_job_file.hpp"
#include "thermal/point/run_column.hpp"

// One facet driven by a weather file, and the calibration of its keys against a measured curve.

namespace diurna::python {

namespace {

using Settings = std::vector<std::string>;

/// A column file, or the text of one.
struct ColumnSource {
    std::filesystem::path file;
    std::optional<std::string> text;
    Settings settings;
    std::vector<std::filesystem::path> folders;  // whose files it may name as well
    bool allow_outside = false;

    PointJob job(const Settings& more = {}) const {
        Confines confines = confines_of(file, allow_outside);
        for (const auto& folder : folders)
            confines.folders.push_back(std::filesystem::weakly_canonical(folder));
        Document document = text ? Document::from_text(*text, file.string(), confines)
                                 : Document::from_file(file, confines);
        apply_settings(document, joined(settings, more), MaterialTables::one);
        return read_column_job(document);
    }
};

py::dict column(const ColumnSource& source) {
    PointResult result = result_of_long_call(
        py::none(), [&](const ProgressTo&) { return run_column(source.job()); });
    py::dict columns;
    std::vector<Instant> times;
    for (const PointRow& row : result.row) times.push_back(row.instant);
    columns["time"] = as_datetimes(times);
    const auto add = [&](const char* name, double PointRow::*member) {
        std::vector<double> values;
        for (const PointRow& row : result.row) values.push_back(row.*member);
        columns[name] = as_array(std::move(values));
    };
    add("surface_temperature_K", &PointRow::surface_temperature);
    add("absorbed_solar_W_m2", &PointRow::absorbed_solar);
    add("longwave_in_W_m2", &PointRow::longwave_in);
    add("longwave_out_W_m2", &PointRow::longwave_out);
    add("sensible_W_m2", &PointRow::sensible);
    add("latent_W_m2", &PointRow::latent);
    add("conducted_W_m2", &PointRow::conducted);
    if (result.has_back) add("back_temperature_K", &PointRow::back_temperature);
    if (result.has_canopy) {
        add("ground_temperature_K", &PointRow::ground_temperature);
        add("leaf_temperature_K", &PointRow::leaf_temperature);
    }
    if (result.has_store) {
        add("water_mm", &PointRow::water_mm);
        add("frost_mm", &PointRow::frost_mm);
    }
    if (result.has_melt) add("melt_W_m2", &PointRow::melt);
    py::dict out;
    out["columns"] = columns;
    out["note"] = result.note;
    out["converged"] = result.converged;
    out["passes"] = result.passes;
    out["periodic_residual_K"] = result.periodic_residual;
    out["depth_m"] = as_array(std::move(result.depth));
    out["final_profile_K"] = as_array(std::move(result.final_profile));
    return out;
}

py::dict calibrate(const ColumnSource& source, const std::filesystem::path& out) {
    return as_dict(result_of_long_call(py::none(), [&](const ProgressTo&) {
        return calibrate_study(
            {.file = source.file.string(),
             .column_with = [&](const Settings& more) { return source.job(more); },
             .out = out});
    }));
}

}  // namespace

void bind_column(py::module_& module) {
    py::class_<ColumnSource>(module, "ColumnSource", "A column file, or the text of one.")
        .def(py::init([](const std::filesystem::path& file, const std::optional<std::string>& text,
                         const Settings& settings,
                         const std::vector<std::filesystem::path>& folders, bool allow_outside) {
                 return ColumnSource{file, text, settings, folders, allow_outside};
             }),
             py::arg("file"), py::arg("text"), py::arg("settings"), py::arg("folders"),
             py::arg("allow_outside"));
    module.def("column", &column, "Solves a column; its curves by name.", py::arg("source"));
    module.def("calibrate", &calibrate, "Calibrates a column; its results as of a study.",
               py::arg("source"), py::arg("out"));
}

}  // namespace diurna::python
