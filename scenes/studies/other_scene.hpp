#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scenes/studies/signature_scene.hpp"

namespace diurna {

/// The scene as it is, with settings "key=value".
using SceneWith = std::function<Scene(const std::vector<std::string>&)>;

std::string setting(const std::string& key, double value);

/// Throws InputError where the scene cannot be read with those.
///
/// - where: that asks for it, in the scene file
void check_settings(const SceneWith& scene_with, const std::vector<std::string>& settings,
                    const std::string& where);

/// A scene that differs in numbers from the one that is studied, solved; its temperatures are kept
/// at every step. Not to be moved: its stages know where it is.
struct OtherScene {
    Prepared prepared;
    Stages stages;
    TemperatureField field{};
    std::string not_converged{};  // "" where the heat balance has

    /// Throws InputError where the numbers change how many facets there are.
    OtherScene(Scene scene, Study& study);
    OtherScene(const OtherScene&) = delete;
    OtherScene& operator=(const OtherScene&) = delete;
};

}  // namespace diurna
