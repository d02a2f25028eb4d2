#include <fmt/format.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "materials/base/files.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/run/job.hpp"
#include "scenes/job/store/stage_bytes.hpp"
#include "scenes/job/store/stage_store.hpp"
#include "tests/support/small_scene.hpp"

// Stages by what they are made of: a run that takes what earlier ones have found leaves, to the
// byte, what it leaves when it finds all by itself; and what a change touches is recomputed.

using namespace diurna;

namespace {

namespace fs = std::filesystem;

constexpr StageStore::Limits all{.least_seconds = 0.0};

/// Every file of a folder by name, but those that tell times.
std::map<std::string, std::string> results(const fs::path& folder) {
    std::map<std::string, std::string> files;
    for (const auto& entry : fs::recursive_directory_iterator(folder)) {
        const std::string name = entry.path().lexically_relative(folder);
        if (!entry.is_regular_file() || name == "report.html" || name == "manifest.json") continue;
        files[name] = read_text(entry.path());
    }
    return files;
}

struct Place {
    ScratchFolder folder{"kept_stages"};
    fs::path kept = folder.path / "kept";

    /// A run of the small scene with changes; which stages it took.
    std::vector<std::string> run(const std::string& name, const std::vector<std::string>& settings,
                                 bool with_store = true) const {
        const fs::path file = folder.path / "scene.toml";
        // Without check points: what they report of temperatures goes by the pictures, and is not
        // reported where temperatures come from the cache.
        write_text(file, with(with(with(small_scene(), "radius_m = 4000.0", "radius_m = 2500.0"),
                                   "step_s = 1200.0", "step_s = 3600.0"),
                              "sky_rays = 32", "sky_rays = 32\ncheck_points = 0"));
        const auto store = with_store ? std::make_shared<const StageStore>(kept, all) : nullptr;
        run_job(read_scene(file, settings, true),
                {.out = folder.path / name, .settings = settings, .stages = store});
        return store ? store->taken() : std::vector<std::string>{};
    }
    /// Whether a run with the store left what one without leaves.
    bool alike(const std::string& name, const std::vector<std::string>& settings) const {
        run(name + "_fresh", settings, false);
        const auto one = results(folder.path / name),
                   other = results(folder.path / (name + "_fresh"));
        return !one.empty() && one == other;
    }
};

using Stages = std::vector<std::string>;

}  // namespace

TEST_CASE("what a change does not touch is taken, and the results are those of a fresh run",
          "[scenes][cache]") {
    const Place place;
    CHECK(place.run("first", {}) == Stages{});
    CHECK(place.run("again", {}) == Stages{"sky", "heat"});
    CHECK(place.alike("again", {}));

    // Another eye: nothing is solved.
    const std::vector<std::string> eye{"observer.0.height_above_ground_m=460.0"};
    CHECK(place.run("eye", eye) == Stages{"sky", "heat"});
    CHECK(place.alike("eye", eye));

    // Other pictures, at hours whose temperatures were kept, and at one where they were not.
    const std::vector<std::string> hours{"time.frame_every_s=10800.0", "scene.title=\"again\""};
    CHECK(place.run("hours", hours) == Stages{"sky", "heat"});
    CHECK(place.alike("hours", hours));
    const std::vector<std::string> between{"time.frame_every_s=7000.0"};
    CHECK(place.run("between", between) == Stages{"sky", "sun"});
    CHECK(place.alike("between", between));

    // Another paint: light finds its way as it did, heat does not.
    const std::vector<std::string> paint{"material.grass.emissivity=0.9",
                                         "material.grass.like=\"grass\""};
    CHECK(place.run("paint", paint) == Stages{"sky", "sun"});
    CHECK(place.alike("paint", paint));

    // A coarser sky: all but the shadows' heat is another's.
    const std::vector<std::string> rays{"scene.sky_rays=64"};
    CHECK(place.run("rays", rays) == Stages{});
    CHECK(place.alike("rays", rays));

    // Other steps: other instants of shadows, the same sky.
    const std::vector<std::string> steps{"time.step_s=1800.0"};
    CHECK(place.run("steps", steps) == Stages{"sky"});
    CHECK(place.alike("steps", steps));
}

TEST_CASE("tolerance_K makes heat the pictures' own", "[scenes][cache]") {
    const Place place;
    const std::vector<std::string> near{"tolerance_K=0.1"},
        other{"tolerance_K=0.1", "observer.0.height_above_ground_m=460.0"};
    place.run("near", near);
    CHECK(place.run("near", near) == Stages{"sky", "heat"});
    // Another band shows the same facets.
    const std::vector<std::string> band{"tolerance_K=0.1", "observer.0.bands=[\"8-12\"]"};
    CHECK(place.run("band", band) == Stages{"sky", "heat"});
    CHECK(place.alike("band", band));
    CHECK(place.run("whole", {}) == Stages{"sky"});  // shadows were asked for on some
    CHECK(place.run("other", other) == Stages{"sky"});
    CHECK(place.alike("other", other));
}

TEST_CASE("a changed file of the cache is skipped", "[scenes][cache]") {
    const Place place;
    place.run("first", {});
    int files = 0;
    for (const auto& entry : fs::directory_iterator(place.kept)) {
        std::fstream file(entry.path(), std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(std::streamoff(entry.file_size() / 2));
        file.put('\x5a');
        ++files;
    }
    CHECK(files == 3);
    CHECK(place.run("again", {}) == Stages{});
    CHECK(place.alike("again", {}));
    // And is what it should be again.
    CHECK(place.run("third", {}) == Stages{"sky", "heat"});
}

TEST_CASE("a cache keeps within its size, what was used last remains", "[scenes][cache]") {
    const ScratchFolder folder("kept_stages");
    const StageStore store(folder.path / "kept", {.least_seconds = 0.0, .most_bytes = 4000});
    const std::string text(900, 'x');
    const std::string_view content = text;
    const auto age = [&](const char* key, int hours) {
        for (const auto& entry : fs::directory_iterator(store.folder())) {
            if (entry.path().filename().string().find(key) == std::string::npos) continue;
            fs::last_write_time(entry.path(),
                                fs::file_time_type::clock::now() - std::chrono::hours(hours));
        }
    };
    for (const char* key : {"a", "b", "c", "d"}) store.keep("sky", std::string(8, *key), content);
    age("aaaaaaaa", 3);
    age("bbbbbbbb", 2);
    age("cccccccc", 1);
    REQUIRE(store.find("sky", "aaaaaaaa").has_value());  // asked for: b is the oldest now
    store.keep("sky", "eeeeeeee", content);
    CHECK(store.find("sky", "aaaaaaaa") == content);
    CHECK_FALSE(store.find("sky", "bbbbbbbb").has_value());
    CHECK(store.find("sky", "cccccccc") == content);
    CHECK_FALSE(store.find("sun", "cccccccc").has_value());

    // Another's under its name is not taken.
    fs::rename(store.folder() / "sky-aaaaaaaa.stage", store.folder() / "sky-hhhhhhhh.stage");
    CHECK_FALSE(store.find("sky", "hhhhhhhh").has_value());

    // What a killed run has left goes with the next that keeps something; that of a live one stays.
    const auto dead = store.folder() / ".sky-f.stage.4194305.0123456789abcdef.part";
    const auto alive =
        store.folder() / fmt::format(".sky-g.stage.{}.0123456789abcdef.part", ::getpid());
    write_text(dead, "");
    write_text(alive, "");
    store.keep("sky", "ffffffff", content);
    CHECK_FALSE(fs::exists(dead));
    CHECK(fs::exists(alive));

    // Where nothing can be kept, nothing is, and nobody minds.
    write_text(folder.path / "file", "");
    const StageStore nowhere(folder.path / "file" / "kept", all);
    nowhere.keep("sky", "a", content);
    CHECK_FALSE(nowhere.find("sky", "a").has_value());
}

TEST_CASE("a large result is stored without a copy of it", "[scenes][cache]") {
    // 10 000 facets with 20 others each: 1.7 MB, of which a copy may hold only the lengths.
    constexpr std::size_t facets = 10'000, others = 20;
    FacetViews views;
    for (std::size_t f = 0; f < facets; ++f) {
        views.sky.push_back(0.5f + 1e-5f * float(f));
        views.below.push_back(0.25f);
    }
    views.others.row.push_back(0);
    for (std::size_t f = 0; f < facets; ++f) {
        for (std::size_t k = 0; k < others; ++k) {
            views.others.facet.push_back(std::uint32_t((f + k) % facets));
            views.others.factor.push_back(0.01f);
        }
        views.others.row.push_back(std::uint32_t(views.others.facet.size()));
    }
    const StageContent content = content_of(views);
    CHECK(content.size() > facets * (2 + 2 * others) * sizeof(float));
    std::size_t copied = 0;
    for (const std::string& small : content.small) copied += small.capacity();
    CHECK(copied < 10'000);
    std::string whole;
    for (const std::string_view piece : content.piece) whole += piece;
    const FacetViews read = views_of(whole);
    CHECK(read.sky == views.sky);
    CHECK(read.others.facet == views.others.facet);
    CHECK(read.others.row == views.others.row);
}
