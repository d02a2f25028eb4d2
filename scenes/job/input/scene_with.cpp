#include "scenes/job/input/scene_with.hpp"

#include <fmt/format.h>

#include "materials/base/error.hpp"
#include "scenes/job/input/scene_file.hpp"

namespace diurna {

SceneWith reads_scene(std::filesystem::path file, std::vector<std::string> settings,
                      bool allow_outside) {
    return [=](const std::vector<std::string>& more) {
        std::vector<std::string> all = settings;
        all.insert(all.end(), more.begin(), more.end());
        return read_scene(file, all, allow_outside);
    };
}

std::string setting(const std::string& key, double value) {
    return fmt::format("{}={}", key, value);
}

namespace {

/// The first mistake of a scene with settings, at the place of who requested them.
Mistake moved_to(const std::string& where, const std::vector<std::string>& settings,
                 const InputError& error) {
    const Mistake& found = error.mistakes().front();
    const bool set = found.where.starts_with("--set ");
    return {where,
            fmt::format("with {}: {}{}", fmt::join(settings, ", "), set ? "" : found.where + ": ",
                        found.problem),
            found.hint};
}

}  // namespace

std::optional<Mistake> mistake_with(const SceneWith& scene_with,
                                    const std::vector<std::string>& settings,
                                    const std::string& where) {
    try {
        scene_with(settings);
    } catch (const InputError& error) {
        return moved_to(where, settings, error);
    }
    return std::nullopt;
}

Scene scene_with_settings(const SceneWith& scene_with, const std::vector<std::string>& settings,
                          const std::string& where) {
    try {
        return scene_with(settings);
    } catch (const InputError& error) {
        throw InputError({moved_to(where, settings, error)});
    }
}

}  // namespace diurna
