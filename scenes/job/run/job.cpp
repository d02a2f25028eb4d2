#include "scenes/job/run/job.hpp"

#include <fmt/format.h>

#include <optional>
#include <set>

#include "materials/base/error.hpp"
#include "materials/base/number_of.hpp"
#include "materials/base/unsynced_files.hpp"
#include "scenes/job/plan/frame_files.hpp"
#include "scenes/job/plan/memory_limit.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/found_heat.hpp"
#include "scenes/job/run/frames.hpp"
#include "scenes/job/run/gathered_parts.hpp"
#include "scenes/job/run/given_heat.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/ledger.hpp"
#include "scenes/job/run/manifest.hpp"
#include "scenes/job/run/picture_shares.hpp"
#include "scenes/job/run/pictures_there.hpp"
#include "scenes/job/run/radiometers.hpp"
#include "scenes/job/run/represented.hpp"
#include "scenes/job/run/run_folder.hpp"
#include "scenes/job/warnings/scene_warnings.hpp"
#include "scenes/products/labels/label_frames.hpp"
#include "scenes/products/report/report.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

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

/// The cache of a run. Scenes with uncertain values changed share at least one of their own.
std::shared_ptr<const StageStore> shared_stages(const Scene& scene, const JobOptions& options) {
    if (options.stages || scene.uncertain.empty()) return options.stages;
    return StageStore::in_memory();
}

/// What was reported of the heat balance when it was solved, in this run or the one it is kept
/// from.
void report_heat(HeatReport heat, JobReport& report) {
    report.not_converged = std::move(heat.not_converged);
    report.start = std::move(heat.start);
    report.notes.insert(report.notes.end(), heat.notes.begin(), heat.notes.end());
    report.heat.insert(report.heat.end(), heat.rows.begin(), heat.rows.end());
}

/// Temperatures that are given; solved instead if too many visible facets have a representative's
/// there. Throws InputError where they are not of this scene.
TemperatureField given_field(const Stages& stages, const Manifest& manifest,
                             const std::vector<ObserverInput>& chosen, const fs::path& file,
                             Progress& progress, JobReport& report) {
    std::vector<RunInput> inputs = manifest.inputs;
    inputs.pop_back();  // the temperatures themselves
    GivenHeat given = given_heat(stages.scene(), inputs, file);
    std::vector<Instant> frames;
    for (const ObserverInput& observer : chosen)
        frames.insert(frames.end(), observer.frames.begin(), observer.frames.end());
    check_covers(given.field, frames, file);
    report.warnings.insert(report.warnings.end(), given.warnings.begin(), given.warnings.end());
    if (!given.field.solved_as.empty()) {
        progress.stage(StageId::sky_view);
        const double tolerance = stages.scene().scene.tolerance;
        const RepresentedEffect effect =
            represented_effect(stages, given.field, picture_shares(stages));
        report.notes.push_back(in_words(effect, file, tolerance, "facets that the pictures need"));
        if (!effect.within(tolerance)) {
            SceneHeat heat =
                scene_heat(stages, inputs, progress, stages.scene().plan.decisions.heat);
            report.solve = heat.result.report;
            report.solved = heat.solved;
            report_heat(std::move(heat.report), report);
            return std::move(heat.result.temperature);
        }
    }
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
                       number_of(all, "view"), out.string());
}

/// The report before anything is computed.
JobReport begun_report(const Prepared& prepared, const Manifest& manifest,
                       const JobOptions& options) {
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
    return report;
}

/// A run from its scene to its last file.
class Job {
 public:
    Job(Scene scene, const JobOptions& options, Progress& progress)
        : options_(options),
          out_(options.out),
          progress_(progress),
          prepared_(prepare(std::move(scene))),
          chosen_(chosen_pictures(prepared_.scene, options.pictures)),
          stages_(prepared_, shared_stages(prepared_.scene, options)) {}

    /// Everything that may be refused is checked before the folder is touched.
    JobReport run() {
        check();
        if (makes_sigma()) {
            changed_ = uncertain_scenes(prepared_, options_.scene_with, stages_.shared_store());
        }
        manifest_ = manifest_of(prepared_, options_.temperatures, options_.settings);
        check_no_input_in(out_, manifest_.inputs);
        report_ = begun_report(prepared_, manifest_, options_);
        take_parts();
        TemperatureField given;
        if (!options_.temperatures.empty()) {
            given =
                given_field(stages_, manifest_, chosen_, options_.temperatures, progress_, report_);
        }
        const bool earlier = take_earlier();
        const FolderLock lock(out_);
        UnsyncedFiles unsynced(out_);  // the ledger's digests tell whole files from others
        Ledger ledger(out_, manifest_.key, earlier);
        begin_folder(expected_files(), out_, ledger, progress_, report_);
        write_manifest(out_, prepared_.scene, manifest_);
        const TemperatureField field = temperatures(std::move(given), ledger);
        render(field, ledger);
        finish(field, ledger, unsynced);
        return std::move(report_);
    }

 private:
    void check() const {
        check_memory(prepared_.plan, options_.max_memory);
        if (options_.temperatures.empty()) check_start(prepared_);
        for (const fs::path& part : options_.parts) refuse_own(out_, part, "FOLDERS");
        if (!options_.from.empty()) refuse_own(out_, options_.from, "--from");
    }
    bool makes_sigma() const {
        return !prepared_.scene.uncertain.empty() && options_.temperatures.empty() &&
               options_.scene_with;
    }
    GreyFormat format() const { return prepared_.scene.labels.format; }
    /// Of heat and the chosen pictures.
    std::vector<std::string> expected_files() const {
        std::vector<std::string> expected = heat_files(prepared_.scene, options_);
        for (std::string& file : frame_files(chosen_, format())) {
            expected.push_back(std::move(file));
        }
        return expected;
    }
    void take_parts() const {
        if (options_.parts.empty()) return;
        gather_parts(options_.parts, out_, manifest_.key, expected_files());
    }
    /// Takes heat from another run; whether the folder holds anything that is used again.
    bool take_earlier() {
        earlier_key_ = ledger_key(out_);
        const bool begun = options_.resume && earlier_key_ == manifest_.key;
        const bool given = !options_.from.empty() && !begun;
        if (given) gather_parts({options_.from}, out_, manifest_.key, report_.files);
        return options_.resume || given || !options_.parts.empty();
    }

    /// Solves the heat balance and writes what it leaves.
    TemperatureField write_found(Ledger& ledger) {
        SceneHeat heat =
            scene_heat(stages_, manifest_.inputs, progress_, prepared_.plan.decisions.heat);
        progress_.stage(StageId::write_temperatures);
        write_heat(prepared_, manifest_.inputs, heat.result, out_ / "temperatures.nc");
        write_radiometers(stages_, heat.result, out_, heat.report);
        report_.solve = heat.result.report;
        report_.solved = heat.solved;
        ledger.add(report_.files, as_messages(heat.report));
        return std::move(heat.result.temperature);
    }

    TemperatureField temperatures(TemperatureField given, Ledger& ledger) {
        progress_.stage(StageId::sky_view);
        stages_.at(0);
        TemperatureField field = !options_.temperatures.empty() ? std::move(given)
                                 : ledger.has(report_.files)
                                     ? load_temperature_field(out_ / "temperatures.nc")
                                     : write_found(ledger);
        if (options_.temperatures.empty()) {
            report_heat(heat_report_of(ledger.reported("temperatures.nc")), report_);
        }
        manifest_.not_converged = report_.not_converged;
        manifest_.start = report_.start;
        if (std::string taken = taken_reported(stages_.store()); !taken.empty()) {
            report_.remade.push_back(std::move(taken));
        }
        return field;
    }

    /// Heat of the scenes with uncertain values changed, if any picture is still to be rendered.
    std::vector<std::string> change_heat(const TemperatureField& field, const Ledger& ledger) {
        if (!makes_sigma() && !prepared_.scene.uncertain.empty()) {
            report_.notes.emplace_back(
                "uncertain values: planes sigma.BAND are made neither for variants of a sweep nor "
                "from given temperatures");
        }
        if (changed_.empty() || ledger.has(frame_files(chosen_, format()))) return {};
        return solve_uncertain(prepared_, field, options_.scene_with, changed_, progress_);
    }

    void render(const TemperatureField& field, Ledger& ledger) {
        const std::vector<std::string> changes = change_heat(field, ledger);
        const FramesReport frames = render_frames(
            stages_, chosen_, ShownHeat(field, changed_, changes), out_, progress_, ledger);
        report_.frames_rendered = frames.rendered;
        if (options_.resume) {
            std::size_t all = 0;
            for (const ObserverInput& observer : chosen_) all += observer.frames.size();
            report_.resumed = resumed(out_, earlier_key_, manifest_.key, !report_.solved,
                                      all - frames.rendered, all);
        }
        for (const auto& notes : {frames.notes, frames.warnings}) {
            report_.notes.insert(report_.notes.end(), notes.begin(), notes.end());
        }
        for (const std::string& file : frame_files(prepared_.scene.observers, format())) {
            if (ledger.has({file})) report_.files.push_back(file);
        }
    }

    /// Labels and report of the pictures that are in the folder, and the manifest of all.
    void finish(const TemperatureField& field, Ledger& ledger, UnsyncedFiles& unsynced) {
        std::optional<PicturesThere> some;
        if (!options_.pictures.all()) {
            some.emplace(pictures_there(prepared_, chosen_, ledger));
            manifest_.only = in_words(options_.pictures);
            report_.remade.push_back(fmt::format("{} of {} views are in this folder ({})",
                                                 some->there, some->all,
                                                 fmt::join(manifest_.only, ", ")));
        }
        const Prepared& shown = some ? some->scene : prepared_;
        progress_.stage(StageId::labels);
        for (std::string& file : label_frames(shown, out_)) {
            report_.files.push_back(std::move(file));
        }
        progress_.stage(StageId::report);
        report_.stages = progress_.stages();
        write_report(out_, shown, report_, field);
        progress_.finish();
        report_.files.emplace_back("report.html");
        ledger.write();
        report_.files.emplace_back(ledger_file);
        unsynced.sync();
        report_.stages = progress_.stages();
        manifest_.outputs = report_.files;
        manifest_.digests = ledger.digests();
        manifest_.stages = report_.stages;
        write_manifest(out_, shown.scene, manifest_);
    }

    const JobOptions& options_;
    const fs::path& out_;
    Progress& progress_;
    const Prepared prepared_;
    const std::vector<ObserverInput> chosen_;
    const Stages stages_;
    Manifest manifest_{};
    JobReport report_{};
    ChangedScenes changed_{};    // for the planes sigma.BAND
    SpanCourse course_{};        // of the heat balance, if they need it
    std::string earlier_key_{};  // of the run that the folder held; "": none
};

}  // namespace

JobReport run_job(Scene scene, const JobOptions& options) {
    check_run_folder(options.out, FolderKind::run);
    Progress progress(options.progress);
    progress.stage(StageId::terrain);
    if (!options.temperatures.empty()) scene.output.fluxes = scene.output.state = false;
    return Job(std::move(scene), options, progress).run();
}

}  // namespace diurna
