#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

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
    int threads = 0;

    /// Sets the number of threads. Throws InputError.
    Scene read() const;
    ProgressStyle style() const;
};

/// The arguments of a verb, read into what is returned.
std::shared_ptr<SceneArguments> scene_arguments(CLI::App& verb);

}  // namespace diurna
