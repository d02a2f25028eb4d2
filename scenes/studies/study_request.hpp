#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "scenes/input/scene.hpp"
#include "scenes/plan/progress.hpp"
#include "scenes/studies/other_scene.hpp"
#include "scenes/studies/study_files.hpp"

/// What the verbs and Python ask of studies, and what they get.
namespace diurna {

struct StudyRequest {
    std::filesystem::path scene;          // a scene file
    std::vector<std::string> settings{};  // "key.path=value" in place of what it says
    bool allow_outside = false;
    std::filesystem::path temperatures{};  // netCDF file of `solve`; empty: they are solved
    std::filesystem::path out{};           // folder for the files; empty: none is written
    ProgressTo progress{};

    /// Throws InputError.
    Scene read() const { return read_with({}); }
    Scene read_with(const std::vector<std::string>& more) const;
    /// Of this request, which is to outlive it.
    SceneWith scene_with() const;
};

/// What one table of the scene has come to.
struct StudyFinding {
    std::string name;
    StudyTexts texts{};                // as the files have them
    std::string reported{};            // lines for a reader
    std::vector<std::string> notes{};  // of this one alone
};

struct StudyFindings {
    std::vector<std::string> notes{};  // of the scene and its temperatures
    std::vector<StudyFinding> finding{};
    std::string not_converged{};  // "" where all heat balances have
};

/// The files of all findings, where any are asked for.
void write_findings(const StudyRequest& request, const StudyFindings& findings);

/// Throws InputError where there is no table of the kind, or the files of those there are cannot be
/// written (check_study_files): before anything is computed.
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

/// What they are about, of those that are of single objects.
template <class Input>
std::vector<StudiedObject> studied_of(const std::vector<Input>& tables) {
    std::vector<StudiedObject> studied;
    for (const Input& table : tables) studied.push_back(table.studied);
    return studied;
}

/// The notes of the whole and those of one.
std::vector<std::string> joined(std::vector<std::string> notes,
                                const std::vector<std::string>& more);

}  // namespace diurna
