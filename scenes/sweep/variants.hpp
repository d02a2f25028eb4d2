#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "scenes/input/scene.hpp"

namespace diurna {

/// One combination of the values of a sweep's axes.
struct Variant {
    std::string name;                 // of its folder: "v07", by its number in the grid
    std::vector<std::size_t> choice;  // (axis) of its values
    std::string heat;                 // whose temperatures it has: "h2"
};

/// The variants of a scene, those of the same heat side by side.
struct Sweep {
    std::filesystem::path file;
    std::vector<std::string> settings;  // "key=value" of the command line, for all variants
    Scene base;                         // as the file says, and with the settings
    bool ground_by_observers = false;   // is finer where they look: they touch heat
    std::vector<Variant> variants;

    std::size_t solves() const;
};

/// Of a scene with axes. Every value of every axis is tried by itself in the scene; throws
/// InputError with all mistakes, reported where the values stand.
Sweep read_sweep_variants(const std::filesystem::path& file,
                          const std::vector<std::string>& settings, bool allow_outside = false);

/// Hands over the scene with every value of every axis by itself. Throws InputError with all
/// mistakes of reading and of `use`, reported where the values stand, each once.
void for_each_value(const Sweep& sweep, const std::function<void(Scene)>& use);

/// Whether two variants that differ there have temperatures of their own. Else the axis is of
/// pictures alone: of observers, but for when they look, and of labels.
bool touches_heat(const Sweep& sweep, const SweepAxis& axis);

/// The scene that a variant is.
Scene scene_of(const Sweep& sweep, const Variant& variant);

/// The scene with those of its values that touch heat: the same for all variants of one heat.
Scene heat_scene_of(const Sweep& sweep, const Variant& variant);
/// The command line's settings and those values, as "key=value".
std::vector<std::string> heat_settings(const Sweep& sweep, const Variant& variant);

}  // namespace diurna
