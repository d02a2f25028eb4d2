#include "scenes/run/needed_facets.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>

#include "render/picture/exr.hpp"
#include "scenes/input/scene_file.hpp"
#include "scenes/plan/frame_files.hpp"
#include "scenes/run/frames.hpp"
#include "scenes/run/heat.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

namespace {

/// Valley and escarpment on a mesh of some thousands of facets, four pictures of the day.
Scene valley(const ScratchFolder& folder) {
    write_text(folder.path / "scene.toml",
               with(small_scene(), "tolerance_m = 10.0", "tolerance_m = 3.0"));
    return read_scene(folder.path / "scene.toml");
}

}  // namespace

// The same scene with every facet solved is the truth here: what is left out is asked, not what is
// computed.
TEST_CASE("facets that no picture needs are left out within the tolerance", "[scenes][needed]") {
    const ScratchFolder folder("needed");
    const Prepared prepared = prepare(valley(folder));
    const Stages stages(prepared);
    Progress silent(ProgressStyle::silent);
    const SpanResult whole = solve_scene(stages, silent);
    constexpr double tolerance = 0.1;
    const SpanResult part = solve_scene(stages, silent, tolerance);
    const auto note = std::find_if(part.notes.begin(), part.notes.end(),
                                   [](const auto& text) { return text.starts_with("solved: "); });
    REQUIRE(note != part.notes.end());
    CAPTURE(*note);
    const NeededFacets needed = needed_facets(stages, {}, tolerance);
    const std::size_t all = prepared.world.surfaces().size();
    CHECK(needed.who.solved.size() < all / 2);
    CHECK(needed.probe.size() > 30);

    for (const auto& [name, result] : {std::pair{"whole", &whole}, std::pair{"part", &part}}) {
        std::filesystem::create_directories(folder.path / name / "frames");
        render_frames(stages, result->temperature, folder.path / name, silent);
    }
    double worst = 0.0;
    for (const ObserverInput& observer : prepared.scene.observers) {
        for (const Instant when : observer.frames) {
            for (const std::string& band : observer.bands) {
                const std::string file = frame_base(observer.name, band, when) + ".exr";
                const Frame one = read_exr(folder.path / "whole" / file);
                const Frame other = read_exr(folder.path / "part" / file);
                const auto& a = one["apparent_temperature." + band].pixel;
                const auto& b = other["apparent_temperature." + band].pixel;
                double sum = 0.0;
                for (std::size_t p = 0; p < a.size(); ++p) {
                    sum += (double{a[p]} - double{b[p]}) * (double{a[p]} - double{b[p]});
                }
                worst = std::max(worst, std::sqrt(sum / double(a.size())));
            }
        }
    }
    // What probes foretell is a bound: all that is stood for amiss to the same side.
    const double foretold = probed_difference(needed, part.temperature) * needed.weight;
    CAPTURE(worst, foretold);
    CHECK(worst < tolerance);
    CHECK(worst < 1.5 * foretold + 1e-3);
}

TEST_CASE("a scene whose state is kept is solved whole", "[scenes][needed]") {
    const ScratchFolder folder("needed_state");
    Scene scene = valley(folder);
    scene.output.state = true;
    scene.tolerance = 0.1;
    const Prepared prepared = prepare(std::move(scene));
    Progress silent(ProgressStyle::silent);
    const SpanResult result = solve_scene(Stages(prepared), silent, 0.1);
    CHECK(result.report.facets == prepared.world.surfaces().size());
    const auto told = [](const SpanResult& of, const std::string& why) {
        return std::any_of(of.notes.begin(), of.notes.end(), [&](const std::string& note) {
            return note.find("every facet, in spite of tolerance_K: " + why) != std::string::npos;
        });
    };
    CHECK(told(result, "the heat of all is kept"));
}
