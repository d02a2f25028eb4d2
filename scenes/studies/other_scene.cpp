#include "scenes/studies/other_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "materials/base/error.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/store/heat_content.hpp"

namespace diurna {

namespace {

Scene every_step(Scene scene) {
    scene.time.every_step = true;
    return scene;
}

/// The state at the start of the span, where days before it were solved; null: there are none.
const HeatState* start_of(const SpanCourse& course, const Prepared& prepared) {
    const HeatState* start = nullptr;
    for (const SpanCourse::Piece& piece : course.piece) {
        if (piece.to == prepared.scene.time.start) start = &piece.end;
    }
    return start;
}

/// The end of the step in which an instant is.
Instant step_end(const TimeInput& time, Instant when) {
    const double steps = std::ceil(seconds_between(time.start, when) / time.step - 1e-9);
    return later(time.start, time.step * std::max(1.0, steps));
}

}  // namespace

OtherScene::OtherScene(Scene scene, Study& study, GivenTemperatures given)
    : prepared(prepare(every_step(std::move(scene)))),
      stages(prepared, study.store()),
      own_(std::move(given.field)) {
    if (prepared.world.facets.size() != study.stages().scene().world.facets.size()) {
        throw InputError(prepared.scene.file.string(),
                         "this uncertain value changes the facets of the ground, which alone would "
                         "change the results");
    }
}

OtherScene::OtherScene(Scene scene, Study& study, const TemperatureField& base, bool finer_steps,
                       std::optional<Instant> until)
    : OtherScene(std::move(scene), study, GivenTemperatures{}) {
    if (heat_content(prepared) == study.content()) {
        base_ = &base;
        study.skip_solve();
        return;
    }
    study.next_solve();
    if (until) until = step_end(prepared.scene.time, *until);
    const SpanCourse& course = study.course();
    SpanResult result = solve_scene(stages, study.progress(), {},
                                    {.like = &course,
                                     .start = finer_steps ? start_of(course, prepared) : nullptr,
                                     .until = until});
    solved = true;
    not_converged = diurna::not_converged(result.report);
    own_ = std::move(result.temperature);
}

}  // namespace diurna
