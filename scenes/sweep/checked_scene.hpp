#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "scenes/input/scene.hpp"

namespace diurna {

/// What is known of a scene before anything is computed.
struct CheckedScene {
    std::size_t facets = 0, observers = 0;  // of the scene as it stands
    double memory = 0.0;                    // [bytes] by its plan
    std::string sweep{};                    // in one line; "" where there is none
    std::vector<Mistake> warnings{};        // what is implausible, of every value of a sweep
    std::vector<std::string> notes{};       // what was modelled for want of data
};

/// Throws InputError with all that is wrong with a scene, of a sweep with each of its values by
/// itself.
///
/// - settings, allow_outside: as it was read with
CheckedScene check_scene(Scene scene, const std::vector<std::string>& settings, bool allow_outside);

}  // namespace diurna
