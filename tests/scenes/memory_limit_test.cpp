#include "scenes/job/plan/memory_limit.hpp"

#include <catch2/catch.hpp>
#include <filesystem>

#include "materials/base/error.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/run/job.hpp"
#include "tests/support/small_scene.hpp"

using namespace diurna;

TEST_CASE("a limit of memory is given in M, G or T", "[scenes][plan]") {
    CHECK(bytes_reported("800M") == 8e8);
    CHECK(bytes_reported("6.5G") == 6.5e9);
    CHECK(bytes_reported("2T") == 2e12);
    for (const char* text : {"", "G", "8", "8GB", "8 G", "-1G", "nan", "1e300G", "0M", "inf"}) {
        CHECK_THROWS_AS(bytes_reported(text), InputError);
    }
    CHECK(free_memory() > 0.0);
}

TEST_CASE("a plan that needs more memory than there is is refused before anything is written",
          "[scenes][plan]") {
    const ScratchFolder folder("memory_limit");
    const auto file = folder.path / "scene.toml";
    write_text(file, small_scene());
    const auto out = folder.path / "out";
    CHECK_THROWS_WITH(run_job(read_scene(file, {}, true), {.out = out, .max_memory = 50e6}),
                      Catch::Contains(" MB (") && Catch::Contains("--max-memory permits 50 MB"));
    CHECK_FALSE(std::filesystem::exists(out));
    Plan plan;
    plan.steps.resize(2);
    plan.memory = 2e9;
    CHECK_NOTHROW(check_memory(plan, 2e9));
    CHECK(memory_in_words(999.4e6) == "999 MB");
    CHECK(memory_in_words(6.54e9) == "6.5 GB");
    CHECK_NOTHROW(check_memory(plan, 0.0));
}
