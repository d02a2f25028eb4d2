#include "scenes/job/run/stage_heat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "materials/base/number_of.hpp"
#include "materials/matter/passed_light.hpp"
#include "scenes/job/run/scene_sky_view.hpp"
#include "scenes/job/world/heights.hpp"
#include "scenes/job/world/rain_cover.hpp"
#include "scenes/job/world/targets.hpp"
#include "scenes/job/world/wind.hpp"

namespace diurna {

namespace {

/// What is and is not followed of targets.
std::string targets_reported(const SolveInput& input, const SolveReport& report) {
    if (report.target_facets == 0) return "";
    std::string reported = fmt::format(
        "targets: heat conduction along the sheets on {}; rain, dew and snow are not modelled "
        "there",
        number_of(report.target_facets, "facet"));
    for (const NetworkObject& object : input.network) {
        for (const std::string& note : object.notes) reported += "; " + note;
        if (object.loose_edges == 0) continue;
        reported += fmt::format(
            "; {} of \"{}\" without heat conduction, because no other whole edge meets them (open "
            "ends, T-junctions)",
            number_of(object.loose_edges, "edge"), object.name);
    }
    return reported;
}

/// What was followed of the water on surfaces, and what was not.
std::string water_reported(const SolveReport& report) {
    std::vector<std::string> parts;
    if (report.stores > 0) {
        parts.push_back(fmt::format("rain, dew, frost and snow are modelled on {}",
                                    number_of(report.stores, "facet")));
    }
    if (report.unfollowed > 0) {
        parts.push_back(fmt::format(
            "on {} dew warms the surface but does not stay on it: an error below {:.2g} K where "
            "the material is dry, up to {:.2g} mm less evaporation where it is moist",
            number_of(report.unfollowed, "other facet"), std::max(0.01, report.dew_left_out),
            report.most_dew_unfollowed));
    }
    return parts.empty() ? "" : fmt::format("water: {}", fmt::join(parts, ". "));
}

}  // namespace

StageHeat::StageHeat(const SceneStage& stage, Instant end)
    : prepared_(stage.prepared),
      sunlight_views_(passes_by_spectrum(passed_light(prepared_.scene.materials))
                          ? std::optional(scene_sky_view(prepared_, true, stage.store))
                          : std::nullopt),
      daily_(prepared_, end, stage.store),
      albedo_(measured_albedo(prepared_.scene, prepared_.world, prepared_.weather)),
      by_height_(air_by_height(prepared_.scene, prepared_.weather)),
      parts_(
          parts_in_wind(prepared_.world, prepared_.scene.materials, prepared_.weather.wind_height)),
      open_(open_above(prepared_.world, prepared_.scene.materials, prepared_.weather)),
      input_{.facets = prepared_.world.surfaces(),
             .views = stage.views,
             .sun = none_,
             .materials = prepared_.scene.materials,
             .weather = prepared_.weather,
             .site = prepared_.world.site,
             .utc_offset = prepared_.scene.time.utc_offset,
             .elevation = prepared_.weather.height,
             .by_height = &by_height_,
             .height = facet_heights(prepared_.world),
             .part = parts_,
             .network = targets(prepared_.world, prepared_.scene),
             .open_above = open_,
             .clear_sky = prepared_.scene.sky,
             .measured_share = albedo_.share,
             .sunlight_views = sunlight_views_ ? &*sunlight_views_ : nullptr} {}

SunExposure StageHeat::exposure(const std::vector<Instant>& instants) {
    const auto begun = std::chrono::steady_clock::now();
    SunExposure sun = daily_.of(instants);
    shadow_seconds_ +=
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    return sun;
}

std::vector<std::string> StageHeat::reported(const SolveReport& report) const {
    std::vector<std::string> notes;
    for (std::string note :
         {lee_note(prepared_.world, parts_), targets_reported(input_, report),
          rain_note(prepared_.world, prepared_.scene.materials, prepared_.weather, open_),
          water_reported(report)}) {
        if (!note.empty()) notes.push_back(std::move(note));
    }
    if (const double share = daily_.share_taken_over(); share > 0.0) {
        notes.push_back(
            fmt::format("shadows: {:.0f} % of the values (facet, instant) are taken from "
                        "neighbouring days with the sun within {:g} degrees, where both days agree "
                        "within 2 %; the others are traced",
                        100.0 * share, DailySunExposure::furthest_deg));
    }
    return notes;
}

}  // namespace diurna
