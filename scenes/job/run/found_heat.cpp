#include "scenes/job/run/found_heat.hpp"

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "scenes/job/run/heat.hpp"
#include "scenes/job/store/heat_key.hpp"
#include "scenes/job/store/stage_bytes.hpp"
#include "scenes/job/world/stepping.hpp"

namespace diurna {

namespace {

constexpr const char* stage = "heat";

/// Some of its instants; nothing where one is not there. Of water on facets all or nothing, for
/// which facets are named goes by the instants.
std::optional<TemperatureField> at_instants(const std::vector<Instant>& wanted,
                                            TemperatureField field) {
    if (field.instant == wanted) return field;
    if (!field.water.empty()) return std::nullopt;
    TemperatureField some{.instant = wanted, .facets = field.facets, .kelvin = {}};
    some.solved_as = std::move(field.solved_as);
    some.representative_rms = field.representative_rms;
    some.kelvin.reserve(wanted.size() * field.facets);
    for (const Instant when : wanted) {
        const auto at = std::lower_bound(field.instant.begin(), field.instant.end(), when);
        if (at == field.instant.end() || *at != when) return std::nullopt;
        const auto row = std::as_const(field).at(std::size_t(at - field.instant.begin()));
        some.kelvin.insert(some.kelvin.end(), row.begin(), row.end());
    }
    return some;
}

}  // namespace

SceneHeat scene_heat(const Stages& stages, const std::vector<RunInput>& inputs, Progress& progress,
                     const HeatDecision& decision) {
    const Prepared& prepared = stages.scene();
    const OutputInput& output = prepared.scene.output;
    const bool kept_whole = !output.state && !output.fluxes && prepared.radiometers.empty();
    const StageStore* store = kept_whole ? stages.store() : nullptr;
    const std::string key = store == nullptr ? "" : heat_key(prepared, inputs, decision.tolerance);
    if (const auto bytes = store == nullptr ? std::nullopt : store->find(stage, key)) {
        FoundHeat found = heat_of(*bytes);
        const std::vector<Instant> wanted = scene_span(prepared.scene).wanted;
        HeatReport report = heat_report_of(found.reported);
        // Rounds follow from places in these pictures, with the cache or without.
        const bool checked =
            prepared.plan.decisions.rounds == 0 || report.checked_in == pictures_key(prepared);
        auto field = checked ? at_instants(wanted, std::move(found.temperature)) : std::nullopt;
        if (field) {
            store->note_taken(stage, key);
            drop_check_of_others(prepared, report);
            return {.result = {.temperature = std::move(*field), .report = {}, .start = {}},
                    .solved = false,
                    .report = std::move(report)};
        }
    }
    const auto begun = std::chrono::steady_clock::now();
    SolvedScene solved = solve_scene(stages, progress, decision);
    HeatReport report = heat_report(prepared, solved);
    report.next = round_after(solved.check, prepared.scene);
    SceneHeat heat{.result = std::move(solved), .report = std::move(report)};
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    if (store != nullptr && heat.result.report.converged && store->keeps(took.count())) {
        FoundHeat found{std::move(heat.result.temperature), as_messages(heat.report)};
        store->keep(stage, key, content_of(found));
        heat.result.temperature = std::move(found.temperature);
    }
    return heat;
}

}  // namespace diurna
