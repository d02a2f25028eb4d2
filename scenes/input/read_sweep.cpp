#include "scenes/input/read_sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

namespace diurna {

namespace {

SweepAxis read_axis(const Section& section) {
    SweepAxis axis;
    axis.where = section.where();
    if (section.has("keys")) {
        axis.keys = section.texts_or("keys", "in place of key: several that change together", {});
        if (axis.keys.size() < 2) section.mistake("keys", "expected two or more, or key");
        if (section.has("key")) section.mistake("key", "stands beside keys");
    } else {
        axis.keys = {section.text(
            "key",
            "path of any key of this file: time.start, observer.east.height_above_ground_m; of "
            "tables of one kind by their name or number from 0")};
    }
    axis.name = section.text_or("name", "in the manifest", {axis.keys.front(), "its (first) key"});
    axis.values = section.values("values",
                                 "that it takes one after the other; of keys, arrays of "
                                 "a value for each",
                                 axis.keys.size());
    for (const std::string& key : axis.keys) {
        if (key.rfind("sweep", 0) == 0) {
            section.mistake(section.has("keys") ? "keys" : "key", "a sweep changes no sweep");
        }
    }
    return axis;
}

void check_names(const Section& section, const std::vector<SweepAxis>& axes) {
    std::set<std::string> names, keys;
    for (const SweepAxis& axis : axes) {
        if (!names.insert(axis.name).second) {
            section.mistake("axis", fmt::format("two of the name \"{}\"", axis.name));
        }
        for (const std::string& key : axis.keys) {
            if (!keys.insert(key).second) {
                section.mistake("axis", fmt::format("two change {}", key));
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
    for (const Section& axis : section.sections("axis",
                                                "a list of values; variants are all "
                                                "combinations of those of all axes")) {
        sweep.axes.push_back(read_axis(axis));
    }
    check_names(section, sweep.axes);
    const double grid = sweep.grid();
    if (section.has("draw")) {
        sweep.draw = static_cast<std::size_t>(section.integer_or(
            "draw", "so many of the combinations, drawn by scene.seed; more of them keep the first",
            {1, "all"}, {1.0, most_variants}));
        if (double(*sweep.draw) > grid) {
            section.mistake(
                "draw", fmt::format("found {}, there are {:g} combinations", *sweep.draw, grid));
        }
        if (grid > largest_grid) section.mistake("axis", "more than 1e15 combinations");
    } else if (grid > most_variants) {
        section.mistake(
            "axis", fmt::format("{:g} combinations, expected at most {:g}", grid, most_variants),
            "draw = N takes some of them");
    }
    sweep.split = section.choice_or(
        "split",
        "what of all variants is drawn for validation (labels.validation_share, by scene.seed), "
        "its pictures being on one side: instants, variants (which alone are drawn where all "
        "pictures are of one instant), or heats: all variants that share their temperatures, so "
        "that no day of validation was seen in training from another side",
        SweepSplit::instants,
        {{"instants", SweepSplit::instants},
         {"variants", SweepSplit::variants},
         {"heats", SweepSplit::heats}});
    return sweep;
}

}  // namespace diurna
