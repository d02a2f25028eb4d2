#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scenes/job/run/stages.hpp"
#include "thermal/temperature_field.hpp"

/// Use of a solution in which some facets have a representative's temperature
/// (TemperatureField::solved_as) for other pictures than those that it was made for.
namespace diurna {

/// What these facets mean for pictures.
struct RepresentedEffect {
    double shown = 0.0;  // share of a picture that they fill, at most
    double difference =
        0.0;               // [K] rms, of such a facet's own temperature from its representative's
    bool measured = true;  // `difference` is measured; otherwise an upper estimate
    /// [K] rms error of the worst picture: the difference times √shown where they are visible, and
    /// times the share of the surroundings of what is visible where they only exchange heat.
    double kelvin = 0.0;

    bool within(double tolerance) const { return kelvin <= tolerance; }
};

/// - share: (facet) largest share of any picture that it fills (scenes/job/run/picture_shares.hpp)
RepresentedEffect represented_effect(const Stages& stages, const TemperatureField& field,
                                     const std::vector<float>& share);

/// One line: that the temperatures of `file` are used, or that facets were solved instead.
///
/// - tolerance: [K] Scene::tolerance
/// - solved: "all facets", "the facets that these pictures need"
std::string in_words(const RepresentedEffect& effect, const std::filesystem::path& file,
                     double tolerance, const std::string& solved);

}  // namespace diurna
