#include "scenes/run/job.hpp"

#include <fmt/format.h>

#include <optional>
#include <set>

#include "materials/base/error.hpp"
#include "materials/base/number_of.hpp"
#include "scenes/cache/digest.hpp"
#include "scenes/labels/label_frames.hpp"
#include "scenes/plan/frame_files.hpp"
#include "scenes/plan/memory_limit.hpp"
#include "scenes/plan/prepared.hpp"
#include "scenes/report/report.hpp"
#include "scenes/run/found_heat.hpp"
#include "scenes/run/frames.hpp"
#include "scenes/run/gathered_parts.hpp"
#include "scenes/run/given_heat.hpp"
#include "scenes/run/heat.hpp"
#include "scenes/run/ledger.hpp"
#include "scenes/run/manifest.hpp"
#include "scenes/run/radiometers.hpp"
#include "scenes/run/run_folder.hpp"
#include "scenes/warnings/scene_warnings.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// What the results depend on.
std::vector<RunInput> inputs_of(const Prepared& prepared, const JobOptions& options) {
    std::vector<RunInput> inputs = run_inputs(prepared.scene);
    const fs::path& heat = options.temperatures;
    if (!heat.empty() && !fs::is_regular_file(heat)) {
        throw InputError(heat.string(), "no such file",
                         "diurna solve SCENE --out FILE.nc computes it");
    }
    if (!heat.empty()) inputs.push_back({heat, "temperatures", sha256_of_file(heat)});
    return inputs;
}

/// All that manifest.json says before anything is computed.
Manifest manifest_of(const Prepared& prepared, const JobOptions& options) {
    Manifest manifest{.inputs = inputs_of(prepared, options),
                      .settings = options.settings,
                      .frames = prepared.plan.frames,
                      .site = prepared.world.site,
                      .legend = legend_of(prepared),
                      .weather = prepared.weather.note};
    manifest.key = job_key(manifest.inputs, options.settings);
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
    return manifest;
}

/// What of the pictures is chosen, as the command line says it.
std::vector<std::string> said_of_job(const PictureChoice& choice) {
    std::vector<std::string> texts = choice.only;
    if (!choice.shard.all())
        texts.push_back(fmt::format("shard {}/{}", choice.shard.number, choice.shard.count));
    return texts;
}

/// The scene with those of the chosen pictures that are in the folder, for labels and report.
struct PicturesThere {
    Prepared scene;
    std::size_t there, all;  // frames, those chosen
};
PicturesThere pictures_there(const Prepared& prepared, const std::vector<ObserverInput>& chosen,
                             const Ledger& ledger) {
    std::size_t there = 0, all = 0;
    std::vector<ObserverInput> observers = prepared.scene.observers;
    std::vector<Sequence> sequences = prepared.sequences;
    for (std::size_t o = 0; o < chosen.size(); ++o) {
        ObserverInput& observer = observers[o];
        Sequence& sequence = sequences[o];
        observer.bands = chosen[o].bands;
        observer.cubes = chosen[o].cubes;
        observer.instruments = chosen[o].instruments;
        Sequence kept{.frame = {}, .pose = {}, .goes = sequence.goes};
        for (std::size_t i = 0; i < sequence.frame.size(); ++i) {
            const auto files =
                frame_files(observer, sequence.frame[i], prepared.scene.labels.format);
            if (files.empty() || !ledger.has(files)) continue;
            kept.frame.push_back(sequence.frame[i]);
            if (sequence.goes) kept.pose.push_back(sequence.pose[i]);
        }
        if (!sequence.goes) kept.pose = sequence.pose;
        there += kept.frame.size();
        all += sequence.frame.size();
        observer.frames = kept.frame;
        sequence = std::move(kept);
    }
    return {with_pictures(prepared, std::move(observers), std::move(sequences)), there, all};
}

/// Refuses results that would go where they are taken from.
void refuse_own(const fs::path& out, const fs::path& from, const char* option) {
    std::error_code none;
    if (!fs::equivalent(out, from, none)) return;
    throw InputError(option,
                     fmt::format("{} is the folder of the results (--out), expected another folder",
                                 from.string()),
                     "to continue an earlier run in the same folder use --resume");
}

/// What the heat balance leaves in the folder; nothing where temperatures are given.
std::vector<std::string> heat_files(const Scene& scene, const JobOptions& options) {
    if (!options.temperatures.empty()) return {};
    std::vector<std::string> files{"temperatures.nc"};
    if (scene.output.state) files.emplace_back(state_file);
    for (std::string& file : radiometer_files(scene)) files.push_back(std::move(file));
    return files;
}

/// Makes room for what the ledger has not, and begins it. What is reported of it goes to the
/// report.
void begin_folder(const std::vector<std::string>& expected, const fs::path& out,
                  const Ledger& ledger, Progress& progress, JobReport& report) {
    std::set<std::string> keep{ledger_file, "manifest.json"};
    for (const auto& [name, digest] : ledger.digests()) keep.insert(name);
    clear_run_folder(out, keep, expected, [&](const Cleared& cleared) {
        progress.tell(fmt::format("{}: replaces {} of an earlier run, removes {}", out.string(),
                                  number_of(cleared.again, "file"), cleared.gone));
        if (cleared.gone == 0) return;
        report.remade.push_back(fmt::format("{} of an earlier run removed from {}",
                                            number_of(cleared.gone, "file"), out.string()));
    });
    if (const std::vector<std::string>& changed = ledger.changed(); !changed.empty()) {
        report.remade.push_back(
            fmt::format("{} changed since the earlier run (for example {}); regenerated",
                        number_of(changed.size(), "file"), changed.front()));
    }
    for (const char* folder : {"frames", "images", "labels", "kitti", "kitti/calib"}) {
        fs::create_directories(out / folder);
    }
    ledger.write(expected);
}

/// Writes what the heat balance leaves.
TemperatureField write_found(const Stages& stages, const Manifest& manifest, const fs::path& out,
                             Progress& progress, Ledger& ledger, JobReport& report) {
    const Prepared& prepared = stages.scene();
    SceneHeat heat = scene_heat(stages, manifest.inputs, progress, prepared.plan.decisions.heat);
    progress.stage(StageId::write_temperatures);
    write_heat(prepared, manifest.inputs, heat.result, out / "temperatures.nc");
    for (auto& reported : write_radiometers(stages, heat.result, out)) {
        heat.reported.push_back(std::move(reported));
    }
    report.solve = heat.result.report;
    report.solved = heat.solved;
    ledger.add(report.files, std::move(heat.reported));
    return std::move(heat.result.temperature);
}

/// Temperatures that are given. Throws InputError where they are not of these pictures.
TemperatureField given_field(const Stages& stages, const Manifest& manifest,
                             const std::vector<ObserverInput>& chosen, const fs::path& file,
                             JobReport& report) {
    std::vector<RunInput> inputs = manifest.inputs;
    inputs.pop_back();  // the temperatures themselves
    GivenHeat given = given_heat(stages.scene(), inputs, file);
    std::vector<Instant> frames;
    for (const ObserverInput& observer : chosen)
        frames.insert(frames.end(), observer.frames.begin(), observer.frames.end());
    check_covers(given.field, frames, file);
    check_solved(stages, given.field, file);
    report.warnings.insert(report.warnings.end(), given.warnings.begin(), given.warnings.end());
    report.heat.emplace_back("temperatures", "from file: " + file.filename().string());
    return std::move(given.field);
}

/// What --resume has reused, and why where that is nothing.
std::string resumed(const fs::path& out, const std::string& earlier, const std::string& key,
                    bool temperatures, std::size_t reused, std::size_t all) {
    if (earlier.empty()) {
        return fmt::format("--resume: {} held no earlier run; everything was computed",
                           out.string());
    }
    if (earlier != key) {
        return fmt::format(
            "--resume: scene, settings, inputs or program changed since the earlier run in {}; "
            "everything was computed again",
            out.string());
    }
    return fmt::format("--resume: {}, {} of {} reused from the earlier run in {}",
                       temperatures ? "temperatures reused" : "temperatures computed", reused,
                       number_of(all, "frame"), out.string());
}

/// What was reported of the heat balance when it was solved, in this run or the one it is kept
/// from.
void tell_of_heat(const Messages& reported, JobReport& report) {
    for (const auto& [name, text] : reported) {
        if (name == "not converged") report.not_converged = text;
        if (name == "start") report.start = text;
        if (name == "note") report.notes.push_back(text);
        if (name.starts_with("row ")) report.heat.emplace_back(name.substr(4), text);
    }
}

}  // namespace

JobReport run_job(Scene scene, const JobOptions& options) {
    const fs::path& out = options.out;
    check_run_folder(out, FolderKind::run);
    Progress progress(options.progress);
    progress.stage(StageId::terrain);
    if (!options.temperatures.empty()) scene.output.fluxes = scene.output.state = false;
    const Prepared prepared = prepare(std::move(scene));
    const GreyFormat format = prepared.scene.labels.format;
    const std::vector<std::string> pictures = frame_files(prepared.scene.observers, format);
    const std::vector<ObserverInput> chosen = chosen_pictures(prepared.scene, options.pictures);
    check_memory(prepared.plan, options.max_memory);
    if (options.temperatures.empty()) check_start(prepared);
    Manifest manifest = manifest_of(prepared, options);
    check_no_input_in(out, manifest.inputs);
    JobReport report{.plan = prepared.plan,
                     .ground_check = prepared.world.ground_check,
                     .posts = prepared.world.posts,
                     .files = heat_files(prepared.scene, options),
                     .notes = prepared.notes,
                     .settings = options.settings};
    for (const RunInput& input : manifest.inputs) {
        report.inputs.push_back({input.name, input.sha256});
    }
    report.warnings = as_lines(scene_warnings(prepared));
    std::vector<std::string> expected = report.files;
    for (std::string& file : frame_files(chosen, format)) expected.push_back(std::move(file));
    for (const std::filesystem::path& part : options.parts) refuse_own(out, part, "FOLDERS");
    if (!options.from.empty()) refuse_own(out, options.from, "--from");
    if (!options.parts.empty()) gather_parts(options.parts, out, manifest.key, expected);
    const Stages stages(prepared, options.stages);
    TemperatureField field;
    if (!options.temperatures.empty()) {
        field = given_field(stages, manifest, chosen, options.temperatures, report);
    }
    const std::string earlier = ledger_key(out);
    const bool begun = options.resume && earlier == manifest.key;
    const bool given = !options.from.empty() && !begun;
    if (given) gather_parts({options.from}, out, manifest.key, report.files);
    const FolderLock lock(out);
    Ledger ledger(out, manifest.key, options.resume || given || !options.parts.empty());
    begin_folder(expected, out, ledger, progress, report);
    write_manifest(out, prepared.scene, manifest);
    progress.stage(StageId::sky_view);
    stages.at(0);

    if (options.temperatures.empty()) {
        field = ledger.has(report.files)
                    ? load_temperature_field(out / "temperatures.nc")
                    : write_found(stages, manifest, out, progress, ledger, report);
    }
    tell_of_heat(ledger.reported("temperatures.nc"), report);
    manifest.not_converged = report.not_converged;
    manifest.start = report.start;
    if (std::string reported = taken_reported(stages.store()); !reported.empty()) {
        report.remade.push_back(std::move(reported));
    }

    const FramesReport frames = render_frames(stages, chosen, field, out, progress, ledger);
    report.frames_rendered = frames.rendered;
    if (options.resume) {
        std::size_t all = 0;
        for (const ObserverInput& observer : chosen) all += observer.frames.size();
        report.resumed =
            resumed(out, earlier, manifest.key, !report.solved, all - frames.rendered, all);
    }
    for (const auto& notes : {frames.notes, frames.warnings}) {
        report.notes.insert(report.notes.end(), notes.begin(), notes.end());
    }
    for (const std::string& file : pictures) {
        if (ledger.has({file})) report.files.push_back(file);
    }
    std::optional<PicturesThere> some;
    if (!options.pictures.all()) {
        some.emplace(pictures_there(prepared, chosen, ledger));
        manifest.only = said_of_job(options.pictures);
        report.remade.push_back(fmt::format("{} of {} pictures are in this folder ({})",
                                            some->there, some->all,
                                            fmt::join(manifest.only, ", ")));
    }

    const Prepared& shown = some ? some->scene : prepared;
    progress.stage(StageId::labels);
    for (std::string& file : label_frames(shown, out)) report.files.push_back(std::move(file));
    progress.stage(StageId::report);
    report.stages = progress.stages();
    write_report(out, shown, report, field);
    progress.finish();
    report.files.emplace_back("report.html");
    ledger.write();
    report.files.emplace_back(ledger_file);
    report.stages = progress.stages();
    manifest.outputs = report.files;
    manifest.stages = report.stages;
    write_manifest(out, shown.scene, manifest);
    return report;
}

}  // namespace diurna
