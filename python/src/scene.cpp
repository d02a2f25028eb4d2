#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <cstdint>
#include <optional>

#include "materials/base/error.hpp"
#include "python/src/bind.hpp"
#include "python/src/long_call.hpp"
#include "python/src/thread_limit.hpp"
#include "render/picture/exr.hpp"
#include "scenes/app/sweep/checked_scene.hpp"
#include "scenes/app/sweep/run_sweep.hpp"
#include "scenes/app/sweep/sweep_plan.hpp"
#include "scenes/app/sweep/variants.hpp"
#include "scenes/job/plan/plan_text.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/job.hpp"
#include "scenes/job/store/stage_store.hpp"
#include "scenes/job/warnings/scene_warnings.hpp"
#include "scenes/studies/checked_studies.hpp"
#include "scenes/studies/study_solves.hpp"
#include "thermal/temperature_field.hpp"
#include "thermal/temperature_mesh.hpp"

// A scene file: checked, planned, run; the files of its results read.

namespace diurna::python {

Scene one_scene(const std::filesystem::path& file, const std::vector<std::string>& settings,
                bool allow_outside) {
    Scene scene = read_scene(file, settings, allow_outside);
    if (!scene.sweep.axes.empty())
        throw InputError(file.string() + ": sweep",
                         "found a scene with [sweep], expected a single scene",
                         "Scene.sweep(out) runs all variants");
    return scene;
}

namespace {

using Settings = std::vector<std::string>;

py::dict check(const std::filesystem::path& file, const Settings& settings, bool allow_outside,
               const py::object& progress) {
    const CheckedScene checked = result_of_long_call(progress, [&](const ProgressTo&) {
        const StudyRequest studies{
            .scene = file, .settings = settings, .allow_outside = allow_outside};
        return check_scene(read_scene(file, settings, allow_outside), settings, allow_outside,
                           [&](const Prepared& prepared) { check_studies(prepared, studies); });
    });
    py::dict out;
    out["facets"] = checked.facets;
    out["observers"] = checked.observers;
    out["warnings"] = as_lines(checked.warnings);
    out["notes"] = checked.notes;
    return out;
}

py::dict plan_scene(const std::filesystem::path& file, const Settings& settings, bool allow_outside,
                    const py::object& progress) {
    std::string sweep, studies;
    const Plan plan = result_of_long_call(progress, [&](const ProgressTo&) {
        const Prepared prepared = prepare(read_scene(file, settings, allow_outside));
        if (!prepared.scene.sweep.axes.empty()) {
            sweep = describe(read_sweep_variants(file, settings, allow_outside), prepared.plan);
        }
        studies = describe(study_solves(prepared.scene), prepared.plan);
        return prepared.plan;
    });
    py::dict out, stages;
    for (const PlannedStage& planned : plan.stages) {
        stages[name_of(planned.stage).c_str()] = planned.seconds;
    }
    py::list decisions;
    for (const PlanRow& row : plan_rows(plan)) {
        py::dict one;
        one["what"] = row.what;
        one["computed"] = row.computed;
        one["why"] = row.why;
        one["error"] = row.error;
        one["error_unit"] = row.error_unit;
        decisions.append(one);
    }
    out["facets"] = plan.facets;
    out["views"] = plan.views;
    out["pictures"] = plan.pictures;
    out["memory_bytes"] = plan.memory;
    out["seconds"] = plan.seconds;
    out["stages"] = stages;
    out["decisions"] = decisions;
    out["frames"] = as_datetimes(plan.frames);
    out["text"] = sweep + describe(plan) + studies;
    return out;
}

py::dict run_scene(const std::filesystem::path& file, const Settings& settings, bool allow_outside,
                   const std::filesystem::path& out_folder, bool resume, bool fresh,
                   const Settings& only, int threads, double max_memory,
                   const py::object& progress) {
    const ThreadsOfCall limit(threads);
    JobReport report = result_of_long_call(progress, [&](const ProgressTo& to) {
        return run_job(one_scene(file, settings, allow_outside),
                       {.out = out_folder,
                        .settings = settings,
                        .stages = fresh ? nullptr : StageStore::of_user(),
                        .pictures = {.only = only},
                        .resume = resume,
                        .max_memory = max_memory,
                        .scene_with = reads_scene(file, settings, allow_outside),
                        .progress = to});
    });
    py::dict out, stages;
    for (const Progress::Stage& stage : report.stages) stages[stage.name.c_str()] = stage.seconds;
    out["facets"] = report.plan.facets;
    out["frames_rendered"] = report.frames_rendered;
    out["files"] = report.files;
    out["stages"] = stages;
    out["not_converged"] = report.not_converged;
    out["start"] = report.start;
    report.notes.insert(report.notes.end(), report.remade.begin(), report.remade.end());
    out["notes"] = report.notes;
    out["warnings"] = report.warnings;
    return out;
}

py::dict sweep_scene(const std::filesystem::path& file, const Settings& settings,
                     bool allow_outside, const std::filesystem::path& out_folder, bool resume,
                     int threads, double max_memory, const py::object& progress) {
    const ThreadsOfCall limit(threads);
    const SweepReport report = result_of_long_call(progress, [&](const ProgressTo& to) {
        return run_sweep(
            read_sweep_variants(file, settings, allow_outside),
            {.out = out_folder, .resume = resume, .max_memory = max_memory, .progress = to});
    });
    py::dict out;
    out["rendered"] = report.rendered;
    out["kept"] = report.kept;
    out["solved"] = report.solved;
    out["notes"] = report.notes;
    out["not_converged"] = report.not_converged;
    return out;
}

py::tuple temperatures(const std::filesystem::path& file) {
    TemperatureField field;
    TemperatureMesh mesh;
    {
        const RunningCall running;
        const py::gil_scoped_release free;
        field = load_temperature_field(file);
        mesh = load_temperature_mesh(file);
    }
    const auto numbers_of = [](const auto& ids) {
        std::vector<std::uint32_t> numbers;
        for (const auto id : ids) numbers.push_back(static_cast<std::uint32_t>(id));
        return numbers;
    };
    // A file that names no material or object has number 0 throughout.
    for (auto* names : {&mesh.materials, &mesh.objects}) {
        if (names->empty()) names->emplace_back();
    }
    const auto instants = static_cast<py::ssize_t>(field.instant.size());
    const auto facets = static_cast<py::ssize_t>(field.facets);
    return py::make_tuple(as_datetimes(field.instant),
                          as_array(std::move(field.kelvin), {instants, facets}),
                          as_array(numbers_of(mesh.facets.material)), mesh.materials,
                          as_array(numbers_of(mesh.facets.object)), mesh.objects);
}

py::dict frame_of(const std::filesystem::path& file, const std::optional<Settings>& planes) {
    Frame frame;
    {
        const RunningCall running;
        const py::gil_scoped_release free;
        frame = planes ? read_exr(file, *planes) : read_exr(file);
        for (const std::string& wanted : planes.value_or(Settings{})) {
            if (frame.find(wanted) == nullptr) read_exr(file)[wanted];  // throws, names the nearest
        }
    }
    return as_dict(std::move(frame));
}

}  // namespace

void bind_scene(py::module_& module) {
    using py::arg;
    module.def("check_scene", &check, "Facets, observers, warnings and notes of a scene.",
               arg("file"), arg("settings"), arg("allow_outside"), arg("progress"));
    module.def("plan_scene", &plan_scene, "What a run would compute.", arg("file"), arg("settings"),
               arg("allow_outside"), arg("progress"));
    module.def("run_scene", &run_scene, "Runs a scene; threads below 0: no change.", arg("file"),
               arg("settings"), arg("allow_outside"), arg("out"), arg("resume"), arg("fresh"),
               arg("only"), arg("threads"), arg("max_memory_bytes"), arg("progress"));
    module.def("sweep_scene", &sweep_scene, "Runs all variants of a scene with [sweep].",
               arg("file"), arg("settings"), arg("allow_outside"), arg("out"), arg("resume"),
               arg("threads"), arg("max_memory_bytes"), arg("progress"));
    module.def("temperatures", &temperatures,
               "Instants, [K] as (instant, facet), and numbers and names of materials and objects.",
               arg("file"));
    module.def("frame", &frame_of, "A picture of a run's folder.", arg("file"), arg("planes"));
}

}  // namespace diurna::python
