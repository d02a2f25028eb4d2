#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include "materials/base/error.hpp"
#include "python/src/bind.hpp"
#include "render/picture/exr.hpp"
#include "scenes/doubts/doubts.hpp"
#include "scenes/kept/stage_store.hpp"
#include "scenes/plan/prepared.hpp"
#include "scenes/run/heat.hpp"
#include "scenes/run/job.hpp"
#include "scenes/world/targets.hpp"
#include "thermal/temperature_field.hpp"

// A scene file: what is wrong with it, what it needs, what comes of it.

namespace diurna::python {

Scene one_scene(const std::filesystem::path& file, const std::vector<std::string>& settings,
                bool allow_outside) {
    Scene scene = read_scene(file, settings, allow_outside);
    if (!scene.sweep.axes.empty())
        throw InputError(file.string() + ": sweep", "diurna.Scene is of one scene, not of many",
                         "diurna run SCENE goes through them");
    return scene;
}

namespace {

using Settings = std::vector<std::string>;

py::dict check_scene(const std::filesystem::path& file, const Settings& settings,
                     bool allow_outside) {
    std::vector<std::string> warnings, notes;
    std::size_t facets = 0, observers = 0;
    {
        const py::gil_scoped_release free;
        const Prepared prepared = prepare(one_scene(file, settings, allow_outside));
        check_start(prepared);
        const auto networks = targets(prepared.world, prepared.scene);
        warnings = as_lines(doubts(prepared));
        notes = prepared.notes;
        for (const NetworkObject& network : networks)
            notes.insert(notes.end(), network.notes.begin(), network.notes.end());
        facets = prepared.world.surfaces().size();
        observers = prepared.sequences.size();
    }
    py::dict out;
    out["facets"] = facets;
    out["observers"] = observers;
    out["warnings"] = warnings;
    out["notes"] = notes;
    return out;
}

py::dict plan_scene(const std::filesystem::path& file, const Settings& settings,
                    bool allow_outside) {
    Plan plan;
    {
        const py::gil_scoped_release free;
        plan = prepare(one_scene(file, settings, allow_outside)).plan;
    }
    py::dict out, stages;
    for (const PlannedStage& stage : plan.stages) stages[stage.name.c_str()] = stage.seconds;
    py::list decisions;
    for (const Decision& decision : plan.decisions) {
        py::dict one;
        one["what"] = decision.what;
        one["computed"] = decision.computed;
        one["why"] = decision.why;
        one["error"] = decision.error;
        one["error_unit"] = decision.error_unit;
        decisions.append(one);
    }
    out["facets"] = plan.facets;
    out["pictures"] = plan.pictures;
    out["memory_bytes"] = plan.memory;
    out["seconds"] = plan.seconds;
    out["stages"] = stages;
    out["decisions"] = decisions;
    out["frames"] = as_datetimes(plan.frames);
    out["text"] = describe(plan);
    return out;
}

py::dict run_scene(const std::filesystem::path& file, const Settings& settings, bool allow_outside,
                   const std::filesystem::path& out_folder, bool resume, bool fresh,
                   double max_memory) {
    JobReport report;
    {
        const py::gil_scoped_release free;
        const Scene scene = one_scene(file, settings, allow_outside);
        report = run_job(scene, {.out = out_folder,
                                 .settings = settings,
                                 .stages = fresh ? nullptr : StageStore::of_user(),
                                 .resume = resume,
                                 .max_memory = max_memory});
    }
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

py::tuple temperatures(const std::filesystem::path& file) {
    TemperatureField field;
    {
        const py::gil_scoped_release free;
        field = load_temperature_field(file);
    }
    const auto instants = static_cast<py::ssize_t>(field.instant.size());
    const auto facets = static_cast<py::ssize_t>(field.facets);
    return py::make_tuple(as_datetimes(field.instant),
                          as_array(std::move(field.kelvin), {instants, facets}));
}

py::dict frame_of(const std::filesystem::path& file, const std::optional<Settings>& planes) {
    Frame frame;
    {
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
    module.def("check_scene", &check_scene);
    module.def("plan_scene", &plan_scene);
    module.def("run_scene", &run_scene);
    module.def("temperatures", &temperatures);
    module.def("frame", &frame_of);
}

}  // namespace diurna::python
