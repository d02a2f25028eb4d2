#include "scenes/app/sweep/variants.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <numeric>
#include <set>
#include <string_view>
#include <utility>

#include "materials/base/random.hpp"
#include "materials/matter/library_parts.hpp"
#include "scenes/job/input/scene_file.hpp"

namespace diurna {

namespace {

/// Adds where value `choice` of an axis goes, of those keys that count.
template <class Counts>
void take(const SweepAxis& axis, std::size_t number, std::size_t choice, const Counts& counts,
          std::vector<ValueMove>& moves) {
    const std::string from = fmt::format("sweep.axis.{}.values.{}", number, choice);
    for (std::size_t k = 0; k < axis.keys.size(); ++k) {
        if (!counts(axis.keys[k])) continue;
        moves.emplace_back(axis.keys.size() == 1 ? from : fmt::format("{}.{}", from, k),
                           axis.keys[k]);
    }
}

/// The scene with values of its axes, which are then removed.
Scene scene_with(const Sweep& sweep, const std::vector<ValueMove>& moves) {
    Document document = scene_document(sweep.file, sweep.settings, sweep.base.confines);
    move_values(document, moves, MaterialTables::by_name);
    document.drop("sweep");
    return read_scene(document);
}

bool every_key(const std::string&) { return true; }

/// With a variant's values of those keys that count.
template <class Counts>
Scene scene_with(const Sweep& sweep, const Variant& variant, const Counts& counts) {
    const std::vector<SweepAxis>& axes = sweep.base.sweep.axes;
    std::vector<ValueMove> moves;
    for (std::size_t a = 0; a < axes.size(); ++a) {
        take(axes[a], a, variant.choice[a], counts, moves);
    }
    return scene_with(sweep, moves);
}

/// Whether the ground's mesh follows the observers (terrain.coarsest_m), in any variant.
bool ground_by_observers(const Scene& base) {
    bool follows = base.terrain.coarsest > base.terrain.elevation.tolerance;
    for (const SweepAxis& axis : base.sweep.axes) {
        for (const std::string& key : axis.keys) {
            follows = follows || key == "terrain" || key == "terrain.coarsest_m" ||
                      (key == "terrain.tolerance_m" && base.terrain.coarsest > 0.0);
        }
    }
    return follows;
}

/// Numbers of the grid, ascending: all, or drawn one after the other.
std::vector<std::uint64_t> chosen_numbers(const SweepInput& sweep, std::uint64_t seed) {
    const auto grid = static_cast<std::uint64_t>(sweep.grid());
    if (!sweep.draw || double(*sweep.draw) == sweep.grid()) {
        std::vector<std::uint64_t> all(grid);
        std::iota(all.begin(), all.end(), std::uint64_t{0});
        return all;
    }
    constexpr std::uint64_t purpose = 0x53E3B;  // apart from what else the seed draws
    std::set<std::uint64_t> drawn;
    for (std::uint64_t k = 0; drawn.size() < *sweep.draw; ++k) {
        const double share = unit_interval(hashed(hashed(seed ^ purpose) + k));
        drawn.insert(std::min(grid - 1, static_cast<std::uint64_t>(share * double(grid))));
    }
    return {drawn.begin(), drawn.end()};
}

std::size_t digits(std::uint64_t count) {
    return std::to_string(std::max<std::uint64_t>(count, 1) - 1).size();
}

/// Of the grid, the last axis running fastest.
///
/// - heats: (axis) heat_classes()
Variant variant_of(const Sweep& whole, const std::vector<std::vector<std::size_t>>& heats_of,
                   std::uint64_t number) {
    const SweepInput& sweep = whole.base.sweep;
    Variant variant{.name = fmt::format("v{:0{}}", number, digits(std::uint64_t(sweep.grid()))),
                    .choice = std::vector<std::size_t>(sweep.axes.size()),
                    .heat = ""};
    for (std::size_t a = sweep.axes.size(); a-- > 0;) {
        const std::uint64_t count = sweep.axes[a].values.size();
        variant.choice[a] = static_cast<std::size_t>(number % count);
        number /= count;
    }
    std::uint64_t heat = 0, heats = 1;
    for (std::size_t a = 0; a < sweep.axes.size(); ++a) {
        const std::vector<std::size_t>& classes = heats_of[a];
        const std::size_t count = 1 + *std::max_element(classes.begin(), classes.end());
        heat = heat * count + classes[variant.choice[a]];
        heats *= count;
    }
    variant.heat = fmt::format("h{:0{}}", heat, digits(heats));
    return variant;
}

}  // namespace

void for_each_value(const Sweep& sweep, const std::function<void(Scene)>& use) {
    std::vector<Mistake> mistakes;
    std::set<std::string> reported;
    const std::vector<SweepAxis>& axes = sweep.base.sweep.axes;
    for (std::size_t a = 0; a < axes.size(); ++a) {
        for (std::size_t v = 0; v < axes[a].values.size(); ++v) {
            try {
                std::vector<ValueMove> moves;
                take(axes[a], a, v, every_key, moves);
                use(scene_with(sweep, moves));
            } catch (const InputError& error) {
                // A key that is none is so for every value: reported of the first.
                for (const Mistake& mistake : error.mistakes()) {
                    const std::string key = mistake.where.substr(mistake.where.find(' ') + 1);
                    if (reported.insert(key + mistake.problem).second) mistakes.push_back(mistake);
                }
            }
        }
    }
    if (!mistakes.empty()) throw InputError(std::move(mistakes));
}

std::size_t Sweep::solves() const {
    std::set<std::string> heats;
    for (const Variant& variant : variants) heats.insert(variant.heat);
    return heats.size();
}

bool touches_heat(const Sweep& sweep, const std::string& key) {
    const std::size_t last = key.rfind('.') + 1;  // of no dot: 0
    if (key.starts_with("labels.") || key.starts_with("instrument.")) return false;
    return !key.starts_with("observer.") || key.substr(last).starts_with("frame") ||
           sweep.ground_by_observers;
}

std::vector<std::size_t> heat_classes(const Sweep& sweep, const SweepAxis& axis) {
    std::map<std::vector<std::string>, std::size_t> known;
    std::vector<std::size_t> classes;
    for (const std::vector<std::string>& row : axis.values) {
        std::vector<std::string> heat;
        for (std::size_t k = 0; k < axis.keys.size(); ++k) {
            if (touches_heat(sweep, axis.keys[k])) heat.push_back(row[k]);
        }
        classes.push_back(known.try_emplace(std::move(heat), known.size()).first->second);
    }
    return classes;
}

bool touches_heat(const Sweep& sweep, const SweepAxis& axis) {
    const std::vector<std::size_t> classes = heat_classes(sweep, axis);
    return std::any_of(classes.begin(), classes.end(), [](std::size_t one) { return one > 0; });
}

Sweep read_sweep_variants(const std::filesystem::path& file,
                          const std::vector<std::string>& settings, bool allow_outside) {
    Sweep sweep{.file = file,
                .settings = settings,
                .base = read_scene(file, settings, allow_outside),
                .variants = {}};
    for_each_value(sweep, [](const Scene&) {});
    sweep.ground_by_observers = ground_by_observers(sweep.base);
    std::vector<std::vector<std::size_t>> heats_of;
    for (const SweepAxis& axis : sweep.base.sweep.axes) {
        heats_of.push_back(heat_classes(sweep, axis));
    }
    for (const std::uint64_t number : chosen_numbers(sweep.base.sweep, sweep.base.seed)) {
        sweep.variants.push_back(variant_of(sweep, heats_of, number));
    }
    std::stable_sort(sweep.variants.begin(), sweep.variants.end(),
                     [](const Variant& a, const Variant& b) { return a.heat < b.heat; });
    return sweep;
}

Scene scene_of(const Sweep& sweep, const Variant& variant) {
    return scene_with(sweep, variant, every_key);
}

Scene heat_scene_of(const Sweep& sweep, const Variant& variant) {
    return scene_with(sweep, variant,
                      [&](const std::string& key) { return touches_heat(sweep, key); });
}

std::vector<std::string> heat_settings(const Sweep& sweep, const Variant& variant) {
    std::vector<std::string> settings = sweep.settings;
    const std::vector<SweepAxis>& axes = sweep.base.sweep.axes;
    for (std::size_t a = 0; a < axes.size(); ++a) {
        for (std::size_t k = 0; k < axes[a].keys.size(); ++k) {
            if (!touches_heat(sweep, axes[a].keys[k])) continue;
            settings.push_back(axes[a].keys[k] + "=" + axes[a].values[variant.choice[a]][k]);
        }
    }
    return settings;
}

}  // namespace diurna
