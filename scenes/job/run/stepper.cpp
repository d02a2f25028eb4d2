#include "scenes/job/run/stepper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/scene_sky_view.hpp"
#include "scenes/job/run/stage_heat.hpp"
#include "scenes/job/world/elevation.hpp"
#include "scenes/job/world/ground_point.hpp"
#include "scenes/job/world/stance.hpp"
#include "scenes/job/world/stepping.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

/// The scene with its objects somewhere, what its facets see there, and what heat asks of it.
struct SceneInPlace {
    Prepared prepared;
    FacetViews views;
    StageHeat heat;

    SceneInPlace(Prepared there, Instant end)
        : prepared(std::move(there)),
          views(scene_sky_view(prepared)),
          heat({prepared, views}, end) {}
};

/// One of a field's instants alone.
TemperatureField row_of(const TemperatureField& field, std::size_t row) {
    const auto kelvin = field.at(row);
    TemperatureField one{.instant = {field.instant[row]},
                         .facets = field.facets,
                         .kelvin = {kelvin.begin(), kelvin.end()}};
    if (!field.water.empty()) {
        const auto cover = field.water.at(row);
        one.water = {.facet = field.water.facet, .cover = {cover.begin(), cover.end()}};
    }
    return one;
}

}  // namespace

struct Stepper::State {
    Prepared scene;  // with its objects where they are when it begins
    Dem dem;
    MoverPoses poses;              // now
    std::optional<Prepared> here;  // the scene with them there; none: to be made, or no movers
    std::unique_ptr<SceneInPlace> first;   // before the span's start
    std::unique_ptr<SceneInPlace> stands;  // for steps to come; null: as `first`
    bool moved = false;                    // since it was made

    Instant now;
    long long step = 0;              // the last one at or before now that is solved up to
    std::optional<HeatState> at;     // at that step; none at the span's start
    std::optional<HeatState> ahead;  // at the next one
    TemperatureField field;          // at the step, and the next one if that is solved
    int solved = 0;

    double length() const { return scene.scene.time.step; }
    Instant start() const { return scene.scene.time.start; }
    Instant instant(long long k) const { return later(start(), length() * double(k)); }
    /// The last step at or before an instant.
    long long step_before(Instant when) const {
        return static_cast<long long>(std::floor(seconds_between(start(), when) / length() + 1e-9));
    }
    bool on_step(Instant when, long long k) const {
        return std::abs(seconds_between(instant(k), when)) < 1e-6;
    }
    Prepared at_poses() const { return diurna::moved(scene, poses); }
    const Prepared& in_place() {
        if (poses.empty()) return scene;
        if (!here) here.emplace(at_poses());
        return *here;
    }
    /// What the next steps are solved in.
    SceneInPlace& part_to_solve() {
        if (moved) {
            stands = std::make_unique<SceneInPlace>(at_poses(), scene.scene.time.end());
            moved = false;
        }
        return stands ? *stands : *first;
    }
    void solve(long long from, long long to, std::vector<Instant> wanted);
    void solve_ahead();
    std::size_t mover(const std::string& object) const;
    std::size_t observer(const std::string& name) const;
};

/// From the heat at a step, or from before the span, to another.
void Stepper::State::solve(long long from, long long to, std::vector<Instant> wanted) {
    SceneInPlace& later_on = part_to_solve();
    SpanOptions span = scene_span(scene.scene);
    span.start = instant(from);
    span.end = instant(to);
    span.wanted = std::move(wanted);
    span.heat = false;
    span.goes_on = true;
    const auto stage = [](Instant since, SceneInPlace& s) {
        return SpanStage{since, s.heat.input(),
                         [&s](const std::vector<Instant>& when) { return s.heat.exposure(when); }};
    };
    std::vector<SpanStage> stages;
    if (from == 0 && !at) {
        stages.push_back(stage(start(), *first));
        if (&later_on != first.get()) stages.push_back(stage(start(), later_on));
    } else {
        span.begin = SpanStart::state;
        span.from = &*at;
        stages.push_back(stage(span.start, later_on));
    }
    SpanResult result = solve_span(stages, span);
    field = std::move(result.temperature);
    ahead = std::move(result.end);
    solved += static_cast<int>(to - from);
}

/// To the step behind now, where temperatures of now need it.
void Stepper::State::solve_ahead() {
    const bool needed = !on_step(now, step) || (step == 0 && !at);
    if (!needed || field.instant.size() == 2) return;
    solve(step, step + 1, {instant(step), instant(step + 1)});
}

std::size_t Stepper::State::mover(const std::string& object) const {
    const auto& movers = scene.world.movers;
    std::vector<std::string> names;
    for (std::size_t m = 0; m < movers.size(); ++m) {
        names.push_back(scene.scene.terrain.objects[movers[m].object].name);
        if (names.back() == object) return m;
    }
    throw InputError(scene.scene.file.string(),
                     fmt::format("no object \"{}\" with a trajectory", object),
                     did_you_mean(object, names));
}

std::size_t Stepper::State::observer(const std::string& name) const {
    const auto& all = scene.scene.observers;
    std::vector<std::string> names;
    for (const ObserverInput& input : all) names.push_back(input.name);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end()) {
        throw InputError(scene.scene.file.string(), fmt::format("no observer \"{}\"", name),
                         did_you_mean(name, names));
    }
    return static_cast<std::size_t>(found - names.begin());
}

Stepper::Stepper(Scene scene)
    : state_(std::make_unique<State>(State{.scene = prepare(std::move(scene)),
                                           .dem = {},
                                           .poses = {},
                                           .here = {},
                                           .first = {},
                                           .stands = {},
                                           .now = {},
                                           .at = {},
                                           .ahead = {},
                                           .field = {}})) {
    State& s = *state_;
    check_start(s.scene);
    s.dem = elevation_of(s.scene.scene);
    if (!s.scene.movement.none()) s.poses = s.scene.movement.at_stage.front();
    s.now = s.start();
    s.first = std::make_unique<SceneInPlace>(s.at_poses(), s.scene.scene.time.end());
}

Stepper::~Stepper() = default;

Instant Stepper::now() const { return state_->now; }

void Stepper::advance(Instant to) {
    State& s = *state_;
    const double offset = s.scene.scene.time.utc_offset;
    const auto refuse = [&](const char* problem, Instant end) {
        throw InputError(s.scene.scene.file.string(),
                         fmt::format("cannot advance to {}: {} {}", format_local(to, offset),
                                     problem, format_local(end, offset)));
    };
    if (to < s.now) refuse("it is before the present time,", s.now);
    if (to > s.scene.scene.time.end())
        refuse("it is after the end of the span,", s.scene.scene.time.end());
    const long long wanted = s.step_before(to);
    if (wanted > s.step && s.field.instant.size() == 2) {  // the next step is solved
        s.at = std::move(s.ahead);
        ++s.step;
        s.field = row_of(s.field, 1);
    }
    if (wanted > s.step) {
        s.solve(s.step, wanted, {s.instant(wanted)});
        s.at = std::move(s.ahead);
        s.step = wanted;
    }
    s.now = to;
    s.solve_ahead();
}

void Stepper::put(const std::string& object, const Eigen::Isometry3d& pose) {
    State& s = *state_;
    const std::size_t mover = s.mover(object);
    const double since = seconds_between(s.instant(s.step), s.now);
    if (since >= 0.5 * s.length()) {
        s.solve_ahead();  // with all where it was: the move counts from the next step on
    } else if (s.field.instant.size() == 2) {
        s.field = row_of(s.field, 0);  // the step in progress is solved again
        s.ahead.reset();
    }
    s.poses[mover] = pose;
    s.moved = true;
    s.here.reset();
}

void Stepper::put(const std::string& object, const Eigen::Vector2d& place, double heading_deg) {
    State& s = *state_;
    const Eigen::Vector3d ground =
        ground_point(s.dem, s.scene.world.site, place,
                     fmt::format("{}: object \"{}\"", s.scene.scene.file.string(), object));
    const Prepared& scene = s.scene;
    const ObjectInput& input =
        scene.scene.terrain.objects[scene.world.movers[s.mover(object)].object];
    Stance stance{.base = ground, .heading_deg = heading_deg};
    if (input.angles_given) {
        stance.pitch_deg = input.placing.pitch_deg;
        stance.roll_deg = input.placing.roll_deg;
    }
    stance = on_slope(input, stance, 0.0, s.dem, scene.world.site);
    Eigen::Isometry3d pose = stance.pose();
    if (stance.level()) {
        pose.linear() =
            Eigen::AngleAxisd(-radians(heading_deg), Eigen::Vector3d::UnitZ()).toRotationMatrix();
    }
    put(object, pose);
}

Eigen::Isometry3d Stepper::pose(const std::string& object) const {
    return state_->poses[state_->mover(object)];
}

std::vector<float> Stepper::temperature() {
    State& s = *state_;
    s.solve_ahead();
    return s.field.interpolate(s.now);
}

const Prepared& Stepper::prepared() const { return state_->in_place(); }

Observer Stepper::observer(const std::string& name) const {
    return state_->scene.sequences[state_->observer(name)].at(0);
}

Picture Stepper::picture(const std::string& observer, const Observer& pose) {
    State& s = *state_;
    const ObserverInput& input = s.scene.scene.observers[s.observer(observer)];
    s.solve_ahead();
    const Prepared& here = s.in_place();
    const FacetViews& views = s.stands ? s.stands->views : s.first->views;
    check_observer(pose, here.world.facets, here.rays, here.world.ground_facets,
                   here.world.objects);
    const Series series = cast_series(here, input, pose, {&s.now, 1}, views, s.field);
    return picture_at(here, series, views, s.field, s.now);
}

int Stepper::steps_solved() const { return state_->solved; }

}  // namespace diurna
