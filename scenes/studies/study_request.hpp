#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "scenes/job/input/scene.hpp"
#include "scenes/job/plan/progress.hpp"
#include "scenes/studies/other_scene.hpp"
#include "scenes/studies/study_files.hpp"

/// Requests of studies by the verbs and Python, and their results.
namespace diurna {

struct StudyRequest {
    std::filesystem::path scene;          // a scene file
    std::vector<std::string> settings{};  // "key.path=value", replaces values of the file
    bool allow_outside = false;
    std::filesystem::path temperatures{};  // netCDF file of `solve`; empty: solved here
    std::filesystem::path out{};           // folder for the files; empty: no files
    ProgressTo progress{};

    /// Throws InputError.
    Scene read() const { return scene_with()({}); }
    SceneWith scene_with() const;
};

/// Result of one table of the scene.
struct StudyFinding {
    std::string name;
    StudyTexts texts{};                // content of the files
    std::string reported{};            // lines to be printed
    std::vector<std::string> notes{};  // on this one only
};

struct StudyFindings {
    std::vector<std::string> notes{};  // on the scene and its temperatures
    std::vector<StudyFinding> finding{};
    std::string not_converged{};  // "" if all heat balances converged
};

/// Gives the JSON of each finding `made_from`, and writes the files, if requested: the scene's
/// name, the settings, and a digest of all that its heat depends on, by which a report shows
/// whether the study is of its own scene (scenes/products/report/study_plots.hpp).
void finish_findings(const StudyRequest& request, StudyFindings& findings);

/// Throws InputError if there is no table of the kind, or its files cannot be written
/// (check_study_files). Called as soon as the scene is read, and again with the files that were
/// opened to prepare it.
///
/// - kind: "crossover"; names: of its tables; more: what follows a name in further files of it
void check_asked(const StudyRequest& request, const Scene& scene, const char* kind,
                 const std::vector<std::string>& names, const char* more = nullptr);

/// Names of a scene's tables of one kind.
template <class Input>
std::vector<std::string> names_of(const std::vector<Input>& tables) {
    std::vector<std::string> names;
    for (const Input& table : tables) names.push_back(table.name);
    return names;
}

/// Their targets, for studies of single objects.
template <class Input>
std::vector<StudiedObject> studied_of(const std::vector<Input>& tables) {
    std::vector<StudiedObject> studied;
    for (const Input& table : tables) studied.push_back(table.studied);
    return studied;
}

/// The common notes and those of one finding.
std::vector<std::string> joined(std::vector<std::string> notes,
                                const std::vector<std::string>& more);

}  // namespace diurna
