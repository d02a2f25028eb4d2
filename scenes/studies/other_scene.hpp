#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scenes/studies/signature_scene.hpp"

namespace diurna {

/// Reads the scene with additional settings "key=value".
using SceneWith = std::function<Scene(const std::vector<std::string>&)>;

std::string setting(const std::string& key, double value);

/// Throws InputError if the scene cannot be read with those.
///
/// - where: position of the request in the scene file
void check_settings(const SceneWith& scene_with, const std::vector<std::string>& settings,
                    const std::string& where);

/// A variant of the studied scene with other numbers, solved; its temperatures are stored at every
/// step. Must not be moved in memory: its stages refer to it.
struct OtherScene {
    Prepared prepared;
    Stages stages;
    TemperatureField field{};
    std::string not_converged{};  // "" if the heat balance converged

    /// Throws InputError if the numbers change the number of facets.
    OtherScene(Scene scene, Study& study);
    OtherScene(const OtherScene&) = delete;
    OtherScene& operator=(const OtherScene&) = delete;
};

}  // namespace diurna
