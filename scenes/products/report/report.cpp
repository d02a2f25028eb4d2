#include "scenes/products/report/report.hpp"

#include <fmt/format.h>

#include "materials/atmosphere/band_model.hpp"
#include "materials/base/files.hpp"
#include "materials/base/made_by.hpp"
#include "scenes/charts/clock_names.hpp"
#include "scenes/charts/html.hpp"
#include "scenes/job/input/bands.hpp"
#include "scenes/job/store/digest.hpp"
#include "scenes/products/report/contact_sheet.hpp"
#include "scenes/products/report/courses.hpp"
#include "scenes/products/report/heat_terms.hpp"
#include "scenes/products/report/instrument_sheet.hpp"
#include "scenes/products/report/page.hpp"
#include "scenes/products/report/picture_series.hpp"
#include "scenes/products/report/run_tables.hpp"
#include "scenes/products/report/study_plots.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

/// "2026-07-15T05:00:00-04:00 (03:17 solar)"
std::string when(const Prepared& prepared, Instant instant) {
    return fmt::format("{} ({} solar)", format_local(instant, prepared.scene.time.utc_offset),
                       format_solar_time(prepared.world.site, instant));
}

/// Of the pictures of an observer, those that a page has room for, the first and the last too.
constexpr std::size_t most_shown = 96;
std::vector<Instant> some_of(const std::vector<Instant>& frames) {
    if (frames.size() <= most_shown) return frames;
    std::vector<Instant> some;
    for (std::size_t i = 0; i < most_shown; ++i) {
        some.push_back(frames[i * (frames.size() - 1) / (most_shown - 1)]);
    }
    return some;
}

/// Every observer's bands, and what instruments display of them.
std::string pictures(const fs::path& folder, const Prepared& prepared) {
    std::string html;
    std::size_t number = 0;
    for (const ObserverInput& observer : prepared.scene.observers) {
        const std::vector<Instant> frames = some_of(observer.frames);
        if (frames.empty()) continue;
        if (frames.size() < observer.frames.size()) {
            html += fmt::format("<p>{} of {} pictures of {}, at equal intervals:</p>\n",
                                frames.size(), observer.frames.size(), escaped(observer.name));
        }
        for (const std::string& band : observer.bands) {
            html += picture_series(
                contact_sheet(folder, observer.name,
                              named_band(prepared.scene.bands, band, bin_edges_um()), frames),
                prepared, ++number);
            for (const InstrumentInput& input : prepared.scene.instruments) {
                if (input.observer != observer.name || input.band != band) continue;
                html += picture_series(
                    instrument_sheet(folder, observer.name, band, input.instrument.name, frames),
                    prepared, ++number);
            }
        }
    }
    return html;
}

}  // namespace

void write_report(const fs::path& folder, const Prepared& prepared, const JobReport& report,
                  const TemperatureField& field) {
    struct Chapter {
        const char *id, *name;
        std::string html;
    };
    const std::vector<Chapter> sections = {
        {"computed", "What was computed",
         "<h2>What was computed</h2>\n" + facts_table(prepared, report)},
        {"pictures", "Pictures", "<h2>Pictures</h2>\n" + pictures(folder, prepared)},
        {"courses", "Temperatures", courses(prepared, field)},
        {"heat", "Heat balance", heat_terms_of_day(folder, prepared, field)},
        {"studies", "Studies", study_plots(folder, sha256(prepared.scene.said_but_for_pictures))},
        {"errors", "Errors", "<h2>Known errors</h2>\n" + errors_table(prepared, report)},
        {"time", "Time", "<h2>Time of this run</h2>\n" + timings_table(report)},
        {"plan", "Plan", "<h2>Plan: computed and skipped</h2>\n" + decisions_table(report.plan)},
        {"notes", "Notes", "<h2>Notes</h2>\n" + notes_list(report)},
        {"inputs", "Inputs", "<h2>Inputs</h2>\n" + inputs_table(report)}};
    std::vector<std::pair<std::string, std::string>> links;
    for (const Chapter& section : sections) {
        if (!section.html.empty()) links.emplace_back(section.id, section.name);
    }
    std::string html = page_begin(prepared.scene.title, links);
    html += fmt::format(
        "<p class=\"key\"><span title=\"{}\">{}</span>, scene {}, {} to {}; clock times are {}; "
        "solar time is 12:00 at true noon</p>\n",
        escaped(made_with()), made_by(), escaped(prepared.scene.file.filename().string()),
        when(prepared, report.plan.steps.front()), when(prepared, report.plan.steps.back()),
        clock_zone(prepared.scene.time.utc_offset));
    for (const Chapter& section : sections) {
        if (section.html.empty()) continue;
        html += fmt::format("<section id=\"{}\">{}</section>\n", section.id, section.html);
    }
    write_whole_file(folder / "report.html", html + page_end());
}

}  // namespace diurna
