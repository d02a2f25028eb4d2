#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

// docs/theory.md numbers the equations, and the code names each where it is computed.

namespace {

namespace fs = std::filesystem;

const fs::path root = DIURNA_SOURCE_DIR;

constexpr std::array folders{"materials", "terrain", "thermal", "render", "scenes"};

/// Every match of a pattern's first group, and how often.
std::map<int, int> numbers_of(const fs::path& path, const std::regex& pattern) {
    std::map<int, int> found;
    std::ifstream file(path);
    for (std::string line; std::getline(file, line);) {
        for (std::sregex_iterator it(line.begin(), line.end(), pattern), end; it != end; ++it) {
            ++found[std::stoi((*it)[1])];
        }
    }
    return found;
}

/// Equations stand at the beginning of a line: "(T7)   TARP ...".
std::map<int, int> equations() {
    return numbers_of(root / "docs/theory.md", std::regex(R"(^\(T(\d+)\) )"));
}

}  // namespace

TEST_CASE("equations are numbered from one on, each once", "[layering]") {
    const std::map<int, int> numbers = equations();
    REQUIRE_FALSE(numbers.empty());
    int next = 1;
    for (const auto& [number, times] : numbers) {
        CHECK(number == next++);
        CHECK(times == 1);
    }
}

TEST_CASE("the code names every equation, and only existing ones", "[layering]") {
    const std::map<int, int> numbers = equations();
    const std::regex named(R"(\(T(\d+)\) of docs/theory\.md)");
    std::set<int> computed;
    for (const char* folder : folders) {
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const std::string extension = entry.path().extension();
            if (extension != ".cpp" && extension != ".hpp") continue;
            for (const auto& [number, times] : numbers_of(entry.path(), named)) {
                CAPTURE(entry.path(), number);
                CHECK(numbers.count(number) == 1);
                computed.insert(number);
            }
        }
    }
    for (const auto& [number, times] : numbers) {
        CAPTURE(number);
        CHECK(computed.count(number) == 1);
    }
}
