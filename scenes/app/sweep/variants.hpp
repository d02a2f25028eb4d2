#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "scenes/job/input/scene.hpp"

namespace diurna {

/// One combination of the values of a sweep's axes.
struct Variant {
    std::string name;                 // of its folder: "v07", by its number in the grid
    std::vector<std::size_t> choice;  // (axis) of its values
    std::string heat;                 // its common temperatures: "h2"
};

/// The variants of a scene, those with the same heat adjacent.
struct Sweep {
    std::filesystem::path file;
    std::vector<std::string> settings;  // "key=value" of the command line, for all variants
    Scene base;                         // as in the file, with the settings
    bool ground_by_observers = false;   // its mesh depends on observers: they affect heat
    std::vector<Variant> variants;

    std::size_t solves() const;
};

/// For a scene with axes. Every value of every axis is tried separately in the scene; throws
/// InputError with all mistakes, at the position of the values.
Sweep read_sweep_variants(const std::filesystem::path& file,
                          const std::vector<std::string>& settings, bool allow_outside = false);

/// Calls `use` with the scene for every value of every axis separately. Throws InputError with all
/// mistakes of reading and of `use`, at the position of the values, each once.
void for_each_value(const Sweep& sweep, const std::function<void(Scene)>& use);

/// Whether a key may change temperatures. Else it affects only pictures: observers (except their
/// times), instruments and labels.
bool touches_heat(const Sweep& sweep, const std::string& key);
/// (value of an axis) number of its heat: values that agree in all keys that may change
/// temperatures have one number; ascending from 0 without gaps.
std::vector<std::size_t> heat_classes(const Sweep& sweep, const SweepAxis& axis);
/// Whether variants that differ in this axis may have different temperatures.
bool touches_heat(const Sweep& sweep, const SweepAxis& axis);

/// The scene of a variant.
Scene scene_of(const Sweep& sweep, const Variant& variant);

/// The scene with those of its values that may affect heat: the same for all variants of one heat.
Scene heat_scene_of(const Sweep& sweep, const Variant& variant);
/// The command line's settings and those values, as "key=value".
std::vector<std::string> heat_settings(const Sweep& sweep, const Variant& variant);

}  // namespace diurna
