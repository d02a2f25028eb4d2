#include "scenes/job/run/scene_sky_view.hpp"

#include <vector>

#include "materials/matter/passed_light.hpp"
#include "scenes/job/store/cached_or_computed.hpp"
#include "scenes/job/store/stage_keys.hpp"
#include "terrain/texture/level_values.hpp"
#include "terrain/visibility/reciprocity.hpp"
#include "terrain/visibility/relief_visibility.hpp"

namespace diurna {

namespace {

/// Of facets without textures' levels.
FacetViews solid_sky_view(const Prepared& prepared, bool sunlight) {
    const Scene& scene = prepared.scene;
    const ReliefVisibility light(prepared.world.facets, prepared.rays, *prepared.world.relief,
                                 prepared.world.ground_facets, prepared.world.on_detail);
    FacetViews view = light.facet_views({.rays = scene.sky_rays,
                                         .first_object = prepared.world.ground_facets,
                                         .object_rays = scene.object_sky_rays,
                                         .seed = scene.seed,
                                         .sunlight = sunlight});
    const std::vector<PassedLight> passed = passed_light(scene.materials);
    make_reciprocal(prepared.world.facets, view, {.passed = passed, .sunlight = sunlight});
    return view;
}

}  // namespace

FacetViews scene_sky_view(const Prepared& prepared, bool sunlight, const StageStore* store) {
    FacetViews view = cached_or_computed<FacetViews>(
        store, "sky", [&] { return sky_key(prepared, sunlight); }, views_of,
        [&] { return solid_sky_view(prepared, sunlight); });
    const TextureLevels& levels = prepared.world.texture_levels;
    if (levels.empty()) return view;
    return for_all_levels(levels, view);
}

}  // namespace diurna
