#include "scenes/job/input/read_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace diurna {

namespace {

SweepAxis read_axis(const Section& section) {
    SweepAxis axis;
    axis.where = section.where();
    if (section.has("keys")) {
        axis.keys =
            section.texts_or("keys", "several keys that change together, instead of key", {});
        if (axis.keys.size() < 2) section.mistake("keys", "expected at least two keys, or key");
        if (section.has("key")) section.mistake("key", "cannot be combined with keys");
    } else {
        axis.keys = {section.text(
            "key",
            "path of any key of this file: time.start, observer.east.height_above_ground_m; tables "
            "of one kind by name or by number from 0")};
    }
    axis.name =
        section.text_or("name", "name in the manifest", {axis.keys.front(), "its (first) key"});
    axis.values = section.values(
        "values", "values of the axis; for keys: arrays with one value per key", axis.keys.size());
    for (const std::string& key : axis.keys) {
        if (key.rfind("sweep", 0) == 0) {
            section.mistake(section.has("keys") ? "keys" : "key", "a sweep cannot change a sweep");
        }
    }
    return axis;
}

void check_names(const Section& section, const std::vector<SweepAxis>& axes) {
    std::set<std::string> names, keys;
    for (const SweepAxis& axis : axes) {
        if (!names.insert(axis.name).second) {
            section.mistake("axis", fmt::format("the name \"{}\" is used twice", axis.name));
        }
        for (const std::string& key : axis.keys) {
            if (!keys.insert(key).second) {
                section.mistake("axis", fmt::format("two axes change {}", key));
            }
        }
    }
}

}  // namespace

double SweepInput::grid() const {
    double count = axes.empty() ? 0.0 : 1.0;
    for (const SweepAxis& axis : axes) count *= double(axis.values.size());
    return count;
}

std::string word_of(SweepSplit split) {
    switch (split) {
        case SweepSplit::variants:
            return "variants";
        case SweepSplit::heats:
            return "heats";
        default:
            return "instants";
    }
}

SweepInput read_sweep(const Section& section) {
    SweepInput sweep;
    for (const Section& axis : section.sections(
             "axis",
             "a list of values; the variants are all combinations of the values of all axes")) {
        sweep.axes.push_back(read_axis(axis));
    }
    check_names(section, sweep.axes);
    const double grid = sweep.grid();
    if (section.has("draw")) {
        sweep.draw = static_cast<std::size_t>(
            section.integer_or("draw",
                               "number of combinations to use, drawn by scene.seed; a larger "
                               "number includes those of a smaller one",
                               {1, "all"}, {1.0, most_variants}));
        if (double(*sweep.draw) > grid) {
            section.mistake("draw", fmt::format("found {}, but there are only {:g} combinations",
                                                *sweep.draw, grid));
        }
        if (grid > largest_grid) section.mistake("axis", "more than 1e15 combinations");
    } else if (grid > most_variants) {
        section.mistake(
            "axis", fmt::format("{:g} combinations, expected at most {:g}", grid, most_variants),
            "draw = N uses N of them");
    }
    sweep.split = section.choice_or(
        "split",
        "unit of the draw for validation (labels.validation_share, by scene.seed), whose pictures "
        "are all in one set: instants, variants (always if all pictures have the same instant), or "
        "heats: all variants that share their temperatures, so that validation has no day that "
        "training shows from another side",
        SweepSplit::instants,
        {{"instants", SweepSplit::instants},
         {"variants", SweepSplit::variants},
         {"heats", SweepSplit::heats}});
    return sweep;
}

}  // namespace diurna
