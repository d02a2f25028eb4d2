#include "scenes/job/run/represented.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/run/heat.hpp"
#include "scenes/job/run/needed_facets.hpp"
#include "scenes/job/run/picture_shares.hpp"
#include "scenes/products/export/run_heat.hpp"
#include "scenes/products/export/vtu_file.hpp"
#include "scenes/studies/contrast_study.hpp"
#include "scenes/studies/signature_study.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

// Temperatures of a run that solved only the facets that its pictures need, in studies. The truth
// is the same study with every facet solved.

namespace {

/// Valley and escarpment on some thousands of facets; a study of the runway from the east, and one
/// of the hangar from all sides, also those that no picture shows.
std::string valley_studies() {
    return "tolerance_K = 0.1\n" + with(small_scene(), "tolerance_m = 10.0", "tolerance_m = 3.0") +
           R"(
[[contrast]]
name = "strip"
observers = ["east"]
targets = ["runway"]
bands = ["8-12"]
[[signature]]
name = "sides"
object = "hangar"
bands = ["8-12"]
directions = 42
pixels = 32
samples = 4
frames = ["2026-07-15T06:00:00-04:00", "2026-07-15T12:00:00-04:00"]
)";
}

/// Numbers of a column of a table.
std::vector<double> column_of(const std::string& csv, const std::string& name) {
    std::vector<double> values;
    std::size_t place = 0, row = 0;
    for (std::size_t from = 0; from < csv.size();) {
        const std::size_t end = std::min(csv.find('\n', from), csv.size());
        const std::string line = csv.substr(from, end - from);
        std::vector<std::string> cell{""};
        for (const char c : line) {
            if (c == ',') {
                cell.emplace_back();
            } else {
                cell.back() += c;
            }
        }
        if (row++ == 0) {
            const auto found = std::find(cell.begin(), cell.end(), name);
            REQUIRE(found != cell.end());
            place = static_cast<std::size_t>(found - cell.begin());
        } else if (place < cell.size() && !cell[place].empty()) {
            values.push_back(std::stod(cell[place]));
        }
        from = end + 1;
    }
    return values;
}

bool noted(const std::vector<std::string>& notes, const std::string& part) {
    return std::any_of(notes.begin(), notes.end(),
                       [&](const std::string& note) { return note.find(part) != note.npos; });
}

}  // namespace

TEST_CASE("studies use temperatures of a partial solution within the tolerance",
          "[scenes][needed][by_variation]") {
    const ScratchFolder folder("represented");
    const auto file = folder.path / "scene.toml", whole = folder.path / "whole.nc",
               partial = folder.path / "temperatures.nc";
    write_text(file, valley_studies());
    const Prepared prepared = prepare(read_scene(file));
    const Stages stages(prepared);
    Progress silent(ProgressStyle::silent);
    const std::vector<RunInput> inputs = run_inputs(prepared.scene);
    write_heat(prepared, inputs, solve_scene(stages, silent), whole);
    write_heat(prepared, inputs, solve_scene(stages, silent, {.every_facet = "", .tolerance = 0.1}),
               partial);

    const TemperatureField field = load_temperature_field(partial);
    REQUIRE_FALSE(field.solved_as.empty());
    CHECK(field.representative_rms > 0.01);
    const RepresentedEffect own = represented_effect(stages, field, picture_shares(stages));
    CHECK(own.shown == 0.0);
    CHECK(own.measured);
    CHECK(own.within(0.1));

    const StudyRequest from_whole{.scene = file, .temperatures = whole};
    const StudyRequest from_partial{.scene = file, .temperatures = partial};
    const StudyFindings a = contrast_study(from_whole), b = contrast_study(from_partial);
    CHECK(noted(b.notes, "all visible facets are solved"));
    CHECK_FALSE(noted(b.notes, "solved instead"));
    for (const char* name : {"rss_K", "difference_K", "spread_K"}) {
        const std::vector<double> expected = column_of(a.finding.front().texts.csv, name),
                                  found = column_of(b.finding.front().texts.csv, name);
        REQUIRE(found.size() == expected.size());
        REQUIRE_FALSE(found.empty());
        for (std::size_t i = 0; i < found.size(); ++i) {
            CHECK(std::abs(found[i] - expected[i]) < 0.1);
        }
    }

    SECTION("a study of what the pictures do not show solves all facets itself") {
        const StudyFindings sides = signature_study(from_whole),
                            again = signature_study(from_partial);
        CHECK(noted(again.notes, "all facets were solved instead"));
        CHECK(again.finding.front().texts.csv == sides.finding.front().texts.csv);
    }
    SECTION("with tolerance_K = 0 no representative is accepted where it changes a picture") {
        StudyRequest exact = from_partial;
        exact.settings = {"tolerance_K=0"};
        StudyRequest expected = from_whole;
        expected.settings = exact.settings;
        const StudyFindings of = contrast_study(exact);
        CHECK(noted(of.notes, "all facets were solved instead"));
        CHECK(of.finding.front().texts.csv == contrast_study(expected).finding.front().texts.csv);
    }
    SECTION("export says which facets have a representative's temperature") {
        const RunHeat heat = load_run_heat(folder.path);
        CHECK(represented_note(heat).find("have a representative's temperature") !=
              std::string::npos);
        CHECK(vtu_text(heat, heat_at(heat, heat.field.instant.front())).find("solved_as") !=
              std::string::npos);
    }
}
