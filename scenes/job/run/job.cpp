#include "scenes/job/run/job.hpp"

#include <fmt/format.h>

#include <memory>
#include <optional>

#include "materials/base/error.hpp"
#include "materials/base/unsynced_files.hpp"
#include "scenes/job/plan/frame_files.hpp"
#include "scenes/job/plan/memory_limit.hpp"
#include "scenes/job/plan/prepared.hpp"
#include "scenes/job/run/found_heat.hpp"
#include "scenes/job/run/frames.hpp"
#include "scenes/job/run/gathered_parts.hpp"
#include "scenes/job/run/given_field.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/job_files.hpp"
#include "scenes/job/run/ledger.hpp"
#include "scenes/job/run/manifest.hpp"
#include "scenes/job/run/pictures_there.hpp"
#include "scenes/job/run/radiometers.hpp"
#include "scenes/job/run/rounds.hpp"
#include "scenes/job/run/run_folder.hpp"
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

/// The cache of a run. Scenes with uncertain values changed share at least one of their own.
std::shared_ptr<const StageStore> shared_stages(const Scene& scene, const JobOptions& options) {
    if (options.stages || scene.uncertain.empty()) return options.stages;
    return StageStore::in_memory();
}

/// The options with finer settings.
JobOptions with_finer(JobOptions options, const std::vector<std::string>& finer) {
    options.settings = with_settings(std::move(options.settings), finer);
    options.scene_with = [before = options.scene_with,
                          finer](const std::vector<std::string>& more) {
        return before(with_settings(finer, more));
    };
    return options;
}

/// A run from its scene to its last file.
class Job {
 public:
    /// - options: with the settings of the rounds before
    Job(Prepared prepared, JobOptions options, std::vector<Round> rounds, Progress& progress)
        : options_(std::move(options)),
          out_(options_.out),
          progress_(progress),
          prepared_(std::move(prepared)),
          rounds_(std::move(rounds)),
          chosen_(chosen_pictures(prepared_.scene, options_.pictures)),
          stages_(prepared_, options_.stages) {}

    /// Everything that may be refused is checked before the folder is touched. Nothing, if
    /// another_round() is to be run instead.
    std::optional<JobReport> run() {
        check();
        if (makes_sigma()) {
            changed_ = uncertain_scenes(prepared_, options_.scene_with, stages_.shared_store());
        }
        manifest_ = manifest_of(prepared_, options_.temperatures, options_.settings);
        manifest_.rounds = rounds_;
        check_no_input_in(out_, paths_of(manifest_.inputs));
        report_ = begun_report(prepared_, manifest_, own_files());
        for (std::size_t k = 0; k < rounds_.size(); ++k) {
            report_.notes.push_back(fmt::format("round {}: {}", k + 1, rounds_[k].missed));
        }
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
        const std::optional<TemperatureField> field = temperatures(std::move(given), ledger);
        if (!field) return std::nullopt;
        render(*field, ledger);
        finish(*field, ledger, unsynced);
        return std::move(report_);
    }

    /// The same job with finer settings.
    std::unique_ptr<Job> another_round() {
        auto job = std::make_unique<Job>(
            std::move(*finer_), with_finer(options_, rounds_.back().settings), rounds_, progress_);
        job->continues_ = earlier_key_ == manifest_.key;
        return job;
    }

 private:
    void check() const {
        check_memory(prepared_.plan, options_.max_memory);
        if (options_.temperatures.empty()) check_start(prepared_);
    }
    bool makes_sigma() const {
        return !prepared_.scene.uncertain.empty() && options_.temperatures.empty() &&
               options_.scene_with;
    }
    std::vector<std::string> own_files() const {
        return heat_files(prepared_.scene, !options_.temperatures.empty());
    }
    GreyFormat format() const { return prepared_.scene.labels.format; }
    /// Of heat and the chosen pictures.
    std::vector<std::string> expected_files() const {
        return run_files(prepared_.scene, chosen_, !options_.temperatures.empty());
    }
    void take_parts() const {
        if (options_.parts.empty()) return;
        gather_parts(options_.parts, out_, manifest_.key, expected_files());
    }
    /// Takes heat from another run; whether the folder holds anything that is used again.
    bool take_earlier() {
        earlier_key_ = continues_ ? manifest_.key : ledger_key(out_);
        const bool begun = options_.resume && earlier_key_ == manifest_.key;
        const bool given = !options_.from.empty() && !begun;
        if (given) gather_parts({options_.from}, out_, manifest_.key, report_.files);
        return options_.resume || given || !options_.parts.empty();
    }

    /// Prepares another round if the surface check asks for one and it fits into memory.
    bool begin_another(HeatReport& heat) {
        const Round& next = heat.next;
        if (next.settings.empty() || !options_.scene_with ||
            rounds_.size() >= std::size_t(prepared_.scene.rounds)) {
            return false;
        }
        progress_.tell(fmt::format("round {}: {}", rounds_.size() + 1, next.missed));
        progress_.stage(StageId::terrain);
        finer_.emplace(prepare(options_.scene_with(next.settings)));
        const bool edges_alone =
            next.settings.size() == 1 && next.settings.front().starts_with("scene.finer_edges=");
        if (edges_alone && finer_->world.surfaces().size() == prepared_.world.surfaces().size()) {
            heat.notes.emplace_back(
                "no further round: the ground's facets are as fine as its posts already");
            finer_.reset();
            return false;
        }
        try {
            check_memory(finer_->plan, options_.max_memory);
        } catch (const InputError& error) {
            heat.notes.push_back("no further round: " + error.mistakes().front().problem);
            finer_.reset();
            return false;
        }
        rounds_.push_back(next);
        return true;
    }

    /// Solves the heat balance and writes what it leaves; nothing if another round follows.
    std::optional<TemperatureField> write_found(Ledger& ledger) {
        SceneHeat heat =
            scene_heat(stages_, manifest_.inputs, progress_, prepared_.plan.decisions.heat);
        if (begin_another(heat.report)) return std::nullopt;
        progress_.stage(StageId::write_temperatures);
        write_heat(prepared_, manifest_.inputs, heat.result, out_ / "temperatures.nc");
        write_radiometers(stages_, heat.result, out_, heat.report);
        report_.solve = heat.result.report;
        report_.solved = heat.solved;
        ledger.add(report_.files, as_messages(heat.report));
        return std::move(heat.result.temperature);
    }

    std::optional<TemperatureField> temperatures(TemperatureField given, Ledger& ledger) {
        progress_.stage(StageId::sky_view);
        stages_.at(0);
        std::optional<TemperatureField> field =
            !options_.temperatures.empty() ? std::move(given)
            : ledger.has(report_.files)    ? load_temperature_field(out_ / "temperatures.nc")
                                           : write_found(ledger);
        if (!field) return field;
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

    const JobOptions options_;
    const fs::path& out_;
    Progress& progress_;
    const Prepared prepared_;
    std::vector<Round> rounds_;        // before this one; when it is over, with the next
    std::optional<Prepared> finer_{};  // the next
    const std::vector<ObserverInput> chosen_;
    const Stages stages_;
    Manifest manifest_{};
    JobReport report_{};
    ChangedScenes changed_{};    // for the planes sigma.BAND
    SpanCourse course_{};        // of the heat balance, if they need it
    bool continues_ = false;     // what it began with before its rounds is in the folder
    std::string earlier_key_{};  // of the run that the folder held; "": none
};

/// Folders of runs that this one continues.
std::vector<fs::path> earlier_folders(const JobOptions& options) {
    std::vector<fs::path> folders = options.parts;
    if (!options.from.empty()) folders.push_back(options.from);
    if (options.resume) folders.push_back(options.out);
    return folders;
}

}  // namespace

void check_job_folder(const Scene& scene, const JobOptions& options) {
    check_run_folder(options.out, FolderKind::run);
    check_not_in_use(options.out);
    for (const fs::path& part : options.parts) refuse_own(options.out, part, "FOLDERS");
    if (!options.from.empty()) refuse_own(options.out, options.from, "--from");
    check_no_input_in(options.out, paths_of(named_inputs(scene)));
    check_clearable(options.out, run_files(scene, chosen_pictures(scene, options.pictures),
                                           !options.temperatures.empty()));
}

JobReport run_job(Scene scene, const JobOptions& options) {
    check_job_folder(scene, options);
    Progress progress(options.progress);
    progress.stage(StageId::terrain);
    const auto prepare_it = [&](Scene of) {
        if (!options.temperatures.empty()) of.output.fluxes = of.output.state = false;
        return prepare(std::move(of));
    };
    JobOptions now = options;
    now.stages = shared_stages(scene, options);
    std::optional<Prepared> prepared(prepare_it(std::move(scene)));
    std::vector<Round> rounds;
    if (options.scene_with) {
        rounds = earlier_rounds(earlier_folders(options), options.settings, prepared->scene);
    }
    if (!rounds.empty()) {
        now = with_finer(std::move(now), after_rounds({}, rounds));
        prepared.emplace(prepare_it(now.scene_with({})));
    }
    auto job =
        std::make_unique<Job>(std::move(*prepared), std::move(now), std::move(rounds), progress);
    for (;;) {
        if (auto report = job->run()) return std::move(*report);
        job = job->another_round();
    }
}

}  // namespace diurna
