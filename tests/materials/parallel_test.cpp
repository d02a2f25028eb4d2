#include "materials/base/parallel.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include "materials/base/giving_up.hpp"

using namespace diurna;

namespace {

/// True if two blocks run at the same time: each waits for the other.
bool two_at_once() {
    std::atomic<int> here{0};
    std::atomic<bool> met{false};
    for_each_block(2, 1, [&](std::size_t, std::size_t) {
        const auto patience = std::chrono::steady_clock::now() + std::chrono::seconds(3);
        ++here;
        while (here < 2 && std::chrono::steady_clock::now() < patience) std::this_thread::yield();
        if (here == 2) met = true;
        if (!met) --here;
    });
    return met;
}

}  // namespace

TEST_CASE("the number of threads can be changed again and again", "[terrain][parallel]") {
    set_thread_count(1);
    CHECK(thread_count() == 1);
    CHECK_FALSE(two_at_once());
    set_thread_count(2);
    CHECK(thread_count() == 2);
    CHECK(two_at_once());
    set_thread_count(0);
    CHECK(thread_count() >= 1);
}

TEST_CASE("every index is visited once, in the same blocks", "[terrain][parallel]") {
    for (const int threads : {1, 4}) {
        set_thread_count(threads);
        std::vector<int> visits(1000, 0);
        std::vector<std::size_t> begin_of(1000, 0);
        for_each_block(1000, 64, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i) {
                ++visits[i];
                begin_of[i] = begin;
            }
        });
        for (std::size_t i = 0; i < visits.size(); ++i) {
            CHECK(visits[i] == 1);
            CHECK(begin_of[i] == i / 64 * 64);
        }
    }
    set_thread_count(0);
    for_each_index(0, [](std::size_t) { FAIL("nothing to visit"); });
}

TEST_CASE("an exception from a block reaches the caller", "[terrain][parallel]") {
    CHECK_THROWS_AS(for_each_index(1000,
                                   [](std::size_t i) {
                                       if (i == 777) throw std::runtime_error("777");
                                   }),
                    std::runtime_error);
}

TEST_CASE("work that is given up ends before its next block, nested loops and all",
          "[terrain][parallel]") {
    GiveUpRequest unwanted{false};
    std::atomic<int> inner{0};
    {
        const Heeding heeding(&unwanted);
        CHECK_THROWS_AS(for_each_index(
                            1000,
                            [&](std::size_t) {
                                for_each_index(
                                    1000,
                                    [&](std::size_t) {
                                        if (++inner == 10) unwanted = true;
                                    },
                                    1);
                            },
                            1),
                        GivenUp);
        CHECK_THROWS_AS(give_up_if_asked(), GivenUp);
    }
    // Each thread ends the block it is in; of a million there are as many more as threads.
    CHECK(inner >= 10);
    CHECK(inner <= 10 + 2 * int(std::thread::hardware_concurrency()) + 2);
    CHECK(Heeding::heeded() == nullptr);
    for_each_index(
        10, [](std::size_t) { give_up_if_asked(); }, 1);  // nobody heeds it here
}

TEST_CASE("what one caller gives up another continues", "[terrain][parallel]") {
    GiveUpRequest unwanted{true};
    std::atomic<int> done{0};
    bool given_up = false;
    std::thread other([&] {
        const Heeding heeding(&unwanted);
        try {
            for_each_index(
                1000, [](std::size_t) {}, 1);
        } catch (const GivenUp&) {
            given_up = true;
        }
    });
    for_each_index(
        1000, [&](std::size_t) { ++done; }, 1);
    other.join();
    CHECK(given_up);
    CHECK(done == 1000);
}
