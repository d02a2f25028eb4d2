#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <string>
#include <vector>

#include "tests/faults/faulty_run.hpp"

// Where the system fails the program in any one call, it says so in one line and leaves with 1 (2,
// where it takes a file for damaged), or does without; it never leaves half a file or other
// results, and once the system is well the same command finishes the run.

using namespace faults;

namespace {

const PrivateTempFolder temp;

/// The calls that are made to fail: all of few, else that many, spread from the first to the last
/// and denser among the first.
std::vector<long> some_of(long calls, long most) {
    std::vector<long> chosen;
    for (long i = 0; i < most; ++i) {
        const double share = double(i) / double(most - 1);
        const long at = calls <= most ? i + 1 : 1 + long(double(calls - 1) * share * share);
        if (at <= calls && (chosen.empty() || at > chosen.back())) chosen.push_back(at);
    }
    return chosen;
}

struct Counts {
    int failed = 0, refused = 0, went_on = 0;
};

/// Makes one call after the other fail; a line for each that is reported badly or leaves less than
/// it should.
Counts try_all(const std::string& kind, long most, bool on = false) {
    const Stage stage("faults-" + kind);
    const long calls = stage.calls(kind);
    REQUIRE(calls > 0);
    const Contents whole = contents(stage.out());
    REQUIRE(whole.size() > 10);
    Counts counts;
    for (const long at : some_of(calls, most)) {
        stage.begin_anew();
        const Ended ended = stage.run(failing(kind, at, on));
        const std::string reported = ended.lines.empty() ? "" : ended.lines.front();
        INFO(kind << " " << at << " of " << calls << ": " << reported);
        CHECK(ended.signal == 0);
        CHECK((ended.code == 0 || ended.code == 1 || ended.code == 2));
        if (kind == "write") CHECK(ended.code != 2);
        const Contents left = contents(stage.out());
        if (ended.code == 0) {
            ++counts.went_on;
            CHECK(differing(left, whole).empty());
            continue;
        }
        ++(ended.code == 1 ? counts.failed : counts.refused);
        CHECK(ended.lines.size() == 1);
        CHECK(torn(left, whole).empty());
        CHECK(stage.run().code == 0);
        CHECK(differing(contents(stage.out()), whole).empty());
        CHECK(stage.diurna({"verify", "out"}).code == 0);
    }
    fmt::print("{:<7} {:8} calls: {} failed, {} refused, {} went on\n", kind, calls, counts.failed,
               counts.refused, counts.went_on);
    return counts;
}

}  // namespace

TEST_CASE("a write that fails ends a run that can be taken up", "[faults]") {
    CHECK(try_all("write", 12).failed > 0);
}
TEST_CASE("a disk that is full from some write on ends a run that can be taken up", "[faults]") {
    CHECK(try_all("write", 8, true).failed > 0);
}
TEST_CASE("memory that is not there ends a run that can be taken up", "[faults]") {
    CHECK(try_all("malloc", 12).failed > 0);
}
TEST_CASE("a thread that cannot be started ends a run that can be taken up", "[faults]") {
    try_all("thread", 4);
}
TEST_CASE("a short read is read on from, or refused, and never makes other results", "[faults]") {
    try_all("read", 12);
}

TEST_CASE("every write that fails, one by one", "[faults][long]") { try_all("write", 1000); }
TEST_CASE("memory that is not there, at 200 places", "[faults][long]") { try_all("malloc", 200); }
TEST_CASE("a short read at 300 places", "[faults][long]") { try_all("read", 300); }
