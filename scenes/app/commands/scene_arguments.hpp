#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/plan/progress.hpp"
#include "scenes/job/store/stage_store.hpp"

namespace CLI {
class App;
}

namespace diurna {

/// Options shared by verbs that work on a scene.
struct SceneArguments {
    std::filesystem::path scene;
    std::vector<std::string> settings;
    std::string progress;
    bool allow_outside = false;
    bool fresh = false;
    std::string max_memory;
    int threads = 0;

    /// Sets the number of threads. Throws InputError.
    Scene read() const;
    ProgressStyle style() const;
    /// [bytes] 0: the machine's memory. Throws InputError.
    double memory() const;
    /// The cache of earlier results; null: everything is recomputed.
    std::shared_ptr<const StageStore> stages() const;
};

/// Adds the settings of the rounds of the run that wrote a file of temperatures
/// (scenes/job/run/rounds.hpp), and prints a note.
void take_rounds(const std::filesystem::path& temperatures, std::vector<std::string>& settings);

/// A note on a scene with a [sweep], for verbs that ignore variants.
void tell_of_sweep(const Scene& scene);

/// The options --only and --band of a verb that makes pictures, read into `only` in the format of
/// PictureChoice::only.
///
/// - more: additional help text of --only
void add_choice(CLI::App& verb, const std::shared_ptr<std::vector<std::string>>& only,
                const std::string& more = "");

/// The option --checks of a verb: a setting of scene.check_points.
void add_checks(CLI::App& verb, const std::shared_ptr<SceneArguments>& arguments);

/// The options --threads, --progress and --allow-outside, read into `arguments`, which must outlive
/// the verb.
void add_common_options(CLI::App& verb, SceneArguments& arguments);
/// The arguments of a verb, read into the returned object.
std::shared_ptr<SceneArguments> scene_arguments(CLI::App& verb);
/// The same for a verb that uses cached results.
std::shared_ptr<SceneArguments> solving_arguments(CLI::App& verb);

}  // namespace diurna
