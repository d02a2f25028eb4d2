#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "materials/base/section.hpp"

namespace diurna {

/// What goes through a list of values: a key, or several that change together.
struct SweepAxis {
    std::string name;
    std::vector<std::string> keys;                 // paths in the scene file
    std::vector<std::vector<std::string>> values;  // (value) (key), as JSON
    std::string where;                             // in the scene file
};

/// What of a sweep lies on one side of training and validation.
enum class SweepSplit { instants, variants, heats };

/// The word of the key sweep.split.
std::string word_of(SweepSplit split);

/// The section [sweep]: variants of a scene are all combinations of the axes' values, or some of
/// them that are drawn.
struct SweepInput {
    std::vector<SweepAxis> axes;      // none: no sweep
    std::optional<std::size_t> draw;  // variants of the grid
    SweepSplit split = SweepSplit::instants;

    /// Combinations of all values; a double, for there may be more than fit elsewhere.
    double grid() const;
};

inline constexpr double most_variants = 1e5, largest_grid = 1e15;

SweepInput read_sweep(const Section& section);

}  // namespace diurna
