#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "scenes/cache/stage_store.hpp"
#include "scenes/input/scene.hpp"
#include "scenes/plan/progress.hpp"

namespace CLI {
class App;
}

namespace diurna {

/// Options that verbs working on a scene share.
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
    /// [bytes] 0: what the machine has. Throws InputError.
    double memory() const;
    /// Of what earlier runs have found; null: all is to be recomputed.
    std::shared_ptr<const StageStore> stages() const;
};

/// A note of a scene with a [sweep], for verbs that know no variants.
void tell_of_sweep(const Scene& scene);

/// The options --only and --band of a verb that makes pictures, read into `only` as
/// PictureChoice::only has it.
///
/// - more: is said of --only besides
void add_choice(CLI::App& verb, const std::shared_ptr<std::vector<std::string>>& only,
                const std::string& more = "");

/// The arguments of a verb, read into what is returned.
std::shared_ptr<SceneArguments> scene_arguments(CLI::App& verb);
/// Likewise of one that takes what earlier runs have found.
std::shared_ptr<SceneArguments> solving_arguments(CLI::App& verb);

}  // namespace diurna
