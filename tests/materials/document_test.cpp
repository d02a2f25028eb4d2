#include "materials/base/document.hpp"

#include <catch2/catch.hpp>
#include <map>
#include <vector>

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

TEST_CASE("a misspelt key is named with its place and the nearest key",
          "[materials][document][own_keys]") {
    const auto found = mistakes_in("[air]\nwidn_speed_m_s = 3.0\n", [](const Section& root) {
        root.section("air", "the air").number_or("wind_speed_m_s", "of the wind", 1.0);
    });
    REQUIRE(found.size() == 1);
    CHECK(found[0].line() ==
          "hill.toml:2:1: air.widn_speed_m_s: unknown key (did you mean 'wind_speed_m_s'?)");
}

TEST_CASE("all mistakes of a file are reported at once, in its order",
          "[materials][document][own_keys]") {
    const auto found =
        mistakes_in("[a]\nlow = -1\nname = 3\nlist = [1, 2]\n[b]\nwhen = 2026-07-15T00:00:00\n",
                    [](const Section& root) {
                        const Section b = root.section("b", "the second");
                        b.moment("when", "it begins");
                        b.number("absent", "a share", {0.0, 1.0});
                        const Section a = root.section("a", "the first");
                        a.numbers("list", "three of them", 3);
                        a.text("name", "of it");
                        a.number("low", "the lowest", {0.0, 5.0});
                    });
    REQUIRE(found.size() == 5);
    CHECK(found[0].line() == "hill.toml:2:7: a.low: found -1, expected a number from 0 to 5");
    CHECK(found[1].line() == "hill.toml:3:8: a.name: found 3, expected a text in quotes");
    CHECK(found[2].line() ==
          "hill.toml:4:8: a.list: found an array, expected an array of 3 numbers");
    CHECK(found[3].where == "hill.toml:5:1: b.absent");
    CHECK(found[4].where == "hill.toml:6:8: b.when");
}

TEST_CASE("a decimal comma, nan and inf are refused", "[materials][document][own_keys]") {
    CHECK(mistakes_in("x = 0,3\n", [](const Section&) {}).at(0).where.rfind("hill.toml:1:", 0) ==
          0);
    for (const std::string value : {"nan", "inf", "-inf", "\"3\"", "true", "[1]"}) {
        CAPTURE(value);
        const auto found = mistakes_in("x = " + value + "\n",
                                       [](const Section& root) { root.number("x", "a number"); });
        REQUIRE(found.size() == 1);
        CHECK(found[0].where == "hill.toml:1:5: x");
    }
}

TEST_CASE("a setting takes the place of what the file says", "[materials][document][own_keys]") {
    Document document = Document::from_text("[time]\nstep_s = 600\n", "hill.toml");
    document.set("time.step_s=300");
    document.set("scene.name=ridge");
    const Section time = document.root().section("time", "the span");
    CHECK(time.number("step_s", "of the balance") == 300.0);
    CHECK(document.root().section("scene", "its names").text("name", "of it") == "ridge");
    document.set("time.frames=many");
    time.number_or("frames", "of them", 1.0);
    CHECK_THROWS_WITH(document.finish(), Catch::Contains("--set time.frames: found \"many\""));
    CHECK_THROWS_AS(document.set("time"), InputError);
    CHECK_THROWS_AS(document.set("time.step_s.x=1"), InputError);
}

TEST_CASE("a setting finds one of several tables by name or number",
          "[materials][document][own_keys]") {
    Document document = Document::from_text(
        "[[eye]]\nname = \"east\"\nwidth = 1\n[[eye]]\nname = \"west\"\n"
        "[list]\nvalues = [7, [8, \"x\"]]\n",
        "hill.toml");
    document.set("eye.west.width=20");
    document.set("eye.0.width=10");
    document.move_value("list.values.1.0", "eye.west.height");
    CHECK_THROWS_WITH(document.set("eye.wst.width=1"), Catch::Contains("did you mean 'west'?"));
    CHECK_THROWS_AS(document.set("eye.2.width=1"), InputError);
    CHECK_THROWS_AS(document.set("eye.west=1"), InputError);
    CHECK_THROWS_AS(document.move_value("list.values.5", "eye.west.width"), InputError);
    document.drop("list");
    const std::vector<Section> eyes = document.root().sections("eye", "an eye");
    for (const Section& eye : eyes) eye.text("name", "its name");
    CHECK(eyes[0].number("width", "of it") == 10.0);
    CHECK(eyes[1].number("width", "of it") == 20.0);
    // A value that was moved is reported of where it stood: line 7, column 15.
    eyes[1].number("height", "of it", {.least = 9.0});
    CHECK_THROWS_WITH(document.finish(), Catch::Contains("hill.toml:7:15: eye.west.height"));
}

TEST_CASE("a setting needs no name where there is one table of a kind",
          "[materials][document][own_keys]") {
    Document document =
        Document::from_text("[[eye]]\nwidth = 1\n[eye.lid]\nwidth = 2\n", "hill.toml");
    document.set("eye.width=20");
    document.set("eye.lid.width=30");
    CHECK_THROWS_WITH(document.set("eye.left.width=1"), Catch::Contains("unknown eye \"left\""));
    const Section eye = document.root().sections("eye", "an eye").front();
    CHECK(eye.number("width", "of it") == 20.0);
    CHECK(eye.section("lid", "its lid").number("width", "of it") == 30.0);
    document.set("eye.height=tall");
    eye.number("height", "of it");
    CHECK_THROWS_WITH(document.finish(), Catch::Contains("--set eye.height: "));
    Document none = Document::from_text("", "hill.toml");
    none.set("eye.east.width=1");
    none.root().sections("eye", "an eye");
    CHECK_THROWS_WITH(none.finish(), Catch::Contains("no table [[eye]] to be changed"));
}

TEST_CASE("a setting finds tables without a name by the name that the program gives them",
          "[materials][document][own_keys]") {
    Document document = Document::from_text(
        "[[pair]]\nfirst = \"truck\"\nsecond = \"the yard\"\n[[pair]]\nname = \"own\"\n"
        "[[look]]\nwidth = 1\n",
        "hill.toml");
    document.name_tables("pair", {"first", "second"});
    document.name_tables("look", {});
    document.set("pair.truck-the_yard.limit=3");
    document.set("look.look.width=2");
    CHECK(document.holds({"pair", "0", "limit"}));
    CHECK_FALSE(document.holds({"pair", "1", "limit"}));
    CHECK_THROWS_WITH(document.set("pair.truck.limit=3"),
                      Catch::Contains("0 truck-the_yard, 1 own"));
}

TEST_CASE("mistakes name one of several tables by its name, as settings do",
          "[materials][document][own_keys]") {
    const auto reported = [](const std::string& text) {
        const Document document = Document::from_text(text, "hill.toml");
        for (const Section& eye : document.root().sections("eye", "an eye")) {
            if (eye.has("name")) eye.text("name", "its name");
            for (const Section& lid : eye.sections("lid", "a lid")) lid.number("width", "of it");
            eye.number("width", "of it");
        }
        try {
            document.finish();
        } catch (const InputError& error) {
            return error.mistakes().front().line();
        }
        return std::string("none");
    };
    const std::string east = "[[eye]]\nname = \"east\"\nwidth = 1\n", west = "[[eye]]\nname = ";
    CHECK(reported(east + west + "\"west\"\nwidth = \"x\"\n")
              .find("hill.toml:6:9: eye.west.width: ") == 0);
    CHECK(reported(east + west + "\"north wall\"\nwidth = \"x\"\n")
              .find("hill.toml:6:9: eye.\"north wall\".width: ") == 0);
    CHECK(reported(east + west + "\"west\"\nwidth = 1\nlid = [{ width = \"x\" }]\n")
              .find("eye.west.lid[0].width: ") != std::string::npos);
    // The only one needs no name. By number: names that are the same, tables without names.
    CHECK(reported("[[eye]]\nname = \"east\"\nwidth = \"x\"\n").find(": eye.width: ") !=
          std::string::npos);
    CHECK(reported("[[eye]]\nwidth = 1\nlid = [{ width = \"x\" }]\n").find("eye.lid[0].width: ") !=
          std::string::npos);
    CHECK(reported(east + west + "\"east\"\nwidth = \"x\"\n").find(": eye[1].width: ") !=
          std::string::npos);
    // A setting by its name, though the table is alone.
    Document alone = Document::from_text("[[eye]]\nname = \"east\"\n", "hill.toml");
    alone.set("eye.east.width=wide");
    alone.root().sections("eye", "an eye").front().number("width", "of it");
    CHECK_THROWS_WITH(alone.finish(), Catch::Contains("--set eye.east.width: "));
    CHECK(reported("[[eye]]\nwidth = 1\n[[eye]]\nwidth = \"x\"\n").find(": eye[1].width: ") !=
          std::string::npos);
}

TEST_CASE("a document lists which keys were read, and how", "[materials][document][own_keys]") {
    const Document document = Document::from_text(
        "[[rule]]\nkind = \"steep\"\nheight_m = 3.0\n[parts]\nwheel = \"rubber\"\n", "hill.toml");
    const Section rule = document.root().sections("rule", "what holds where").at(0);
    rule.kind_or("of ground", "flat", {"flat", "steep"});
    rule.number_or("slope_deg", "of the ground", {7.5, "as the map says"}, {.least = 0.0});
    if (rule.has("cover")) rule.number("cover", "a share", {0.0, 1.0});
    rule.number("height_m", "above the sea", {0.0, 9000.0});
    const Section parts = document.root().section("parts", "a material each");
    for (const std::string& name : parts.free_keys()) parts.text(name, "of this part");
    document.finish();

    std::map<std::string, Key> found;
    for (const Key& key : document.keys()) found[key.path] = key;
    CHECK(found.at("rule").kind == Key::Kind::tables);
    CHECK(found.at("rule[].kind").words == std::vector<std::string>{"flat", "steep"});
    CHECK(found.at("rule[].slope_deg").fallback == "as the map says");
    CHECK(found.at("rule[].slope_deg").range.least == 0.0);
    CHECK(found.at("rule[].slope_deg").chosen.at(0) ==
          std::pair<std::string, std::string>{"kind", "steep"});
    CHECK(found.at("rule[].cover").kind == Key::Kind::tested);  // nobody read it
    CHECK(found.at("rule[].height_m").required);
    CHECK(found.at("rule[].height_m").table == "rule[0]");
    CHECK(found.at("parts.NAME").says == "of this part");
}

TEST_CASE("malformed TOML never aborts", "[materials][document][own_keys][stress]") {
    for (const std::string text :
         {"[", "[[", "a = ", "= 3", "a = \"", "a = [1, 2", "[a]\n[a]\n", "a.b = 1\na = 2\n", "\x01",
          "a = 1e999", "a = 99999999999999999999", "a = 2026-13-45T00:00:00Z", "\xff\xfe"}) {
        CAPTURE(text);
        const auto found =
            mistakes_in(text, [](const Section& root) { root.number_or("a", "a number", 0.0); });
        REQUIRE_FALSE(found.empty());
        CHECK(found[0].line().find('\n') == std::string::npos);
    }
}

TEST_CASE("a mistake is one line and steers no terminal", "[materials][document][own_keys]") {
    CHECK(Mistake{"w.csv:1:2", "found '\x1b[2J\n\x7f', expected a number", ""}.line() ==
          "w.csv:1:2: found '?[2J?\?', expected a number");
    CHECK(Mistake{"µ", "\xc2\x9b and \xe2\x80\xae, \xe2\x82\xac", ""}.line() ==
          "µ: ?\? and ?\?\?, \xe2\x82\xac");
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

TEST_CASE("the nearest word is suggested, and no distant one", "[materials][error]") {
    const std::vector<std::string> words = {"asphalt", "concrete", "grass"};
    CHECK(nearest("asfalt", words) == "asphalt");
    CHECK(nearest("gras", words) == "grass");
    CHECK(nearest("xylophone", words).empty());
}
