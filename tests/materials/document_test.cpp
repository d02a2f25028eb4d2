#include "materials/base/document.hpp"

#include <catch2/catch.hpp>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"

using namespace diurna;

namespace {

/// The mistakes that reading `text` by `read` brings up.
template <class Read>
std::vector<Mistake> mistakes_in(const std::string& text, const Read& read) {
    try {
        const Document document = Document::from_text(text, "hill.toml");
        read(document.root());
        document.finish();
    } catch (const InputError& error) {
        return error.mistakes();
    }
    return {};
}

}  // namespace

TEST_CASE("a misspelt key is named with its place and the nearest key", "[materials][document]") {
    const auto found = mistakes_in("[air]\nwidn_speed_m_s = 3.0\n", [](const Section& root) {
        root.section("air").number_or("wind_speed_m_s", 1.0);
    });
    REQUIRE(found.size() == 1);
    CHECK(found[0].line() ==
          "hill.toml:2:1: air.widn_speed_m_s: unknown key (did you mean 'wind_speed_m_s'?)");
}

TEST_CASE("all mistakes of a file are reported at once, in its order", "[materials][document]") {
    const auto found =
        mistakes_in("[a]\nlow = -1\nname = 3\nlist = [1, 2]\n[b]\nwhen = 2026-07-15T00:00:00\n",
                    [](const Section& root) {
                        const Section b = root.section("b");
                        b.moment("when");
                        b.number("absent", 0, 1);
                        const Section a = root.section("a");
                        a.numbers("list", 3);
                        a.text("name");
                        a.number("low", 0, 5);
                    });
    REQUIRE(found.size() == 5);
    CHECK(found[0].line() == "hill.toml:2:7: a.low: found -1, expected a number from 0 to 5");
    CHECK(found[1].line() == "hill.toml:3:8: a.name: found 3, expected a text in quotes");
    CHECK(found[2].line() ==
          "hill.toml:4:8: a.list: found an array, expected an array of 3 numbers");
    CHECK(found[3].where == "hill.toml:5:1: b.absent");
    CHECK(found[4].where == "hill.toml:6:8: b.when");
}

TEST_CASE("a decimal comma, nan and inf are refused", "[materials][document]") {
    CHECK(mistakes_in("x = 0,3\n", [](const Section&) {}).at(0).where.rfind("hill.toml:1:", 0) ==
          0);
    for (const std::string value : {"nan", "inf", "-inf", "\"3\"", "true", "[1]"}) {
        CAPTURE(value);
        const auto found =
            mistakes_in("x = " + value + "\n", [](const Section& root) { root.number("x"); });
        REQUIRE(found.size() == 1);
        CHECK(found[0].where == "hill.toml:1:5: x");
    }
}

TEST_CASE("a setting takes the place of what the file says", "[materials][document]") {
    Document document = Document::from_text("[time]\nstep_s = 600\n", "hill.toml");
    document.set("time.step_s=300");
    document.set("scene.name=ridge");
    CHECK(document.root().section("time").number("step_s") == 300.0);
    CHECK(document.root().section("scene").text("name") == "ridge");
    document.set("time.frames=many");
    document.root().section("time").number_or("frames", 1.0);
    CHECK_THROWS_WITH(document.finish(), Catch::Contains("--set time.frames: found \"many\""));
    CHECK_THROWS_AS(document.set("time"), InputError);
    CHECK_THROWS_AS(document.set("time.step_s.x=1"), InputError);
}

TEST_CASE("malformed TOML never aborts", "[materials][document][stress]") {
    for (const std::string text :
         {"[", "[[", "a = ", "= 3", "a = \"", "a = [1, 2", "[a]\n[a]\n", "a.b = 1\na = 2\n", "\x01",
          "a = 1e999", "a = 99999999999999999999", "a = 2026-13-45T00:00:00Z", "\xff\xfe"}) {
        CAPTURE(text);
        const auto found = mistakes_in(text, [](const Section& root) { root.number_or("a", 0.0); });
        REQUIRE_FALSE(found.empty());
        CHECK(found[0].line().find('\n') == std::string::npos);
    }
}

TEST_CASE("numbers take up the whole text and are finite", "[materials][files]") {
    double value = 0.0;
    CHECK(parse_number("1.5e3", value));
    CHECK(value == 1500.0);
    for (const char* text : {"", "1,5", "nan", "inf", "1e999", "0x10", "+1", " 1", "1 ", "abc"}) {
        CAPTURE(text);
        CHECK_FALSE(parse_number(text, value));
    }
}

TEST_CASE("the nearest word is found, and none where none is near", "[materials][error]") {
    const std::vector<std::string> words = {"asphalt", "concrete", "grass"};
    CHECK(nearest("asfalt", words) == "asphalt");
    CHECK(nearest("gras", words) == "grass");
    CHECK(nearest("xylophone", words).empty());
}
