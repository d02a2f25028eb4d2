#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/job/plan/progress.hpp"
#include "scenes/job/run/check_error.hpp"

namespace diurna {

/// The scene of a run, from its manifest.
struct AuditedRun {
    std::filesystem::path scene;          // its file
    std::vector<std::string> settings{};  // of its command line
    std::string key{};                    // job_key()
};
/// Throws InputError for a folder without a complete run that computed its temperatures, and for a
/// variant of a sweep.
AuditedRun audited_run(const std::filesystem::path& folder);

struct Audit {
    CheckError error{};
    std::size_t places = 0,
                unchecked = 0;    // solved separately; on panes, nets, sheets, targets, movers
    std::size_t pictures = 0;     // in which they were drawn
    double tolerance = 0.0;       // [K] Scene::tolerance
    std::string not_converged{};  // "" if the heat balance converged
    bool same_inputs = true;      // as the run had, with the same program
};

/// Solves a scene's heat again with `checks` places in its pictures, each with sun, sky and
/// surroundings of its own, and compares (scenes/job/run/check_error.hpp). Throws InputError if
/// a state is written or read, as places cannot be solved separately then.
///
/// - scene: of the run, with its settings
/// - checks: 1 to 4096; places on panes, nets, sheets, targets, copies and moving objects are not
/// used
Audit audit(const AuditedRun& run, Scene scene, int checks, const ProgressTo& progress);

/// For the terminal, a line each.
std::vector<std::string> audit_lines(const Audit& audit);

}  // namespace diurna
