#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "materials/base/error.hpp"
#include "scenes/job/input/scene.hpp"
#include "scenes/job/plan/prepared.hpp"

namespace diurna {

/// Result of checking a scene before anything is computed.
struct CheckedScene {
    std::size_t facets = 0, observers = 0;  // of the unchanged scene
    double memory = 0.0;                    // [bytes] by its plan
    std::string sweep{};                    // in one line; "" without a sweep
    std::vector<Mistake> warnings{};        // implausible input, for every value of a sweep
    std::vector<std::string> notes{};       // quantities modelled for lack of data
};

/// Throws InputError with all mistakes of a scene, and for a sweep of each of its values
/// separately.
///
/// - settings, allow_outside: as when it was read
/// - more: further checks of the unchanged scene, that throw InputError
CheckedScene check_scene(Scene scene, const std::vector<std::string>& settings, bool allow_outside,
                         const std::function<void(const Prepared&)>& more = {});

}  // namespace diurna
