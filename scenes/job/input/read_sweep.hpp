#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "materials/base/section.hpp"

namespace diurna {

/// An axis of a sweep: a key with a list of values, or several that change together.
struct SweepAxis {
    std::string name;
    std::vector<std::string> keys;                 // paths in the scene file
    std::vector<std::vector<std::string>> values;  // (value) (key), as JSON
    std::string where;                             // in the scene file
};

/// What a sweep separates into training and validation.
enum class SweepSplit { instants, variants, heats };

/// The word of the key sweep.split.
std::string word_of(SweepSplit split);

/// The section [sweep]: variants of a scene are all combinations of the axes' values, or a random
/// selection of them.
struct SweepInput {
    std::vector<SweepAxis> axes;      // none: no sweep
    std::optional<std::size_t> draw;  // variants of the grid
    SweepSplit split = SweepSplit::instants;

    /// Number of combinations; a double, because it may exceed the range of integers.
    double grid() const;
};

inline constexpr double most_variants = 1e5, largest_grid = 1e15;

SweepInput read_sweep(const Section& section);

}  // namespace diurna
