#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>

// Two types of one name in one namespace, each in a header of its own, compile and link, and then
// one is constructed or destroyed as if it were the other: a stack was overrun by a move of a
// terrain's `Way` that was that of a trajectory's. Nor do constants: names of terms of heat were
// written over terms of radiance.

namespace {

namespace fs = std::filesystem;

/// Types and constants of the namespace diurna that a header defines; not those of namespaces
/// within it.
std::vector<std::string> names_of(const fs::path& header) {
    static const std::regex opens("^(?:inline )?namespace ((?:\\w+(?:::\\w+)* )?)\\{.*"),
        closes("^\\}  // namespace.*"),
        type("^(?:struct|class|enum|enum class|union) (\\w+)(?: final)?(?: : [^;{]*)? \\{.*"),
        constant("^inline (?:constexpr|const) [^={(]*\\b(\\w+)(?: =|\\{).*");
    std::vector<std::string> names, within;
    std::ifstream text(header);
    std::smatch match;
    for (std::string line; std::getline(text, line);) {
        if (std::regex_match(line, match, opens)) {
            within.push_back(match[1]);
        } else if (std::regex_match(line, closes) && !within.empty()) {
            within.pop_back();
        } else if ((std::regex_match(line, match, type) ||
                    std::regex_match(line, match, constant)) &&
                   within == std::vector<std::string>{"diurna "}) {
            names.push_back(match[1]);
        }
    }
    return names;
}

}  // namespace

TEST_CASE("a name means one type or constant in all headers", "[whole]") {
    std::map<std::string, fs::path> defined;
    for (const char* folder : {"materials", "terrain", "thermal", "render", "scenes"}) {
        for (const auto& entry :
             fs::recursive_directory_iterator(fs::path(DIURNA_SOURCE_DIR) / folder)) {
            if (entry.path().extension() != ".hpp") continue;
            for (const std::string& name : names_of(entry.path())) {
                const auto [before, is_new] = defined.try_emplace(name, entry.path());
                CAPTURE(name, before->second.string(), entry.path().string());
                CHECK(is_new);
            }
        }
    }
    CHECK(defined.size() > 300);
}
