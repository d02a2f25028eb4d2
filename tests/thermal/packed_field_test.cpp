#include "thermal/solve/packed_field.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>

using namespace diurna;

namespace {

constexpr std::size_t instants = 145, facets = 5;

/// A day's temperature with noise [K].
std::vector<float> day(std::size_t f, std::mt19937& random) {
    std::uniform_real_distribution<float> noise(-0.5f, 0.5f);
    std::vector<float> kelvin(instants);
    for (std::size_t i = 0; i < instants; ++i) {
        kelvin[i] = 300.0f + 20.0f * std::sin(0.0433f * float(i) + float(f)) + noise(random);
    }
    return kelvin;
}

}  // namespace

TEST_CASE("a packed value is within a 65535th of the range of its sixteen instants",
          "[thermal][packed]") {
    std::mt19937 random(7);
    PackedField field = PackedField::of_steps(instants, 1, facets);
    std::vector<std::vector<float>> given;
    for (std::size_t f = 0; f < facets; ++f) {
        given.push_back(day(f, random));
        field.put(f, given[f].data());
    }
    double square = 0.0;
    for (std::size_t f = 0; f < facets; ++f) {
        std::vector<float> found(instants);
        field.get(f, found.data());
        for (std::size_t i = 0; i < instants; ++i) {
            const auto first = given[f].begin() + std::ptrdiff_t(i / 16 * 16);
            const auto last =
                given[f].begin() + std::ptrdiff_t(std::min(instants, i / 16 * 16 + 16));
            const auto [low, high] = std::minmax_element(first, last);
            const float ulp = 3.1e-5f;  // of a float at 300 K
            REQUIRE(std::abs(found[i] - given[f][i]) <= (*high - *low) / 65535.0f + ulp);
            REQUIRE(field.at(i, f) == found[i]);
            square += std::pow(double(found[i] - given[f][i]), 2) / double(instants * facets);
        }
    }
    CHECK(std::sqrt(square) < 1e-4);  // [K]
}

TEST_CASE("equal values are packed exactly, and zero stays zero", "[thermal][packed]") {
    PackedField field = PackedField::of_steps(instants, 1, 2);
    CHECK(field.at(17, 1) == 0.0f);
    field.fill(1, 287.654f);
    CHECK(field.at(0, 1) == 287.654f);
    CHECK(field.at(144, 1) == 287.654f);
    std::vector<float> step(instants, 0.0f);
    for (std::size_t i = 20; i < 30; ++i) step[i] = 0.75f;
    field.put(0, step.data());
    CHECK(field.at(19, 0) == 0.0f);
    CHECK(field.at(25, 0) == Approx(0.75f).margin(1.2e-5));
    CHECK(field.at(40, 0) == 0.0f);
}

TEST_CASE("packed values hold the ends of the range of floats", "[thermal][packed]") {
    PackedField field = PackedField::of_steps(16, 1, 1);
    const float huge = GENERATE(1e-30f, 1e-6f, 1.0f, 4e7f, 1e30f);
    CAPTURE(huge);
    std::vector<float> values(16, -huge);
    values[3] = huge;
    field.put(0, values.data());
    CHECK(std::abs(field.at(3, 0) - huge) <= std::max(4e-5f * huge, 1e-26f));
    CHECK(std::abs(field.at(2, 0) + huge) <= std::max(4e-5f * huge, 1e-26f));
}

TEST_CASE("a packed value that is not finite is found", "[thermal][packed]") {
    PackedField field = PackedField::of_steps(instants, 1, 1);
    std::vector<float> values(instants, 300.0f);
    values[33] =
        GENERATE(std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity());
    field.put(0, values.data());
    CHECK(std::isnan(field.at(33, 0)));
    CHECK(field.at(31, 0) == 300.0f);
    CHECK(field.at(48, 0) == 300.0f);
}

TEST_CASE("instants without a slot are zero and take no memory", "[thermal][packed]") {
    PackedField field({-1, -1, 0, 1, 2, -1}, 3);
    CHECK(field.slots() == 3);
    const std::vector<float> sun{100.0f, 800.0f, 50.0f};
    field.put(2, sun.data());
    CHECK(field.at(0, 2) == 0.0f);
    CHECK(field.at(3, 2) == Approx(800.0f).epsilon(1e-5));
    CHECK(field.at(5, 2) == 0.0f);
    CHECK(field.row(3)(1) == 0.0f);
}

TEST_CASE("a writer packs what it is given instant by instant", "[thermal][packed]") {
    std::mt19937 random(3);
    const std::vector<std::size_t> chosen{4, 1};
    PackedField field = PackedField::of_steps(instants, 1, facets), whole = field;
    std::vector<std::vector<float>> given{day(4, random), day(1, random)};
    {
        PackedWriter writer(field, chosen);
        for (std::size_t i = 0; i < instants; ++i) {
            const double row[2] = {double(given[0][i]), double(given[1][i])};
            writer.add(row);
        }
    }
    for (std::size_t k = 0; k < 2; ++k) whole.put(chosen[k], given[k].data());
    for (std::size_t i = 0; i < instants; ++i) {
        for (std::size_t f = 0; f < facets; ++f) REQUIRE(field.at(i, f) == whole.at(i, f));
    }
}

TEST_CASE("values read run by run for many facets are those of each alone", "[thermal][packed]") {
    std::mt19937 random(5);
    constexpr std::size_t many = 19;
    PackedField field = PackedField::of_steps(instants, 1, many);
    for (std::size_t f = 0; f < many; ++f) field.put(f, day(f, random).data());
    const std::vector<std::size_t> chosen{3, 1, 18, 0, 7, 8, 9, 10, 11, 12, 4};
    PackedReader reader(field, chosen, 16);
    for (std::size_t i = 0; i < instants; ++i) {
        const float* const row = reader.at(i);
        for (std::size_t k = 0; k < chosen.size(); ++k) REQUIRE(row[k] == field.at(i, chosen[k]));
    }
    const std::vector<std::size_t> some{0, 5, 15, 16, 100, 144};
    std::vector<float> rows(some.size() * many);
    field.decode(some, rows);
    float least = 1e9f, greatest = 0.0f;
    for (std::size_t f = 0; f < many; ++f) {
        for (std::size_t row = 0; row < some.size(); ++row) {
            REQUIRE(rows[row * many + f] == field.at(some[row], f));
        }
        for (std::size_t i = 0; i < instants; ++i) {
            least = std::min(least, field.at(i, f));
            greatest = std::max(greatest, field.at(i, f));
        }
    }
    CHECK(field.extremes(many).least == least);
    CHECK(field.extremes(many).greatest == greatest);
}

TEST_CASE("a field that is linear between hours is exact at them", "[thermal][packed]") {
    PackedField field = PackedField::linear_between(instants, 6, 2);
    CHECK(field.slots() == 25);
    std::vector<float> hours(25);
    for (std::size_t k = 0; k < 25; ++k) hours[k] = float(k * k);
    field.put(1, hours.data());
    const std::vector<std::size_t> both{1, 0};
    PackedReader reader(field, both, 8);
    for (std::size_t i = 0; i < instants; ++i) {
        const float k = float(i / 6), share = float(i % 6) / 6.0f;
        const float expected = k * k + share * (2.0f * k + 1.0f);
        REQUIRE(field.at(i, 1) == Approx(expected).margin(0.01));
        REQUIRE(reader.at(i)[0] == Approx(field.at(i, 1)).epsilon(1e-6));
        REQUIRE(reader.at(i)[1] == 0.0f);
    }
}

TEST_CASE("facets that exchange need buffers of at most 64 MB, or one run of instants",
          "[thermal][packed]") {
    CHECK(runs_at_once(1000, 4) == 4);
    for (const std::size_t count : {100'000, 350'000, 1'000'000, 10'000'000}) {
        const std::size_t runs = runs_at_once(count, 4);
        const std::size_t bytes = runs * PackedField::run * sizeof(float) * count;
        CHECK((runs == 1 || bytes <= 64u << 20));
        CHECK((runs == 4 || bytes + PackedField::run * sizeof(float) * count > 64u << 20));
    }
}
