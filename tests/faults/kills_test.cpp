#include <catch2/catch.hpp>
#include <chrono>
#include <random>
#include <string>

#include "tests/faults/faulty_run.hpp"

// A run that was killed, whenever, is taken up and ends with the bytes of one in one go.

using namespace faults;

namespace {

const PrivateTempFolder temp;

/// Kills runs by turns at a random moment and in the middle of a random write (pictures, netCDF,
/// ledger, what is kept for other runs), begun in an empty folder or in what a killed one left.
void kill_and_resume(int times, unsigned seed) {
    const Stage stage("kills");
    const long writes = stage.calls("kill");
    const Contents whole = contents(stage.out());
    REQUIRE(whole.contains("temperatures.nc"));
    REQUIRE(whole.contains("state.nc"));
    stage.begin_anew();
    const auto begun = std::chrono::steady_clock::now();
    REQUIRE(stage.run().code == 0);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> moment(0.0, 1.2 * seconds);
    std::uniform_int_distribution<long> write(1, writes);
    int killed = 0;
    for (int i = 0; i < times; ++i) {
        if (i % 4 < 2) stage.begin_anew();
        const bool in_write = i % 2 == 0;
        const long at = write(random);
        const double when = moment(random);
        const Ended ended = in_write ? stage.run(failing("kill", at)) : stage.run({}, when);
        CAPTURE(seed, i, in_write, at, when);
        killed += ended.signal == SIGKILL;
        CHECK((ended.signal == SIGKILL || ended.code == 0));
        if (fs::exists(stage.out())) {
            const int verified = stage.diurna({"verify", "out"}).code;
            CHECK((verified == 0 || verified == 1 || verified == 2));
        }
        const bool again = i % 4 == 1;  // the next kill meets what this one left
        if (again) continue;
        CHECK(stage.run().code == 0);
        CHECK(differing(contents(stage.out()), whole).empty());
        CHECK(stage.diurna({"verify", "out"}).code == 0);
    }
    CHECK(killed >= times / 4);
}

}  // namespace

TEST_CASE("a run killed at eight moments ends as an uninterrupted one", "[faults][kill]") {
    kill_and_resume(8, 20260620);
}
TEST_CASE("a run killed at fifty moments ends as an uninterrupted one", "[faults][kill][long]") {
    kill_and_resume(50, std::random_device{}());
}

TEST_CASE("an interrupt leaves nothing unfinished", "[faults][kill]") {
    const Stage stage("interrupts");
    for (const double seconds : {0.2, 0.6, 1.0}) {
        for (const int signal : {SIGINT, SIGTERM}) {
            stage.run({}, seconds, signal);
            for (const auto& [name, text] : contents(stage.out())) {
                CAPTURE(seconds, signal, name);
                CHECK_FALSE(name.ends_with(".part"));
            }
        }
    }
    CHECK(stage.run().code == 0);
    CHECK(stage.diurna({"verify", "out"}).code == 0);
}
