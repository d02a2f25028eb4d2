#include <catch2/catch.hpp>

#include "tests/corpus/run_corpus.hpp"

namespace {

using corpus::changed;
using corpus::Family;
using corpus::Malformed;

std::string repeated(const std::string& text, std::size_t count) {
    std::string all;
    all.reserve(text.size() * count);
    for (std::size_t i = 0; i < count; ++i) all += text;
    return all;
}

/// The yard's scene with something before or after it.
Malformed around(const std::string& name, const std::string& before, const std::string& after) {
    return {.name = name, .files = {{"scene.toml", before + yard::scene + after}}};
}

Family broken_syntax() {
    const std::string nul(1, '\0');
    Family cases{
        around("an unfinished string", "a = \"x\n", ""),
        around("an unfinished table", "[a\n", ""),
        around("an unfinished array", "a = [1, 2\n", ""),
        around("a key without value", "a =\n", ""),
        around("a value without key", "= 3\n", ""),
        around("a key twice", "", "\n[output]\nstate = true\nstate = true\n"),
        around("a table twice", "", "\n[weather]\nfile = \"weather.csv\"\n"),
        around("a table and an array of one name", "", "\n[observer]\nname = \"x\"\n"),
        around("a NUL", "# " + nul + "\n", ""),
        around("a NUL in a text", "", "\n[output]\nx = \"" + nul + "\"\n"),
        around("not UTF-8", "title = \"\xff\xfe\"\n", ""),
        around("an overlong character", "title = \"\xc0\xaf\"\n", ""),
        around("half a character", "title = \"\xe2\x82\"\n", ""),
        around("a surrogate", "title = \"\xed\xa0\x80\"\n", ""),
        around("UTF-16", std::string("\xff\xfe[\0s\0", 6), ""),
        around("a control character", "title = \"\x01\"\n", ""),
        around("a stray bracket", "]\n", ""),
        around("an unknown escape", "title = \"\\q\"\n", ""),
        around("an unknown key", "", "\nexposure = 3.0\n"),
        around("an unknown table", "", "\n[wether]\nfile = \"x\"\n"),
        around("80 kB of dotted key", repeated("a.", 40000) + "a = 1\n", ""),
        around("80 kB of dotted table", "", "\n[" + repeated("a.", 40000) + "a]\n"),
        around("1 MB of key", std::string(1000000, 'a') + " = 1\n", ""),
        around("200 000 arrays in one another", "a = " + std::string(200000, '['), ""),
        around("closed arrays in one another",
               "a = " + std::string(200000, '[') + std::string(200000, ']') + "\n", ""),
        around("200 000 inline tables", "a = " + repeated("{a=", 200000), ""),
        around("250 arrays in one another",
               "a = " + std::string(250, '[') + std::string(250, ']') + "\n", ""),
        around("15 MB of commas", "a = [" + std::string(15000000, ',') + "]\n", ""),
        around("20 MB of commas", "a = [" + std::string(20000000, ',') + "]\n", ""),
        around("7 million numbers", "a = [" + repeated("1,", 7000000) + "]\n", ""),
        around("4 million tables", "a = [" + repeated("{},", 4000000) + "]\n", ""),
        around(
            "a million keys of one table",
            repeated("", 0) +
                [] {
                    std::string keys;
                    for (int i = 0; i < 1000000; ++i) keys += fmt::format("k{}=1\n", i);
                    return keys;
                }(),
            ""),
        around("30 MB of comment", "#" + std::string(30000000, 'x') + "\n", ""),
        around("15 MB of text", "", "\n[output]\nx = \"" + std::string(15000000, 'x') + "\"\n"),
        around(
            "100 000 unknown keys",
            [] {
                std::string keys;
                for (int i = 0; i < 100000; ++i) keys += fmt::format("k{}=1\n", i);
                return keys;
            }(),
            ""),
        around("100 000 unknown tables", "",
               [] {
                   std::string keys = "\n";
                   for (int i = 0; i < 100000; ++i) keys += fmt::format("[k{}]\nx=1\n", i);
                   return keys;
               }()),
        around("5 000 observers that are wrong", "",
               repeated("\n[[observer]]\nname=\"x\"\n", 5000)),
        around("a number beyond 64 bits", "", "\n[output]\nx = 99999999999999999999\n"),
        around("a number beyond all doubles", "", "\n[output]\nx = 1e999\n"),
        around("a date that is none", "", "\n[output]\nx = 2026-13-45T00:00:00Z\n"),
        {.name = "an empty file", .files = {{"scene.toml", ""}}},
        {.name = "a mark alone", .files = {{"scene.toml", "\xEF\xBB\xBF"}}},
        {.name = "random bytes",
         .files = {{"scene.toml",
                    [] {
                        std::string text;
                        unsigned state = 1;
                        for (int i = 0; i < 100000; ++i)
                            text += char((state = state * 1664525u + 1013904223u) >> 24);
                        return text;
                    }()}}},
    };
    for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
        // In the midst of a line, so that syntax or a required key is wanting.
        std::size_t at = yard::scene.find('"', std::size_t(share * double(yard::scene.size())));
        cases.push_back({.name = fmt::format("ends at {} of it", share),
                         .files = {{"scene.toml", yard::scene.substr(0, at + 1)}}});
    }
    return cases;
}

/// Every number of the yard's scene (moments and names aside) as something else.
Family numbers_as(const std::string& text, const std::string& file, const std::string& what,
                  const std::vector<std::string>& words) {
    Family cases;
    std::size_t line_begin = 0;
    std::string table;
    while (line_begin < text.size()) {
        const std::size_t line_end = text.find('\n', line_begin);
        const std::string line = text.substr(line_begin, line_end - line_begin);
        if (line.starts_with('[')) table = line;
        std::string key;
        bool quoted = false;
        for (std::size_t i = 0; i < line.size(); ++i) {
            if (line[i] == '"') quoted = !quoted;
            const bool begins = !quoted && std::isdigit(static_cast<unsigned char>(line[i])) &&
                                i > 0 && std::string(" [-").find(line[i - 1]) != std::string::npos;
            if (!begins || line.starts_with("start") || line.starts_with("end")) continue;
            std::size_t end = i;
            while (end < line.size() &&
                   std::string("0123456789.e+-").find(line[end]) != std::string::npos)
                ++end;
            if (line[i - 1] == '-') --i;
            std::string put = text;
            put.replace(line_begin + i, end - i, what);
            cases.push_back({.name = table + " " + line + ": at " + std::to_string(i) + " " + what,
                             .files = {{file, put}},
                             .words = words});
            i = end;
        }
        line_begin = line_end + 1;
    }
    return cases;
}

}  // namespace

TEST_CASE("the yard that the corpus changes is fine") {
    const ScratchFolder scratch("yard");
    corpus::put_files(scratch.path / "yard", {});
    for (const auto& words :
         {std::vector<std::string>{"check", "scene.toml"}, {"column", "column.toml"}}) {
        const corpus::Ended ended = corpus::run(scratch.path / "yard", words);
        INFO(ended.reported);
        CHECK(ended.code == 0);
    }
}

TEST_CASE("broken TOML is refused") { corpus::no_fault("syntax", broken_syntax()); }

TEST_CASE("NaN in place of any number is refused") {
    corpus::no_fault("nan", numbers_as(yard::scene, "scene.toml", "nan", {"check", "scene.toml"}));
    corpus::no_fault("nan column",
                     numbers_as(yard::column, "column.toml", "nan", {"column", "column.toml"}));
}

TEST_CASE("a number of any key at 1e300 is refused") {
    corpus::no_fault("1e300",
                     numbers_as(yard::scene, "scene.toml", "1e300", {"check", "scene.toml"}));
    corpus::no_fault("1e300 column",
                     numbers_as(yard::column, "column.toml", "1e300", {"column", "column.toml"}));
}

TEST_CASE("a number of any key at -1e18 is refused") {
    corpus::no_fault("-1e18",
                     numbers_as(yard::scene, "scene.toml", "-1e18", {"check", "scene.toml"}));
    corpus::no_fault("-1e18 column",
                     numbers_as(yard::column, "column.toml", "-1e18", {"column", "column.toml"}));
}

TEST_CASE("scenes with numbers that contradict each other are refused") {
    using corpus::scene;
    corpus::no_fault(
        "together",
        {scene("a picture that nobody could read back", "width = 32\nheight = 24\nsamples",
               "width = 16384\nheight = 16384\nsamples"),
         scene("a band twice", "bands = [\"8-12\", \"long\"]", "bands = [\"8-12\", \"8-12\"]"),
         scene("no band and no cube", "bands = [\"8-12\", \"long\"]\ncubes = [\"fine\"]",
               "bands = []"),
         scene("two observers of a name", "name = \"flyer\"", "name = \"east\""),
         scene("a band of no width", "bands = [\"8-12\", \"long\"]", "bands = [\"8-8\"]"),
         scene("a band beyond the spectrum", "bands = [\"8-12\", \"long\"]",
               "bands = [\"80-120\"]"),
         scene("a ring that crosses itself",
               "[-80.0, -80.0], [-40.0, -80.0], [-40.0, -40.0], [-80.0, -40.0]",
               "[-80.0, -80.0], [-40.0, -40.0], [-40.0, -80.0], [-80.0, -40.0]"),
         scene("a ring without area",
               "[-80.0, -80.0], [-40.0, -80.0], [-40.0, -40.0], [-80.0, -40.0]",
               "[-80.0, -80.0], [-40.0, -80.0], [-60.0, -80.0]"),
         scene("a crossover of what is not there", "[[observer]]\nname = \"east\"",
               "[[crossover]]\nfirst = \"nothing\"\nsecond = \"ground\"\nobserver = "
               "\"east\"\n[[observer]]\nname = \"east\""),
         scene("contrast without targets", "[[observer]]\nname = \"east\"",
               "[[contrast]]\n[[observer]]\nname = \"east\""),
         scene("weather made ten times as windy as can be", "[weather]\n",
               "[weather]\nchanged = { wind_factor = 11.0 }\n"),
         scene("weather made warmer by 1000 K", "[weather]\n",
               "[weather]\nchanged = { air_temperature_offset_K = 1000.0 }\n")});
}
