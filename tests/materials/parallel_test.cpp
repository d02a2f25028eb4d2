#include "materials/base/parallel.hpp"

#include <atomic>
#include <catch2/catch.hpp>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

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
