#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "terrain/place/sun_path.hpp"  // its library: of the sunlight in the weather
#include "tests/support/mistakes_of_files.hpp"
#include "tests/support/mistakes_of_scenes.hpp"
#include "tests/support/ran.hpp"

using namespace diurna::testing;

// What people write by mistake, and what the program answers: one line that names the place and
// a remedy. The page tests/scenes/mistakes.md is made of these answers:
//
//     DIURNA_WRITE_PAGES=1 build/release/scenes_tests "each mistake gets*"

namespace {

namespace fs = std::filesystem;

struct Group {
    const char* title;
    std::vector<NaturalMistake> mistakes;
};

std::vector<Group> all_mistakes() {
    return {{"Weather files", mistakes_of_weather()},
            {"Elevation, place and paths", mistakes_of_elevation()},
            {"Meshes", mistakes_of_meshes()},
            {"The syntax of scene files", mistakes_of_toml()},
            {"Scenes", mistakes_of_scenes()},
            {"The command line", mistakes_of_commands()}};
}

const ScratchFolder& scratch() {
    static const ScratchFolder folder("mistakes");
    return folder;
}

/// The program's answer to a mistake, in a folder that is made for it.
Ran answer(const NaturalMistake& mistake) {
    const fs::path folder = scratch().path / "field";
    fs::remove_all(folder);
    fs::create_directories(folder);
    for (const auto& [name, text] : whole_folder()) holds(name, text)(folder);
    for (const Edit& edit : mistake.edits) edit(folder);
    // Warnings first, then what is found: stdout is written at the program's end.
    return ran("cd '" + folder.string() + "' && DIURNA_STAGES=off '" DIURNA_BINARY "' " +
               mistake.command + " 2>&1");
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// The line of an answer that is about the mistake.
std::string reported_line(const NaturalMistake& mistake, const std::string& out) {
    for (const std::string& line : lines_of(out)) {
        if (mistake.where == nullptr || line.find(mistake.where) != std::string::npos) return line;
    }
    return "";
}

/// As a cell of a table in Markdown.
std::string cell(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '|') out += '\\';
        out += c;
    }
    return out;
}

/// All answers in turn, each asked for once.
const std::vector<Ran>& answers() {
    static const std::vector<Ran> all = [] {
        std::vector<Ran> reported;
        for (const Group& group : all_mistakes()) {
            for (const NaturalMistake& mistake : group.mistakes)
                reported.push_back(answer(mistake));
        }
        return reported;
    }();
    return all;
}

std::string page() {
    std::string text =
        "# Mistakes and answers\n\nEach mistake is made in a small scene without other mistakes; "
        "the second column is the "
        "program's message. tests/scenes/mistakes_test.cpp compares this page with the program. "
        "Mistakes end with exit code 2 before anything is written; warnings do so with "
        "`check --strict`.\n";
    auto reported = answers().begin();
    for (const Group& group : all_mistakes()) {
        text += "\n## " + std::string(group.title) + "\n\n| mistake | answer |\n|---|---|\n";
        for (const NaturalMistake& mistake : group.mistakes) {
            const std::string line = reported_line(mistake, reported++->out);
            text += "| " + cell(mistake.what) + " | " +
                    (mistake.where == nullptr ? "none: it is read as it is meant"
                                              : "`` " + cell(line) + " ``") +
                    " |\n";
        }
    }
    return text;
}

constexpr const char* page_file = DIURNA_SOURCE_DIR "/tests/scenes/mistakes.md";

}  // namespace

TEST_CASE("a scene without a mistake is fine", "[scenes][mistakes]") {
    const Ran whole = answer({"nothing", {}, nullptr, {}});
    INFO(whole.out);
    CHECK(whole.code == 0);
    CHECK(whole.out.find("scene.toml: no warnings, ") != std::string::npos);
}

TEST_CASE("each mistake gets one line, with its place and a remedy", "[scenes][mistakes]") {
    REQUIRE(answers().size() >= 60);
    auto next = answers().begin();
    for (const Group& group : all_mistakes()) {
        for (const NaturalMistake& mistake : group.mistakes) {
            const Ran& reported = *next++;
            INFO(mistake.what << ": " << mistake.command << "\n" << reported.out);
            CHECK(reported.code == mistake.code);
            if (mistake.where == nullptr) {
                CHECK(reported.out.find("scene.toml: no warnings, ") != std::string::npos);
                continue;
            }
            const std::string line = reported_line(mistake, reported.out);
            CHECK_FALSE(line.empty());
            for (const std::string& mends : mistake.mends) {
                CAPTURE(mends);
                CHECK(line.find(mends) != std::string::npos);
            }
            if (mistake.code == 2) {
                CHECK(lines_of(reported.out).size() <=
                      2);  // what follows from it may be reported, too
            } else {
                CHECK(reported.out.find("scene.toml: 1 warning, ") != std::string::npos);
                CHECK(line.starts_with("warning: "));
            }
        }
    }
    if (std::getenv("DIURNA_WRITE_PAGES")) std::ofstream(page_file, std::ios::binary) << page();
    std::ifstream in(page_file, std::ios::binary);
    const std::string written{std::istreambuf_iterator<char>(in), {}};
    CHECK(page() == written);
}
