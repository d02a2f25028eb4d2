#include "scenes/job/run/heat_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scenes/job/run/check_error.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/store/heat_key.hpp"

namespace diurna {

namespace {

constexpr const char* facets_row = "facets' sizes and rays";
constexpr const char* begin_of_row = "row ";

std::vector<std::pair<std::string, std::string>> rows_of(const SolveReport& solve) {
    return {
        {"heat balance",
         fmt::format("{} steps, {} passes; periodic to {:.1e} K (estimated error {:.1e} K)",
                     solve.steps, solve.passes, solve.periodic_residual, solve.estimated_error)},
        {"worst energy closure", fmt::format("{:.1e} of the heat exchanged, worst facet and step",
                                             solve.worst_energy_closure)},
        {"Newton iterations", fmt::format("{:.2f} per stage, at most {}", solve.newton_iterations,
                                          solve.worst_newton_iterations)}};
}

}  // namespace

HeatReport heat_report(const Prepared& prepared, const SpanResult& result) {
    HeatReport report{.not_converged = not_converged(result.report),
                      .start = result.start,
                      .notes = result.notes};
    for (const std::string& note : result.notes) {
        if (!note.starts_with(check_begins)) continue;
        report.checked_in = pictures_key(prepared);
        report.rows.emplace_back(facets_row, note.substr(std::string(check_begins).size() + 1));
    }
    const auto rows = rows_of(result.report);
    report.rows.insert(report.rows.end(), rows.begin(), rows.end());
    return report;
}

void drop_check_of_others(const Prepared& prepared, HeatReport& report) {
    if (report.checked_in == pictures_key(prepared)) return;
    report.next = {};
    const std::string instead =
        "not measured in these pictures: temperatures are from the cache, checked in an earlier "
        "run's pictures (--fresh solves and checks again)";
    for (auto& [name, text] : report.rows) {
        if (name == facets_row) text = instead;
    }
    for (std::string& note : report.notes) {
        if (note.starts_with(check_begins)) note = fmt::format("{} {}", check_begins, instead);
    }
}

Messages as_messages(const HeatReport& report) {
    Messages messages{{"not converged", report.not_converged}, {"start", report.start}};
    if (!report.checked_in.empty()) messages.emplace_back("pictures", report.checked_in);
    if (!report.next.settings.empty()) messages.emplace_back("missed", report.next.missed);
    for (const std::string& set : report.next.settings) messages.emplace_back("finer", set);
    for (const std::string& note : report.notes) messages.emplace_back("note", note);
    for (const auto& [name, value] : report.rows) {
        messages.emplace_back(begin_of_row + name, value);
    }
    return messages;
}

HeatReport heat_report_of(const Messages& messages) {
    HeatReport report;
    for (const auto& [name, text] : messages) {
        if (name == "not converged") report.not_converged = text;
        if (name == "start") report.start = text;
        if (name == "pictures") report.checked_in = text;
        if (name == "missed") report.next.missed = text;
        if (name == "finer") report.next.settings.push_back(text);
        if (name == "note") report.notes.push_back(text);
        if (name.starts_with(begin_of_row)) {
            report.rows.emplace_back(name.substr(std::string(begin_of_row).size()), text);
        }
    }
    return report;
}

}  // namespace diurna
