#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <string>

#include "tests/support/differing.hpp"
#include "tests/support/folder_contents.hpp"
#include "tests/support/ran.hpp"
#include "tests/support/small_scene.hpp"

// What `diurna slurm` writes, run by bash in place of a cluster (tests/slurm/try.sh has a real
// one).

namespace {

namespace fs = std::filesystem;

const PrivateTempFolder temp;

/// Does at once what it is handed, a task after the other, and prints a number as --parsable does.
constexpr const char* sbatch = R"(#!/bin/bash
tasks=0
for word; do
    case $word in
    --array=1-*) tasks=$(seq "${word#--array=1-}") ;;
    --dependency=afterok:7) ;;
    --dependency*) exit 9 ;;
    *.sbatch) script=$word ;;
    esac
done
for task in $tasks; do
    SLURM_ARRAY_TASK_ID=$task SLURM_CPUS_PER_TASK=2 bash "$script" >>"$script.log" 2>&1 || exit
done
echo "7;cluster"
)";

/// A folder whose name a shell would read as more than a name.
struct Place {
    ScratchFolder folder{"slurm"};
    fs::path inner = folder.path / "it's $HOME of `me`";
    Place() {
        fs::create_directories(inner / "bin");
        write_text(inner / "bin/sbatch", sbatch);
        fs::permissions(inner / "bin/sbatch", fs::perms::owner_all);
    }
    Ran diurna(const std::string& verb) const {
        return ran(fmt::format("cd \"$(cat '{}')\" && '{}' {} 2>&1",
                               (folder.path / "where").string(), DIURNA_BINARY, verb));
    }
};

std::map<std::string, std::string> results(const fs::path& folder) {
    auto found = contents(folder);
    for (const char* name : {"report.html", "manifest.json", "ledger.jsonl"}) found.erase(name);
    return found;
}

}  // namespace

TEST_CASE("scripts for Slurm leave what one process leaves", "[slurm]") {
    const Place place;
    write_text(place.folder.path / "where", place.inner.string());
    std::string text = with(small_scene(), "radius_m = 4000.0", "radius_m = 2500.0");
    text = with(text, "step_s = 1200.0", "step_s = 3600.0");
    write_text(place.inner / "scene.toml", text);
    const std::string set =
        "scene.toml --set 'scene.title=\"a \\\"b\\\" $c\"' --set scene.sky_rays=16";
    const Ran whole = place.diurna("run " + set + " --progress none --out whole");
    INFO(whole.out);
    REQUIRE(whole.code == 0);

    const Ran written = place.diurna("slurm " + set +
                                     " --shards 3 --cpus 2 --sbatch=--partition=long"
                                     " --out out --scripts jobs");
    INFO(written.out);
    REQUIRE(written.code == 0);
    CHECK(written.out.find("4 pictures in 3 shards of 2 processors") == 0);
    const auto scripts = contents(place.inner / "jobs");
    CHECK(scripts.size() == 4);
    for (const auto& [name, script] : scripts) {
        if (name == "submit.sh") continue;
        INFO(name);
        CHECK(script.find("\n#SBATCH --partition=long\n") != std::string::npos);
        CHECK(script.find("\n#SBATCH --cpus-per-task=2\n") != std::string::npos);
        CHECK(script.find("\n#SBATCH --requeue\n") != std::string::npos);
        // Where all else ends, sbatch stops to read its lines.
        CHECK(script.rfind("#SBATCH") < script.find("set -euo"));
    }
    const Ran submitted = ran(fmt::format(
        "cd \"$(cat '{}')\" && PATH=\"$PWD/bin:$PATH\" jobs/submit.sh 2>&1; cat jobs/*.log",
        (place.folder.path / "where").string()));
    INFO(submitted.out);
    CHECK(differing(results(place.inner / "out"), results(place.inner / "whole")).empty());
    CHECK(place.diurna("verify out").code == 0);
}

TEST_CASE("what Slurm cannot express is refused before anything is written", "[slurm]") {
    const Place place;
    write_text(place.folder.path / "where", place.inner.string());
    write_text(place.inner / "scene.toml", small_scene());
    for (const auto& [options, expected] : {
             std::pair{"--shards 5 --out out --scripts jobs",
                       "--shards: found 5, expected at most 4"},
             {"--shards 0 --out out --scripts jobs", "--shards"},
             {"--shards 2 --out out --scripts bin", "exists and is not empty"},
             {"--shards 2 --out out --scripts '50% done'", "cannot contain"},
             {"--shards 2 --out bin --scripts jobs", "holds files that are not results of a run"},
         }) {
        const Ran refused =
            place.diurna(std::string("slurm scene.toml --allow-outside ") + options);
        INFO(refused.out);
        CHECK(refused.code == 2);
        CHECK(refused.out.find(expected) != std::string::npos);
    }
    fs::create_directories(place.inner / "out");
    const int held = ::open((place.inner / "out").c_str(), O_RDONLY | O_DIRECTORY);
    REQUIRE(::flock(held, LOCK_EX | LOCK_NB) == 0);
    const Ran refused =
        place.diurna("slurm scene.toml --allow-outside --shards 2 --out out --scripts jobs");
    INFO(refused.out);
    CHECK(refused.code == 2);
    CHECK(refused.out.find("is in use by another run") != std::string::npos);
    ::close(held);
    CHECK_FALSE(fs::exists(place.inner / "jobs"));
    CHECK_FALSE(fs::exists(place.inner / "50% done"));
}
