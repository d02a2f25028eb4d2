#include "scenes/job/store/heat_key.hpp"

#include "scenes/job/store/heat_content.hpp"
#include "scenes/job/store/key_facts.hpp"
#include "scenes/job/world/stepping.hpp"

namespace diurna {

namespace {

/// What the pictures show: poses and rays, not bands.
void add_views(const Prepared& prepared, KeyFacts& facts) {
    for (std::size_t o = 0; o < prepared.sequences.size(); ++o) {
        const Sequence& sequence = prepared.sequences[o];
        facts.number(prepared.scene.observers[o].samples);
        for (const Instant when : sequence.frame) facts.number(seconds_between(Instant{}, when));
        for (const Observer& eye : sequence.pose) {
            for (const Eigen::Vector3d& of : {eye.position, eye.velocity, eye.turning}) {
                facts.array<double>({of.data(), 3});
            }
            for (const double of :
                 {eye.azimuth_deg, eye.elevation_deg, eye.roll_deg, eye.horizontal_fov_deg,
                  eye.picture_width, eye.row_time, eye.exposure}) {
                facts.number(of);
            }
            facts.number(eye.width);
            facts.number(eye.height);
            facts.number(static_cast<int>(eye.projection));
        }
    }
}

}  // namespace

std::string pictures_key(const Prepared& prepared) {
    KeyFacts facts = stage_facts("pictures");
    add_views(prepared, facts);
    facts.number(static_cast<double>(prepared.scene.seed));
    facts.number(prepared.scene.check_points);
    return facts.digest();
}

std::string heat_key(const Prepared& prepared, const std::vector<RunInput>& inputs,
                     double tolerance) {
    const Scene& scene = prepared.scene;
    KeyFacts facts = stage_facts("heat");
    facts.line(heat_content(prepared));
    const bool moves = !prepared.movement.none(), pictures_count = tolerance > 0.0 || moves;
    if (pictures_count) {
        std::vector<RunInput> others;
        for (const RunInput& input : inputs) {
            const bool is_scene = input.path.lexically_normal() == scene.file.lexically_normal();
            if (!is_scene) others.push_back(input);
        }
        facts.line(job_key(others, {}));
        facts.line(moves ? scene.said : scene.said_but_for_pictures);
    }
    if (tolerance > 0.0) add_views(prepared, facts);
    facts.number(tolerance);
    facts.number(scene.check_points);
    const SpanOptions span = scene_span(scene);
    facts.number(seconds_between(Instant{}, span.wanted.front()));
    if (pictures_count) {
        for (const Instant when : span.wanted) facts.number(seconds_between(Instant{}, when));
    }
    return facts.digest();
}

}  // namespace diurna
