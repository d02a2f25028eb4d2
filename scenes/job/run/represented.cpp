#include "scenes/job/run/represented.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scenes/job/run/needed_facets.hpp"
#include "scenes/job/world/targets.hpp"

namespace diurna {

namespace {

constexpr double assumed_difference = 3.0;  // [K], as needed_facets() assumes before a measurement

}  // namespace

RepresentedEffect represented_effect(const Stages& stages, const TemperatureField& field,
                                     const std::vector<float>& share) {
    RepresentedEffect effect;
    if (field.solved_as.empty()) return effect;
    effect.measured = field.representative_rms > 0.0;
    effect.difference = effect.measured ? field.representative_rms : assumed_difference;
    std::vector<std::uint8_t> solved(share.size(), 0);
    for (std::size_t f = 0; f < share.size(); ++f) {
        solved[f] = field.solved_as[f] == f ? 1 : 0;
        if (!solved[f]) effect.shown += double{share[f]};
    }
    effect.shown = std::min(effect.shown, 1.0);
    const Prepared& scene = stages.scene();
    const double weight =
        represented_weight(stages, targets(scene.world, scene.scene), share, solved);
    effect.kelvin = effect.difference * (std::sqrt(effect.shown) + weight);
    return effect;
}

std::string in_words(const RepresentedEffect& effect, const std::filesystem::path& file,
                     double tolerance, const std::string& solved) {
    constexpr double least_reported = 5e-4;  // [K]
    const std::string shown =
        effect.shown > 0.0
            ? fmt::format(
                  "facets that fill up to {:.3g} % of a picture have a representative's "
                  "temperature",
                  100.0 * effect.shown)
            : "all visible facets are solved";
    const std::string kelvin = effect.kelvin < least_reported
                                   ? fmt::format("less than {:.0e} K", least_reported)
                                   : fmt::format("up to {:.2g} K", effect.kelvin);
    const std::string difference =
        fmt::format("{:.2g} K rms{}", effect.difference, effect.measured ? "" : ", assumed");
    if (effect.within(tolerance)) {
        return fmt::format(
            "{}: {}; representatives (difference {}) change the pictures by {} rms, within "
            "tolerance_K = {:g}",
            file.string(), shown, difference, kelvin, tolerance);
    }
    return fmt::format(
        "{}: {}; representatives (difference {}) would change the pictures by {} rms, more than "
        "tolerance_K = {:g}: {} were solved instead",
        file.string(), shown, difference, kelvin, tolerance, solved);
}

}  // namespace diurna
