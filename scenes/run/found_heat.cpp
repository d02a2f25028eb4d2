#include "scenes/run/found_heat.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>

#include "scenes/cache/digest.hpp"
#include "scenes/cache/stage_bytes.hpp"
#include "scenes/cache/stage_keys.hpp"
#include "scenes/report/report.hpp"
#include "scenes/run/check_error.hpp"
#include "scenes/run/heat.hpp"
#include "scenes/world/stepping.hpp"

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
    some.kelvin.reserve(wanted.size() * field.facets);
    for (const Instant when : wanted) {
        const auto at = std::lower_bound(field.instant.begin(), field.instant.end(), when);
        if (at == field.instant.end() || *at != when) return std::nullopt;
        const auto row = std::as_const(field).at(std::size_t(at - field.instant.begin()));
        some.kelvin.insert(some.kelvin.end(), row.begin(), row.end());
    }
    return some;
}

constexpr const char* pictures_key = "pictures";  // that points were drawn in
constexpr const char* facets_row = "row facets' sizes and rays";

Messages messages_of(const Scene& scene, const SpanResult& result) {
    Messages messages{{"not converged", not_converged(result.report)}, {"start", result.start}};
    for (const std::string& note : result.notes) {
        messages.emplace_back("note", note);
        if (!note.starts_with(check_begins)) continue;
        messages.emplace_back(pictures_key, sha256(scene.said));
        messages.emplace_back(facets_row, note.substr(std::string(check_begins).size() + 1));
    }
    for (const auto& [name, value] : heat_rows(result.report)) {
        messages.emplace_back("row " + name, value);
    }
    return messages;
}

/// An error that was measured in other pictures is not reported of these.
void drop_error_of_others(const Scene& scene, Messages& messages) {
    const std::pair<std::string, std::string> these{pictures_key, sha256(scene.said)};
    if (std::find(messages.begin(), messages.end(), these) != messages.end()) return;
    const std::string instead =
        "not measured in these pictures: temperatures are from the cache, checked in an earlier "
        "run's pictures (--fresh solves and checks again)";
    for (auto& [name, text] : messages) {
        if (name == facets_row) text = instead;
        if (name == "note" && text.starts_with(check_begins)) {
            text = fmt::format("{} {}", check_begins, instead);
        }
    }
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
        if (auto field = at_instants(wanted, std::move(found.temperature))) {
            store->note_taken(stage);
            drop_error_of_others(prepared.scene, found.reported);
            return {.result = {.temperature = std::move(*field), .report = {}, .start = {}},
                    .solved = false,
                    .reported = std::move(found.reported)};
        }
    }
    const auto begun = std::chrono::steady_clock::now();
    SceneHeat heat{.result = solve_scene(stages, progress, decision), .reported = {}};
    heat.reported = messages_of(prepared.scene, heat.result);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    if (store != nullptr && heat.result.report.converged && store->keeps(took.count())) {
        store->keep(stage, key, bytes_of(FoundHeat{heat.result.temperature, heat.reported}));
    }
    return heat;
}

std::vector<std::string> reported_as(const std::string& name, const SceneHeat& heat) {
    std::vector<std::string> texts;
    for (const auto& [of, text] : heat.reported) {
        if (of == name) texts.push_back(text);
    }
    return texts;
}

}  // namespace diurna
