#include "scenes/job/run/picture_shares.hpp"

#include <algorithm>
#include <utility>

#include "render/rays/follow_rays.hpp"
#include "render/view/cast_view.hpp"
#include "scenes/job/run/ground_to_horizon.hpp"
#include "scenes/job/run/series.hpp"

namespace diurna {

namespace {

/// Adds the facets whose mean is the ground beyond the raster, if a view looks at it.
void add_far_ground(const SceneStage& stage, const View& view, std::vector<float>& share) {
    const World& world = stage.prepared.world;
    const FacetSet& surfaces = world.surfaces();
    const std::optional<BorderGround> border = border_ground(world, surfaces);
    if (!border || !sees_beyond(view, border->height, world.sea_level_height)) return;
    const std::vector<BorderFacet> facets = far_ground_facets(*border, surfaces, stage.views.sky);
    double length = 0.0;
    for (const BorderFacet& of : facets) length += double(of.length);
    const double seen = double(view.extent.sky_pixels) / double(view.pixels());
    for (const BorderFacet& of : facets) {
        share[of.facet] += static_cast<float>(seen * double(of.length) / length);
    }
}

ViewOptions sampling_of(const Prepared& prepared, int samples) {
    return {.samples = samples,
            .seed = prepared.scene.seed,
            .texture_levels = &prepared.world.texture_levels};
}

View cast_picture(const SceneStage& stage, int samples, const Observer& pose) {
    const Prepared& prepared = stage.prepared;
    return cast_view(prepared.rays, prepared.world.surfaces(), pose,
                     sampling_of(prepared, samples));
}

/// Adds what one picture sees, the most of it and of what is there already.
///
/// - view: of the pose, with these samples
void add_picture(const SceneStage& stage, View view, int samples, const Observer& pose,
                 Instant when, std::vector<float>& share) {
    const Prepared& prepared = stage.prepared;
    const FacetSet& surfaces = prepared.world.surfaces();
    const PlumeScene plumes(prepared.plumes);
    const SecondaryRays secondary_rays = follow_rays(view,
                                                     {.rays = prepared.rays,
                                                      .facets = surfaces,
                                                      .materials = prepared.scene.materials,
                                                      .plumes = plumes,
                                                      .wind_speed = wind_at(prepared, when)},
                                                     pose, sampling_of(prepared, samples));
    std::vector<float> here(share.size(), 0.0f);
    const float pixel = 1.0f / static_cast<float>(view.pixels());
    for (const Sighting& s : view.sighting) {
        here[index(view.surface[s.target])] += pixel * s.weight;
    }
    for (const SecondaryRay& secondary : secondary_rays.secondary) {
        if (secondary.kind == SecondaryRay::Kind::facet)
            here[secondary.what] += pixel * secondary.weight;
    }
    add_far_ground(stage, view, here);
    for (std::size_t f = 0; f < share.size(); ++f) share[f] = std::max(share[f], here[f]);
}

}  // namespace

std::vector<float> picture_shares(const Stages& stages, int most_poses) {
    const Prepared& scene = stages.scene();
    std::vector<float> share(scene.world.surfaces().size(), 0.0f);
    for (std::size_t o = 0; o < scene.sequences.size(); ++o) {
        const Sequence& sequence = scene.sequences[o];
        std::vector<std::vector<std::size_t>> of_stage(stages.size());
        for (std::size_t i = 0; i < sequence.frame.size(); ++i) {
            of_stage[scene.movement.stage_of(sequence.frame[i])].push_back(i);
        }
        for (std::size_t s = 0; s < stages.size(); ++s) {
            const std::vector<std::size_t>& frames = of_stage[s];
            if (frames.empty()) continue;
            const std::size_t poses = sequence.goes ? frames.size() : 1;
            const std::size_t asked = std::min(poses, static_cast<std::size_t>(most_poses));
            for (std::size_t i = 0; i < asked; ++i) {
                const std::size_t frame = frames[asked > 1 ? i * (poses - 1) / (asked - 1) : 0];
                const int samples = scene.scene.observers[o].samples;
                const SceneStage stage = stages.at(s);
                View view = cast_picture(stage, samples, sequence.at(frame));
                if (!sequence.goes) stages.keep_view(o, s, view);
                add_picture(stage, std::move(view), samples, sequence.at(frame),
                            sequence.frame[frame], share);
            }
        }
    }
    return share;
}

std::vector<float> view_shares(const Stages& stages, std::span<const SeenView> views) {
    const Movement& movement = stages.scene().movement;
    std::vector<float> share(stages.scene().world.surfaces().size(), 0.0f);
    for (const SeenView& view : views) {
        const std::size_t stage = movement.none() ? 0 : movement.stage_of(view.when);
        add_picture(stages.at(stage), cast_picture(stages.at(stage), view.samples, view.eye),
                    view.samples, view.eye, view.when, share);
    }
    return share;
}

std::vector<std::uint8_t> seen_or_beside(const World& world, const std::vector<float>& share) {
    const FacetSet& solid = world.facets;
    const TextureLevels& levels = world.texture_levels;
    std::vector<std::uint8_t> corner_seen(solid.vertex.size(), 0);
    for (std::size_t f = 0; f < share.size(); ++f) {
        if (!(share[f] > 0.0f)) continue;
        for (const std::uint32_t v : solid.corner[index(levels.facet_of(surface_id(f)))])
            corner_seen[v] = 1;
    }
    std::vector<std::uint8_t> near(share.size(), 0);
    for (std::size_t f = 0; f < share.size(); ++f) {
        const auto& corner = solid.corner[index(levels.facet_of(surface_id(f)))];
        near[f] = std::any_of(corner.begin(), corner.end(),
                              [&](std::uint32_t v) { return corner_seen[v] != 0; });
    }
    return near;
}

}  // namespace diurna
