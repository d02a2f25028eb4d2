#include "scenes/run/job.hpp"

#include "scenes/plan/frame_files.hpp"
#include "scenes/plan/prepared.hpp"
#include "scenes/report/annotations.hpp"
#include "scenes/report/report.hpp"
#include "scenes/run/frames.hpp"
#include "scenes/run/heat.hpp"
#include "scenes/run/manifest.hpp"

namespace diurna {

namespace fs = std::filesystem;

JobReport run_job(Scene scene, const JobOptions& options) {
    Progress progress(options.progress);
    progress.stage("terrain");
    const Prepared prepared = prepare(std::move(scene));
    const Scene& checked = prepared.scene;

    // Nothing has been written so far; from here on only whole files are.
    fs::create_directories(options.out / "frames");
    const std::string key = job_key(checked, options.settings);
    const bool keep = options.resume && manifest_key(options.out) == key;
    if (!keep) {
        fs::remove(options.out / "temperatures.nc");
        for (const std::string& file : frame_files(checked.observers, prepared.plan.frames))
            fs::remove(options.out / file);
    }
    write_manifest(options.out, checked, options.settings, key);

    progress.stage("sky view");
    const FacetViews view = scene_sky_view(prepared);

    JobReport report;
    report.plan = prepared.plan;
    report.ground_check = prepared.world.ground_check;
    report.posts = prepared.world.posts;
    const fs::path temperatures = options.out / "temperatures.nc";
    TemperatureField field;
    if (keep && fs::exists(temperatures)) {
        field = load_temperature_field(temperatures);
    } else {
        SolveResult result = solve_scene(prepared, view, progress);
        progress.stage("write temperatures");
        save_temperature_field(temperatures, result.temperature, prepared.world.surfaces(),
                               prepared.world.site);
        field = std::move(result.temperature);
        report.solve = result.report;
        report.solved = true;
    }
    report.notes = prepared.notes;
    if (!prepared.weather.note.empty()) report.notes.push_back(prepared.weather.note);

    report.files = {"temperatures.nc"};
    const FramesReport frames = render_frames(prepared, view, field, options.out, progress);
    report.frames_rendered = frames.rendered;
    for (const std::string& line : frames.errors) {
        report.notes.push_back("tables against the direct sum, worst frame: " + line);
    }
    for (std::string& file : frame_files(checked.observers, prepared.plan.frames))
        report.files.push_back(std::move(file));

    progress.stage("report");
    annotate_frames(prepared, options.out);
    report.files.push_back("annotations.json");
    const std::vector<DiurnalCurve> curves =
        diurnal_curves(field, prepared.world.surfaces(), checked.materials);
    report.stages = progress.stages();
    write_report(options.out, prepared, report, field.instant, curves);
    report.files.push_back("report.html");
    progress.finish();
    report.stages = progress.stages();
    write_manifest(options.out, checked, options.settings, key, report.files, report.stages);
    return report;
}

}  // namespace diurna
