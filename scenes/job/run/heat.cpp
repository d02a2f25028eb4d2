#include "scenes/job/run/heat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "scenes/job/run/check_error.hpp"
#include "scenes/job/run/check_points.hpp"
#include "scenes/job/run/needed_facets.hpp"
#include "scenes/job/run/stage_heat.hpp"
#include "scenes/job/run/state_owner.hpp"
#include "scenes/job/store/heat_inputs.hpp"
#include "scenes/job/world/stepping.hpp"
#include "terrain/place/local_time.hpp"
#include "thermal/solve/heat_state_file.hpp"
#include "thermal/solve/start_error.hpp"

namespace diurna {

namespace {

/// Seconds on the clock that calls take.
class Stopwatch {
 public:
    template <class Call>
    auto during(const Call& call) {
        const auto begun = std::chrono::steady_clock::now();
        auto result = call();
        seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
        return result;
    }
    double seconds() const { return seconds_; }

 private:
    double seconds_ = 0.0;
};

/// What a file of state holds; mistakes are reported with their place in the scene file.
TimedState loaded_state(const Prepared& prepared) {
    const TimeInput& time = prepared.scene.time;
    try {
        return load_heat_state(time.state,
                               state_owner(prepared.world.surfaces(), prepared.scene.materials));
    } catch (const InputError& error) {
        const Mistake& found = error.mistakes().front();
        throw InputError(time.state_where,
                         fmt::format("{}: {}; expected the state.nc of an earlier run of this "
                                     "scene with output.state = true",
                                     found.where, found.problem),
                         found.hint);
    }
}

/// The state that the scene goes on from: of the same facets, at the span's start.
std::optional<HeatState> earlier_state(const Prepared& prepared) {
    const TimeInput& time = prepared.scene.time;
    if (time.spin_up != SpanStart::state) return std::nullopt;
    TimedState timed = loaded_state(prepared);
    if (timed.instant != time.start) {
        throw InputError(
            time.state_where,
            fmt::format(
                "found the state at {} in {}, expected the state at the start of the span, {}",
                format_local(timed.instant, time.utc_offset), time.state.string(),
                format_local(time.start, time.utc_offset)));
    }
    return std::move(timed.state);
}

/// The effect of the start, in one line.
std::string start_reported(const SolveInput& input, const SpanOptions& span,
                           const SpanResult& result) {
    const SolveReport& report = result.report;
    if (span.begin == SpanStart::state) return "continues from the saved state of an earlier run";
    std::string line;
    if (report.periodic_residual > 0.0 && !result.repeated) {
        line = fmt::format("periodic solution not converged: residual {:.1e} K (limit {:.0e} K); ",
                           std::max(report.periodic_residual, report.target_residual),
                           span.day.tolerance);
    } else if (report.periodic_residual > 0.0) {
        line = fmt::format("periodic to {:.1e} K; ", result.repeated_error);
    }
    if (report.stores_held > 0) {
        line += fmt::format(
            "hoar or snow changes by up to {:.2g} mm from day to day on {} {}: the start is the "
            "state after eight such days; ",
            report.store_growth, report.stores_held, report.stores_held == 1 ? "facet" : "facets");
    }
    if (report.alternating > 0) {
        line += fmt::format(
            "{} {} no periodic solution: successive days alternate by up to {:.2g} K below the "
            "surface ({}), and their mean is used; ",
            report.alternating, report.alternating == 1 ? "facet has" : "facets have",
            report.alternation, report.alternating_facet);
    }
    return line + reported(measure_start(input, span));
}

/// Names and clock of a scene, for its file of temperatures.
FieldNotes field_notes(const Prepared& prepared, const std::vector<RunInput>& inputs,
                       const HeatFluxField& fluxes) {
    FieldNotes notes{.objects = prepared.world.objects,
                     .utc_offset = prepared.scene.time.utc_offset,
                     .fluxes = prepared.scene.output.fluxes && !fluxes.empty() ? &fluxes : nullptr,
                     .made_of = heat_made_of(prepared.scene, inputs)};
    const MaterialLibrary& materials = prepared.scene.materials;
    for (std::size_t i = 0; i < materials.size(); ++i) {
        notes.materials.push_back(materials[MaterialId(i)].kind());
    }
    return notes;
}

}  // namespace

std::string not_converged(const SolveReport& report) {
    if (report.converged) return "";
    if (!report.unsolved.empty()) return "the heat balance failed: " + report.unsolved;
    std::string reported = fmt::format(
        "the heat balance has not converged in {} passes: estimated error {:.1e} K (limit {:.2g} "
        "K), residual of the periodic day {:.1e} K{}{}; a shorter time.step_s or a longer weather "
        "record before the start may help",
        report.passes, report.estimated_error, report.limit, report.periodic_residual,
        report.furthest.empty() ? "" : ", largest at ", report.furthest);
    // What changed to the last, of passes that wait for one another.
    if (report.light_change > 0.05) {
        reported += fmt::format(
            "; reflected light of wet or snow-covered facets still changes by {:.1g} W/m2",
            report.light_change);
    }
    if (report.target_residual > report.limit) {
        reported +=
            fmt::format("; residual of the targets' periodic day {:.1g} K", report.target_residual);
    }
    return reported;
}

void check_start(const Prepared& prepared) { earlier_state(prepared); }

bool can_check(const Prepared& prepared) {
    return !prepared.scene.output.state && prepared.scene.time.spin_up != SpanStart::state;
}

namespace {

/// The span of representative facets, and of check points beside them.
SolvedScene solve_needed(std::span<const SpanStage> spans, const SpanOptions& options,
                         const Representatives& who, const Stages& stages,
                         const CheckPoints& points, Stopwatch& checking) {
    std::vector<std::unique_ptr<SolvedPart>> part;
    std::vector<SpanStage> solved;
    for (std::size_t i = 0; i < spans.size(); ++i) {
        const SpanStage& span = spans[i];
        const Prepared& scene = stages.at(i).prepared;
        const BesideFacets patches = checking.during([&] { return patches_at(points, scene); });
        part.push_back(std::make_unique<SolvedPart>(span.input, who, patches));
        solved.push_back(
            {span.from, part.back()->input(),
             [&](const std::vector<Instant>& when) {
                 return with_beside(span.exposure(when), who.solved.size(), checking.during([&] {
                     return points.point.empty() ? SunExposure{} : sun_at(points, scene, when);
                 }));
             },
             span.early});
    }
    SolvedScene result{solve_span(solved, options)};
    const std::size_t facets = who.solved.size(), beside = points.like.size();
    std::vector<float> patches;
    for (std::size_t i = 0; beside > 0 && i < result.temperature.instant.size(); ++i) {
        const std::span<const float> row = result.temperature.at(i).subspan(facets);
        patches.insert(patches.end(), row.begin(), row.end());
    }
    spread(who, result, beside);
    if (beside > 0) {
        result.check = checking.during(
            [&] { return check_error(stages, points, result.temperature, patches); });
        result.places = points.point.size();
        result.notes.push_back(in_words(result.check, points, stages.scene().scene.tolerance));
    }
    return result;
}

std::string reported(const NeededFacets& needed, const TemperatureField& field) {
    const double apart = probed_difference(needed, field), worth = apart * needed.weight;
    constexpr double least_reported = 5e-4;  // [K] about what the balance itself leaves open
    return fmt::format(
        "solved: {} of {} facets ({} visible facets and their neighbours, {} thermally coupled to "
        "them, {} representative facets); check on {} other facets: the representative's "
        "temperature differs by {:.2f} K (rms), which changes the pictures by {}",
        needed.who.solved.size(), needed.who.place.size(), needed.seen, needed.coupled,
        needed.kinds, needed.probe.size(), apart,
        worth < least_reported ? fmt::format("less than {:.0e} K", least_reported)
                               : fmt::format("{:.1e} K", worth));
}

}  // namespace

SolvedScene solve_scene(const Stages& stages, Progress& progress, const HeatDecision& decision,
                        const SimilarSolves& similar) {
    const Prepared& scene = stages.scene();
    const std::optional<HeatState> earlier = earlier_state(scene);
    progress.stage(StageId::heat_balance);
    SpanOptions span = scene_span(scene.scene);
    span.from = earlier ? &*earlier : nullptr;
    span.keep_course = similar.keep_course;
    span.like = similar.like;
    span.until = similar.until;
    if (similar.start) {
        span.begin = SpanStart::state;
        span.from = similar.start;
    }
    span.day.progress = [&](double share) { progress.done(share); };
    span.day.tell = [&](const std::string& doing) { progress.doing(doing); };
    std::vector<std::unique_ptr<StageHeat>> heat;
    std::vector<SpanStage> parts;
    Stopwatch further_views, checking;
    for (std::size_t i = 0; i < stages.size(); ++i) {
        const SceneStage stage = further_views.during([&] { return stages.at(i); });
        StageHeat* const own =
            heat.emplace_back(std::make_unique<StageHeat>(stage, span.end)).get();
        parts.push_back({i == 0 ? span.start : scene.movement.stage[i], own->input(),
                         [own](const std::vector<Instant>& when) { return own->exposure(when); },
                         i > 0 && scene.movement.early[i]});
    }
    const StageHeat& first = *heat.front();
    // Balances are reported to be closed; what targets lose, and what moving objects leave behind,
    // is followed step by step.
    if (decision.every_facet.empty() && !span.heat && first.input().network.empty() &&
        scene.movement.none()) {
        span.day = quick(span.day, decision.tolerance);
    }
    std::optional<NeededFacets> needed;
    if (decision.every_facet.empty()) {
        needed = needed_facets(stages, first.input().network, decision.tolerance);
        for (const auto& own : heat) own->ask_for(needed->who.solved);
    }
    CheckPoints points;
    if (decision.check_points > 0 && can_check(scene)) {
        points = check_points(stages, first.input().network, decision.check_points);
    }
    const bool whole_scene = !needed && points.point.empty();
    SolvedScene result =
        whole_scene ? SolvedScene{solve_span(parts, span)}
                    : solve_needed(parts, span,
                                   needed ? needed->who
                                          : all_represent_themselves(scene.world.surfaces().size()),
                                   stages, points, checking);
    result.unchecked = points.skipped;
    if (points.point.empty() && points.skipped > 0) {
        result.notes.push_back(in_words(CheckError{}, points, scene.scene.tolerance));
    }
    if (needed) {
        result.temperature.representative_rms =
            std::max(probed_difference(*needed, result.temperature),
                     represented_difference(*needed, result.temperature));
        result.notes.push_back(reported(*needed, result.temperature));
    } else if (scene.scene.tolerance_given && scene.scene.tolerance > 0.0) {
        result.notes.push_back("solved: all facets; tolerance_K is not used: " +
                               decision.every_facet);
    }
    span.until.reset();
    result.start += ": " + start_reported(first.input(), span, result);
    for (std::string& note : first.reported(result.report)) {
        result.notes.push_back(std::move(note));
    }
    double shadows = 0.0;
    for (const auto& own : heat) shadows += own->shadow_seconds();
    if (stages.size() > 1) progress.set_apart(StageId::sky_view, further_views.seconds());
    progress.set_apart(StageId::shadows, shadows);
    if (!points.point.empty()) progress.set_apart(StageId::surface_check, checking.seconds());
    return result;
}

void write_heat(const Prepared& prepared, const std::vector<RunInput>& inputs,
                const SpanResult& result, const std::filesystem::path& temperatures) {
    const FacetSet& surfaces = prepared.world.surfaces();
    const FieldNotes notes = field_notes(prepared, inputs, result.heat);
    const Site& site = prepared.world.site;
    if (prepared.movement.none()) {
        save_temperature_field(temperatures, result.temperature, surfaces, site, notes);
    } else {  // where objects that go are at the span's start
        save_temperature_field(temperatures, result.temperature,
                               moved(prepared.world, surfaces, prepared.movement.at_stage.front()),
                               site, notes);
    }
    if (!prepared.scene.output.state) return;
    save_heat_state(temperatures.parent_path() / state_file,
                    {prepared.scene.time.end(), result.end},
                    state_owner(surfaces, prepared.scene.materials));
}

}  // namespace diurna
