#include "scenes/job/run/audit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/run/job.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;
using Catch::Contains;

namespace {

std::string check_of(const JobReport& report) {
    const auto note = std::find_if(report.notes.begin(), report.notes.end(),
                                   [](const auto& text) { return text.starts_with(check_begins); });
    return note == report.notes.end() ? "" : *note;
}

}  // namespace

// With as many places as the run, the audit draws and solves the same ones: the error is the run's.
TEST_CASE("an audit measures the error that its run reports", "[scenes][check_points][audit]") {
    const ScratchFolder folder("audit");
    write_text(folder.path / "scene.toml", small_scene());
    const std::vector<std::string> settings{"scene.check_points=16"};
    const JobReport run = run_job(read_scene(folder.path / "scene.toml", settings),
                                  {.out = folder.path / "out", .settings = settings});

    const AuditedRun audited = audited_run(folder.path / "out");
    CHECK(audited.scene == folder.path / "scene.toml");
    CHECK(audited.settings == settings);
    const Scene scene = read_scene(audited.scene, audited.settings);
    const Audit same = audit(audited, scene, 16, ProgressStyle::silent);
    CHECK(same.same_inputs);
    CHECK(same.places <= 16);
    CHECK(same.places > 4);
    CAPTURE(check_of(run));
    CHECK_THAT(check_of(run),
               Contains(fmt::format("{:.2f} K rms (95 % interval {:.2f} to {:.2f})", same.error.rms,
                                    same.error.low, same.error.high)));
    // More places of the same pictures: another draw of the same error, more narrowly known.
    const Audit more = audit({.scene = audited.scene, .settings = {"scene.seed=2"}}, scene, 256,
                             ProgressStyle::silent);
    CHECK_FALSE(more.same_inputs);
    CHECK(more.places > 8 * same.places);
    CHECK(more.error.rms > 0.3 * same.error.rms);
    CHECK(more.error.rms < 3.0 * same.error.rms);
    CHECK(more.error.high - more.error.low < same.error.high - same.error.low);
    CHECK(more.error.worst >= more.error.percentile_99);
    const std::vector<std::string> lines = audit_lines(more);
    CHECK_THAT(lines.front(), Contains(fmt::format("{} places in ", more.places)));
}

TEST_CASE("an audit needs the folder of a complete run", "[scenes][audit][input]") {
    const ScratchFolder folder("audit-none");
    CHECK_THROWS_WITH(audited_run(folder.path / "no"), Contains("no such folder"));
    CHECK_THROWS_WITH(audited_run(folder.path), Contains("is not the folder of a complete run"));
    write_text(folder.path / "manifest.json",
               R"({"program": "diurna 0.1.0", "state": "done", "scene_file": "scene.toml",
                   "settings": ["variant v0"], "outputs": {"temperatures.nc": "0"}})");
    CHECK_THROWS_WITH(audited_run(folder.path), Contains("variant v0 of a sweep"));
    write_text(folder.path / "manifest.json",
               R"({"program": "diurna 0.1.0", "state": "done", "scene_file": "scene.toml",
                   "settings": [], "outputs": {"report.html": "0"}})");
    CHECK_THROWS_WITH(audited_run(folder.path), Contains("temperatures of another file"));
}
