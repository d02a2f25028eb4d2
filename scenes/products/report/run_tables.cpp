#include "scenes/products/report/run_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "materials/base/parallel.hpp"
#include "scenes/charts/html.hpp"
#include "scenes/job/plan/plan_text.hpp"
#include "scenes/products/report/page.hpp"

namespace diurna {

namespace {

std::string table_row(const std::string& key, const std::string& value) {
    return "<tr><td class=\"key\">" + key + "</td><td>" + value + "</td></tr>\n";
}

/// The planned stage that one of the run belongs to.
StageId planned_as(StageId stage) { return stage == StageId::labels ? StageId::report : stage; }

struct TimeRow {
    std::string name;
    double planned = -1.0, taken = -1.0;  // [s]; below 0: none
    double rays = 0.0;                    // at most
};

std::string timed(const TimeRow& of) {
    const auto seconds = [](double s) { return s < 0.0 ? "" : fmt::format("{:.2f}", s); };
    return fmt::format(
        "<tr><td>{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td><td class=\"n\">{}</td>"
        "<td class=\"n\">{}</td></tr>\n",
        escaped(of.name), seconds(of.planned), of.taken < 0.0 ? "not run" : seconds(of.taken),
        of.rays > 0.0 ? fmt::format("{:.3g}", of.rays) : "",
        of.rays > 0.0 && of.taken > 0.0 ? fmt::format("{:.1f}", of.rays / of.taken / 1e6) : "");
}

/// What the plan has names for, then what it has none for.
std::vector<TimeRow> time_rows(const JobReport& report) {
    std::vector<TimeRow> rows;
    std::set<StageId> reported;
    for (const PlannedStage& planned : report.plan.stages) {
        TimeRow one{.name = name_of(planned.stage), .planned = planned.seconds};
        if (planned.stage == StageId::sky_view) one.rays = double(report.plan.sky_rays);
        if (planned.stage == StageId::shadows) one.rays = double(report.plan.sun_rays);
        if (planned.stage == StageId::views) one.rays = double(report.plan.view_rays);
        if (planned.stage == StageId::report) one.name = "labels and this page (not measured)";
        for (const Progress::Stage& stage : report.stages) {
            if (planned_as(stage.id) != planned.stage) continue;
            one.taken = std::max(0.0, one.taken) + stage.seconds;
        }
        reported.insert(planned.stage);
        rows.push_back(std::move(one));
    }
    for (const Progress::Stage& stage : report.stages) {
        if (!reported.contains(planned_as(stage.id)))
            rows.push_back({.name = stage.name, .taken = stage.seconds});
    }
    return rows;
}

}  // namespace

std::string facts_table(const Prepared& prepared, const JobReport& report) {
    const Plan& plan = report.plan;
    const Site& site = prepared.world.site;
    std::string out = "<table class=\"facts\">\n";
    out += table_row(
        "place",
        fmt::format("{:.5f}° {}, {:.5f}° {}, {:.0f} m above the sea", std::abs(site.latitude_deg),
                    site.latitude_deg < 0.0 ? 'S' : 'N', std::abs(site.longitude_deg),
                    site.longitude_deg < 0.0 ? 'W' : 'E', prepared.world.sea_level_height));
    out += table_row("facets", fmt::format("{} ({} of the ground, from {} posts)", plan.facets,
                                           prepared.world.ground_facets, report.posts));
    out += table_row("pictures", picture_counts(plan));
    if (!report.not_converged.empty()) {
        out += table_row("<strong>not converged</strong>", escaped(report.not_converged));
    }
    if (!report.start.empty()) out += table_row("start of the heat balance", escaped(report.start));
    return out + "</table>\n";
}

std::string errors_table(const Prepared& prepared, const JobReport& report) {
    std::string out = "<table class=\"facts\">\n";
    out += table_row("vertical error of the mesh",
                     fmt::format("{:.3f} m at the worst post, rms {:.3f} m, limit {:g} m",
                                 report.ground_check.worst_error, report.ground_check.rms_error,
                                 prepared.scene.terrain.elevation.tolerance));
    for (const auto& [key, value] : report.heat) out += table_row(escaped(key), escaped(value));
    for (const PlanRow& row : plan_rows(report.plan)) {
        if (!(row.error > 0.0)) continue;
        out += table_row(escaped(row.what), fmt::format("{:g} {}: {}", row.error,
                                                        escaped(row.error_unit), escaped(row.why)));
    }
    return out +
           "</table>\n<p class=\"key\">These errors are of different kinds and do not add up. The "
           "error from the time step is not estimated in a run; the notes give limits for omitted "
           "effects.</p>\n";
}

std::string timings_table(const JobReport& report) {
    std::string out =
        "<table class=\"figures\">\n<tr><th>stage</th><th class=\"n\">planned, s</th><th "
        "class=\"n\">taken, s</th>"
        "<th class=\"n\">rays (upper limit)</th><th class=\"n\">million rays per "
        "second</th></tr>\n";
    double taken = 0.0;
    for (const Progress::Stage& stage : report.stages) taken += stage.seconds;
    for (const TimeRow& one : time_rows(report)) out += timed(one);
    return wide(out + fmt::format("<tr><th>all, {} threads</th><th class=\"n\">{:.2f}</th>"
                                  "<th class=\"n\">{:.2f}</th></tr></table>",
                                  thread_count(), report.plan.seconds, taken));
}

std::string decisions_table(const Plan& plan) {
    std::string out =
        "<table class=\"stack\">\n<tr><th></th><th>what</th><th>why</th><th>error</th></tr>\n";
    for (const PlanRow& row : plan_rows(plan)) {
        out += fmt::format(
            "<tr><td>{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
            row.computed ? "computed" : "<strong>skipped</strong>", escaped(row.what),
            escaped(row.why),
            row.error > 0.0 ? fmt::format("{:g} {}", row.error, escaped(row.error_unit)) : "none");
    }
    return out + "</table>\n";
}

std::string notes_list(const JobReport& report) {
    std::string out = "<ul>\n";
    for (const std::string& line : report.warnings) {
        out += "<li><strong>warning</strong> " + escaped(line) + "</li>\n";
    }
    for (const std::string& note : report.notes) out += "<li>" + escaped(note) + "</li>\n";
    return out + "</ul>\n";
}

std::string inputs_table(const JobReport& report) {
    std::string own, program;
    for (const JobInput& input : report.inputs) {
        std::string& rows = input.name.starts_with("data/") ? program : own;
        rows += fmt::format("<tr><td>{}<br><span class=\"hash\">{}</span></td></tr>\n",
                            escaped(input.name), escaped(input.sha256));
    }
    std::string out =
        "<p class=\"key\">Each with the SHA-256 of its contents. The same files and settings give "
        "the same results.</p>\n<table class=\"facts\">\n" +
        own +
        "</table>\n<details><summary>Data of the program</summary>\n<table class=\"facts\">\n" +
        program + "</table></details>\n";
    if (!report.settings.empty()) {
        out += "<p>Settings of the command line and of rounds:</p>\n<ul>\n";
        for (const std::string& setting : report.settings) {
            out += "<li>" + escaped(setting) + "</li>\n";
        }
        out += "</ul>\n";
    }
    return out;
}

}  // namespace diurna
