#include "scenes/studies/signature_scene.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "materials/base/error.hpp"
#include "render/view/pixel_rays.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/picture.hpp"
#include "scenes/job/run/represented.hpp"
#include "scenes/job/run/series.hpp"
#include "scenes/job/store/heat_content.hpp"
#include "scenes/products/labels/labelled.hpp"
#include "scenes/studies/seen_regions.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

Prepared made_ready(Scene scene, Progress& progress) {
    progress.stage(StageId::terrain);
    return prepare(std::move(scene));
}

}  // namespace

Study::Study(Scene scene, ProgressTo progress)
    : progress_(std::move(progress)),
      prepared_(made_ready(std::move(scene), progress_)),
      store_(StageStore::in_memory()),
      stages_(prepared_, store_) {
    check_start(prepared_);
    notes_ = prepared_.notes;
}

const std::string& Study::content() {
    if (content_.empty()) content_ = heat_content(prepared_);
    return content_;
}

TemperatureField Study::heat(const std::filesystem::path& file,
                             const std::vector<StudiedObject>& studied, const SeenShare& seen) {
    progress_.stage(StageId::sky_view);
    std::set<Instant> wanted;
    for (const StudiedObject& one : studied) {
        for (const Instant when : one.frames) {
            studied_target(stages_, one, when);
            wanted.insert(when);
        }
    }
    TemperatureField field = heat(file, seen);
    if (!file.empty()) {
        check_covers(field, std::vector<Instant>(wanted.begin(), wanted.end()), file);
    }
    for (const Instant when : wanted) {
        if (std::binary_search(field.instant.begin(), field.instant.end(), when)) continue;
        const bool within = when > field.instant.front() && when < field.instant.back();
        notes_.push_back(fmt::format(
            "temperatures at {} are not stored: {}", format_local(when, scene().time.utc_offset),
            within ? "interpolated linearly" : "the nearest stored ones are used"));
    }
    return field;
}

TemperatureField Study::heat(const std::filesystem::path& file, const SeenShare& seen) {
    if (file.empty()) return solve();
    GivenHeat given = given_heat(prepared_, run_inputs(prepared_.scene), file);
    if (given.field.solved_as.empty()) return taken(std::move(given));
    const RepresentedEffect effect = represented_effect(stages_, given.field, seen());
    const double tolerance = scene().tolerance;
    notes_.push_back(in_words(effect, file, tolerance, "all facets"));
    return effect.within(tolerance) ? taken(std::move(given)) : solve();
}

TemperatureField Study::whole_heat(const std::filesystem::path& file) {
    if (file.empty()) return solve();
    GivenHeat given = given_heat(prepared_, run_inputs(prepared_.scene), file);
    if (given.field.solved_as.empty()) return taken(std::move(given));
    notes_.push_back(fmt::format(
        "{}: some facets have a representative's temperature, and this study compares solutions of "
        "all facets: they were solved instead",
        file.string()));
    return solve();
}

void Study::next_solve() {
    ++solve_;
    if (solves_ < 2) return;
    progress_.part(solve_ <= solves_ ? fmt::format("solve {} of {}", solve_, solves_)
                                     : fmt::format("solve {}", solve_));
}

TemperatureField Study::solve() {
    next_solve();
    constexpr double most_bytes = 1e9;
    const TimeInput& time = scene().time;
    const double bytes = sizeof(float) * double(prepared_.world.surfaces().size()) *
                         (time.duration / time.step + 2.0 * 86400.0 / time.step);
    SpanResult result =
        solve_scene(stages_, progress_, {}, {.keep_course = time.every_step && bytes < most_bytes});
    course_ = std::move(result.course);
    not_converged_ = diurna::not_converged(result.report);
    notes_.insert(notes_.end(), result.notes.begin(), result.notes.end());
    if (!result.start.empty()) notes_.push_back("start: " + result.start);
    return std::move(result.temperature);
}

TemperatureField Study::taken(GivenHeat given) {
    skip_solve();
    notes_.insert(notes_.end(), given.warnings.begin(), given.warnings.end());
    return std::move(given.field);
}

StudiedTarget studied_target(const Stages& stages, const StudiedObject& studied, Instant when) {
    const Movement& movement = stages.scene().movement;
    if (!movement.none() && movement.is_under_way(when)) {
        throw InputError(
            studied.where,
            fmt::format("an object moves at {}, expected instants when all objects are at rest",
                        format_local(when, stages.scene().scene.time.utc_offset)));
    }
    const SceneStage stage = stages.at(movement.none() ? 0 : movement.stage_of(when));
    const World& world = stage.prepared.world;
    const std::vector<Labelled> objects = labelled_objects(stage.prepared.scene, world);
    const auto found = std::find(world.objects.begin(), world.objects.end(), studied.object);
    const auto place = static_cast<std::size_t>(found - world.objects.begin());
    const auto id = static_cast<ObjectId>(place);
    const double heading = place < objects.size() ? objects[place].heading_deg : 0.0;
    const auto box = upright_box(object_facets(world, id), id, heading);
    if (!box) {
        throw InputError(studied.where, fmt::format("\"{}\" has no surface", studied.object));
    }
    return {.stage = stage,
            .id = id,
            .heading_deg = heading,
            .box = *box,
            .radius = 0.5 * std::hypot(box->length, box->width, box->height),
            .lowest = box->middle.z() - 0.5 * box->height};
}

double ObjectFigures::rss() const { return std::hypot(difference, spread); }

ObjectFigures CloseUp::figures(const std::string& plane) const {
    const std::vector<float>& value = frame[plane].pixel;
    ObjectFigures found;
    double around_sum = 0.0;
    for (std::size_t p = 0; p < value.size(); ++p) {
        if (around[p] == 0 || !std::isfinite(value[p])) continue;
        around_sum += double{value[p]};
        ++found.background_pixels;
    }
    if (found.background_pixels > 0) {
        found.background = around_sum / double(found.background_pixels);
    }
    double sum = 0.0, filled = 0.0, filled_sum = 0.0, squares = 0.0;
    int left = frame.width, right = -1, top = frame.height, bottom = -1;
    for (std::size_t p = 0; p < value.size(); ++p) {
        if (!(cover[p] > 0.0f) || !std::isfinite(value[p])) continue;
        const double above = double{value[p]} - found.background;
        found.covered += double{cover[p]};
        sum += above;  // of a mixture the share that is the object's, weighted as it should be
        if (cover[p] > 0.5f) {
            const int column = static_cast<int>(p) % frame.width;
            const int row = static_cast<int>(p) / frame.width;
            left = std::min(left, column);
            right = std::max(right, column);
            top = std::min(top, row);
            bottom = std::max(bottom, row);
        }
        if (cover[p] < 0.999f) continue;
        filled += 1.0;
        filled_sum += above;
        squares += above * above;
    }
    if (found.covered > 0.0) found.difference = sum / found.covered;
    if (filled > 0.0) {
        const double mean = filled_sum / filled;
        found.spread = std::sqrt(std::max(0.0, squares / filled - mean * mean));
    }
    found.least_width = std::max(0, std::min(right - left, bottom - top) + 1);
    return found;
}

namespace {

std::vector<std::uint8_t> around_of(const Frame& frame, const std::vector<float>& cover,
                                    const Observer& eye, double lowest) {
    const Eigen::Vector3d forward = attitude_of(eye) * Eigen::Vector3d::UnitY();
    const Eigen::Vector3d up = attitude_of(eye) * Eigen::Vector3d::UnitZ();
    const bool parallel = eye.projection == Projection::orthographic;
    const double pixel = parallel ? eye.picture_width / eye.width : 0.0;
    const std::array<const Plane*, 3> normal{&frame["normal.X"], &frame["normal.Y"],
                                             &frame["normal.Z"]};
    std::vector<std::uint8_t> around(cover.size(), 0);
    for (std::size_t p = 0; p < cover.size(); ++p) {
        if (cover[p] > 0.0f) continue;
        const double row = double(p / std::size_t(frame.width)) + 0.5 - 0.5 * frame.height;
        if (parallel && eye.position.z() - row * pixel * up.z() < lowest) continue;
        double facing = -1.0;
        if (std::isfinite(normal[0]->pixel[p])) {
            facing = 0.0;
            for (int axis = 0; axis < 3; ++axis) {
                facing += double{normal[std::size_t(axis)]->pixel[p]} * forward[axis];
            }
        }
        around[p] = facing < 0.0 ? 1 : 0;
    }
    return around;
}

}  // namespace

CloseUp close_up(const StudiedTarget& target, const Observer& eye,
                 const std::vector<std::string>& bands, int samples, const TemperatureField& field,
                 Instant when) {
    const Prepared& prepared = target.stage.prepared;
    ObserverInput input;
    input.name = eye.name;
    input.projection = eye.projection;
    input.horizontal_fov_deg = eye.horizontal_fov_deg;
    input.picture_width = eye.picture_width;
    input.width = eye.width;
    input.height = eye.height;
    input.samples = samples;
    input.bands = bands;
    // All pixels alike: sums over a picture want its samples spread evenly.
    const std::vector<std::uint8_t> all(std::size_t(input.width) * std::size_t(input.height), 1);
    const Series series =
        cast_series(prepared, input, eye, {&when, 1}, target.stage.views, field, all);
    Picture picture = picture_at(prepared, series, target.stage.views, field, when);
    CloseUp found{.frame = std::move(picture.frame),
                  .cover = region_cover(
                      first_seen(prepared, series), prepared,
                      {.kind = RegionInput::Kind::object,
                       .object = prepared.world.objects[static_cast<std::size_t>(target.id)]}),
                  .around = {}};
    found.around = around_of(found.frame, found.cover, eye, target.lowest);
    return found;
}

}  // namespace diurna
