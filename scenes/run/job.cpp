#include "scenes/run/job.hpp"

#include "scenes/labels/label_frames.hpp"
#include "scenes/plan/frame_files.hpp"
#include "scenes/plan/prepared.hpp"
#include "scenes/report/report.hpp"
#include "scenes/run/frames.hpp"
#include "scenes/run/heat.hpp"
#include "scenes/run/manifest.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// What an earlier run of the same inputs has left, if it is to be kept; else makes room. Until
/// here nothing has been written, from here on only whole files are.
Manifest begin_manifest(const Prepared& prepared, const JobOptions& options, bool& keep) {
    for (const char* folder : {"frames", "images", "labels", "kitti", "kitti/calib"}) {
        fs::create_directories(options.out / folder);
    }
    Manifest manifest{.key = job_key(prepared.scene, options.settings),
                      .settings = options.settings,
                      .frames = prepared.plan.frames,
                      .site = prepared.world.site,
                      .legend = legend_of(prepared),
                      .weather = prepared.weather.note};
    for (const Sequence& sequence : prepared.sequences) {
        CameraCourse& course = manifest.cameras[sequence.at(0).name];
        if (sequence.goes) course.frame = sequence.frame;
        for (const Observer& pose : sequence.pose) {
            course.facts.push_back(camera_facts(prepared.world, pose));
        }
    }
    for (const Instant instant : prepared.plan.frames) {
        manifest.facts.push_back(instant_facts(prepared, instant));
    }
    const Manifest earlier = read_manifest(options.out);
    keep = options.resume && earlier.key == manifest.key;
    if (keep) {
        manifest.not_converged = earlier.not_converged;
        manifest.start = earlier.start;
    } else {
        for (const char* file : {"temperatures.nc", state_file}) fs::remove(options.out / file);
        for (const std::string& file : frame_files(prepared.scene)) {
            fs::remove(options.out / file);
        }
    }
    write_manifest(options.out, prepared.scene, manifest);
    return manifest;
}

/// What the heat balance leaves in the folder.
std::vector<std::string> heat_files(const Scene& scene) {
    std::vector<std::string> files{"temperatures.nc"};
    if (scene.output.state) files.emplace_back(state_file);
    return files;
}

/// Solves, writes temperatures.nc and says in the manifest if the solver has not converged.
TemperatureField solve_and_write(const Stages& stages, const fs::path& out, Progress& progress,
                                 Manifest& manifest, JobReport& report) {
    const Prepared& prepared = stages.scene();
    SpanResult result = solve_scene(stages, progress, prepared.scene.tolerance);
    progress.stage("write temperatures");
    manifest.not_converged = not_converged(result.report);
    manifest.start = result.start;
    if (!manifest.not_converged.empty()) write_manifest(out, prepared.scene, manifest);
    write_heat(prepared, result, out / "temperatures.nc");
    report.solve = result.report;
    report.solved = true;
    for (std::string& note : result.notes) report.notes.push_back(std::move(note));
    return std::move(result.temperature);
}

}  // namespace

JobReport run_job(Scene scene, const JobOptions& options) {
    const fs::path& out = options.out;
    Progress progress(options.progress);
    progress.stage("terrain");
    const Prepared prepared = prepare(std::move(scene));
    check_start(prepared);
    bool keep = false;
    Manifest manifest = begin_manifest(prepared, options, keep);
    progress.stage("sky view");
    const Stages stages(prepared);
    stages.at(0);

    JobReport report{.plan = prepared.plan,
                     .ground_check = prepared.world.ground_check,
                     .posts = prepared.world.posts,
                     .files = heat_files(prepared.scene),
                     .notes = prepared.notes};
    for (const std::string& file : report.files) keep = keep && fs::exists(out / file);
    const TemperatureField field = keep ? load_temperature_field(out / "temperatures.nc")
                                        : solve_and_write(stages, out, progress, manifest, report);
    report.not_converged = manifest.not_converged;
    report.start = manifest.start;

    const FramesReport frames = render_frames(stages, field, out, progress);
    report.frames_rendered = frames.rendered;
    for (const std::string& line : frames.errors) {
        report.notes.push_back("tables against the direct sum, worst frame: " + line);
    }
    for (const std::string& line : frames.notes) {
        report.notes.push_back("water in pictures, frame with most of it: " + line);
    }
    for (const std::string& line : frames.instruments) {
        report.notes.push_back("instrument " + line);
    }
    for (std::string& file : frame_files(prepared.scene)) {
        report.files.push_back(std::move(file));
    }

    progress.stage("labels");
    for (std::string& file : label_frames(prepared, out)) report.files.push_back(std::move(file));
    progress.stage("report");
    report.stages = progress.stages();
    write_report(out, prepared, report, field);
    progress.finish();
    report.files.emplace_back("report.html");
    report.stages = progress.stages();
    manifest.outputs = report.files;
    manifest.stages = report.stages;
    write_manifest(out, prepared.scene, manifest);
    return report;
}

}  // namespace diurna
