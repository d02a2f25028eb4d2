#include "scenes/job/run/job_files.hpp"

#include <fmt/format.h>

#include <set>
#include <utility>

#include "materials/base/number_of.hpp"
#include "scenes/job/plan/frame_files.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/radiometers.hpp"
#include "scenes/job/run/run_folder.hpp"
#include "scenes/job/run/state_owner.hpp"
#include "scenes/job/warnings/scene_warnings.hpp"

namespace diurna {

namespace fs = std::filesystem;

std::vector<std::string> heat_files(const Scene& scene, bool given) {
    if (given) return {};
    std::vector<std::string> files{"temperatures.nc"};
    if (scene.output.state) files.emplace_back(state_file);
    for (std::string& file : radiometer_files(scene)) files.push_back(std::move(file));
    return files;
}

std::vector<std::string> run_files(const Scene& scene, const std::vector<ObserverInput>& chosen,
                                   bool given) {
    std::vector<std::string> files = heat_files(scene, given);
    for (std::string& file : frame_files(chosen, scene.labels.format)) {
        files.push_back(std::move(file));
    }
    return files;
}

JobReport begun_report(const Prepared& prepared, const Manifest& manifest,
                       std::vector<std::string> files) {
    JobReport report{.plan = prepared.plan,
                     .ground_check = prepared.world.ground_check,
                     .posts = prepared.world.posts,
                     .files = std::move(files),
                     .notes = prepared.notes,
                     .settings = manifest.settings};
    for (const RunInput& input : manifest.inputs) {
        report.inputs.push_back({input.name, input.sha256});
    }
    report.warnings = as_lines(scene_warnings(prepared));
    return report;
}

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

}  // namespace diurna
