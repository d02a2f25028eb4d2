#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/plan/sequence.hpp"
#include "scenes/job/world/world.hpp"
#include "thermal/weather/weather.hpp"

namespace diurna {

/// Which facets the heat balance solves; solve_scene() (scenes/job/run/heat.hpp) follows it.
struct HeatDecision {
    /// Why every facet is solved; "": only those that pictures need
    /// (scenes/job/run/needed_facets.hpp).
    std::string every_facet = "temperatures are requested without pictures";
    double tolerance = 0.0;  // [K] rms of pictures, for facets that are not solved
    /// Points in pictures that are solved in addition, to measure the error of the facets' sizes.
    int check_points = 0;
};

/// Light of a scene's pictures, by instants: the sun's, the moon's
/// (scenes/job/world/light_source.hpp), or neither.
struct PictureLight {
    std::size_t sun = 0, moon = 0, neither = 0;
};

/// What is decided before anything is computed. The run follows it; the plan prints it.
struct Decisions {
    HeatDecision heat{};
    // Materials in use: those that evaporate by themselves, those that hold rain, dew, hoar or snow
    // where there is any (thermal/solve/point_facets.hpp), and those that do neither.
    std::vector<std::string> evaporating{}, holding_water{}, dry{};
    PictureLight light{};
    std::size_t views_cast_once = 0;  // observers whose view is cast once for all frames of a stage
    bool terms = false;               // planes of the radiance's terms
    std::size_t uncertain = 0;        // values: planes sigma.BAND
    int rounds = 0;                   // of finer settings, at most (scenes/job/run/rounds.hpp)
};

/// - sequences: of the observers, in the order of the scene; may be empty
Decisions decisions_of(const Scene& scene, const World& world, const Weather& weather,
                       std::span<const Sequence> sequences);

}  // namespace diurna
