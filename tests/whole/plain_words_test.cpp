#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// What a user reads is plain technical English: the texts of the sources (messages, notes,
// progress, help, descriptions of keys) and the pages that the program prints hold none of the
// words below, which readers who did not know the program had to read twice.

namespace {

namespace fs = std::filesystem;

const fs::path root = DIURNA_SOURCE_DIR;

struct Phrase {
    const char *held_out, *instead;
};

constexpr auto phrases = std::to_array<Phrase>({
    {"told", "reported, printed, warned"},
    {"tells", "reports, prints, warns"},
    {"asked for", "requested"},
    {"asks for", "requests, needs"},
    {"wanted", "requested"},
    {"anew", "recomputed, regenerated"},
    {"amiss", "wrong, missing, changed"},
    {"hardly", "implausible, not"},
    {"doubt", "implausible, warning"},
    {"doubts", "warnings"},
    {"what goes", "moving object, trajectory"},
    {"goes", "moves, is, leads"},
    {"on its way", "moving, on its trajectory"},
    {"on their way", "moving, on their trajectories"},
    {"stand for", "represent"},
    {"stands for", "represents"},
    {"stand in", "replace"},
    {"stood", "was"},
    {"stands beside", "cannot be combined with"},
    {"of its kind", "its representative"},
    {"of their kind", "their representative"},
    {"its like", "its representative"},
    {"the like", "representative"},
    {"likewise", "the same text again"},
    {"felt", "thermally coupled"},
    {"feel", "thermally coupled"},
    {"left out", "skipped, omitted"},
    {"leave out", "remove, omit"},
    {"has been found", "converged"},
    {"is not found", "not converged"},
    {"have found", "computed, from cache"},
    {"earlier runs have", "from cache"},
    {"worth", "changes the temperature by"},
    {"not ours", "third-party"},
    {"light up", "illumination"},
    {"shine", "illumination, emission"},
    {"shines", "illuminates, emits"},
    {"luminary", "light source"},
    {"hop", "secondary ray"},
    {"hops", "secondary rays"},
    {"stray", "outlier"},
    {"at best", "lowest, highest"},
    {"at the least", "at least, lowest"},
    {"at the most", "at most, largest"},
    {"nought", "zero"},
    {"mend", "repair, remedy"},
    {"mends", "repairs"},
    {"made up", "generated"},
    {"makes of", "computes from"},
    {"passed over", "skipped"},
    {"is none", "does not exist"},
    {"there is none", "does not exist"},
    {"to whom", "the observer that sees"},
    {"needed of", "required if"},
    {"but for", "except"},
    {"the other way round", "exchanged"},
    {"as it stands", "unchanged"},
    {"as they stand", "unchanged"},
    {"kept", "stored, reused, from cache"},
    {"another past", "earlier weather"},
    {"a day less", "one day less"},
    {"knows nothing", "does not apply"},
    {"knows plain", "supports"},
    {"rests", "is at rest"},
    {"look so", "are seen"},
    {"lies elsewhere", "is outside"},
    {"whence", "from which"},
    {"whither", "to which"},
    {"hence", "so"},
    {"thus", "so"},
    {"upon", "on"},
});

/// Words that programs of others look for.
constexpr std::array<std::pair<const char*, const char*>, 1> allowed{{
    {"land.cpp", "left out"},
}};

bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(), [](char c) {
        return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    });
    return text;
}

/// The first phrase of the list that a text holds as words of its own; null where it holds none.
const Phrase* found_in(const std::string& text) {
    const std::string line = lower(text);
    for (const Phrase& phrase : phrases) {
        const std::string_view word = phrase.held_out;
        for (std::size_t at = line.find(word); at != std::string::npos;
             at = line.find(word, at + 1)) {
            const std::size_t end = at + word.size();
            if ((at > 0 && is_letter(line[at - 1])) || (end < line.size() && is_letter(line[end])))
                continue;
            return &phrase;
        }
    }
    return nullptr;
}

struct Literal {
    std::size_t line;
    std::string text;
};

/// The string literals of a source, adjacent ones joined; no comments, no names of includes.
std::vector<Literal> literals_of(const std::string& source) {
    std::vector<Literal> found;
    std::size_t line = 1, after = std::string::npos;  // where the literal before has ended
    const auto blank_since = [&](std::size_t from, std::size_t to) {
        return std::all_of(source.begin() + std::ptrdiff_t(from),
                           source.begin() + std::ptrdiff_t(to),
                           [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; });
    };
    for (std::size_t i = 0; i < source.size(); ++i) {
        const std::size_t begin = i, begins_on = line;
        std::size_t end = i;
        std::string text;
        if (source.compare(i, 2, "//") == 0 || source.compare(i, 8, "#include") == 0) {
            i = std::min(source.find('\n', i), source.size()) - 1;
            continue;
        }
        if (source[i] == '\'' && i + 2 < source.size() &&
            (i == 0 || !std::isalnum(source[i - 1]))) {
            i = source.find('\'', i + (source[i + 1] == '\\' ? 3 : 2));
            continue;
        }
        if (source.compare(i, 2, "R\"") == 0 && (i == 0 || !is_letter(source[i - 1]))) {
            const std::size_t open = source.find('(', i);
            const std::string close = ")" + source.substr(i + 2, open - i - 2) + "\"";
            end = source.find(close, open);
            text = source.substr(open + 1, end - open - 1);
            end += close.size();
        } else if (source[i] == '"') {
            for (end = i + 1; source[end] != '"'; ++end) {
                if (source[end] == '\\') ++end;
            }
            text = source.substr(i + 1, end - i - 1);
            ++end;
        } else {
            line += source[i] == '\n';
            continue;
        }
        line += std::size_t(std::count(source.begin() + std::ptrdiff_t(begin),
                                       source.begin() + std::ptrdiff_t(end), '\n'));
        if (after != std::string::npos && blank_since(after, begin)) {
            found.back().text += text;
        } else {
            found.push_back({begins_on, text});
        }
        after = end;
        i = end - 1;
    }
    return found;
}

std::string text_of(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

bool is_allowed(const fs::path& file, const Phrase& phrase) {
    return std::any_of(allowed.begin(), allowed.end(), [&](const auto& one) {
        return file.filename() == one.first && std::string_view(phrase.held_out) == one.second;
    });
}

}  // namespace

TEST_CASE("texts of sources are found: joined, without comments", "[whole][words]") {
    const auto found = literals_of(
        "#include \"told.hpp\"\n// \"told\"\nf('\"', \"a \"\n  \"b\", R\"(c\nd)\");\ng(\"e\");\n");
    REQUIRE(found.size() == 3);
    CHECK(found[0].text == "a b");
    CHECK(found[0].line == 3);
    CHECK(found[1].text == "c\nd");
    CHECK(found[2].line == 6);
    CHECK(found_in("24 files Amiss") != nullptr);
    CHECK(found_in("hopeful, untold and felting are words of their own") == nullptr);
}

TEST_CASE("names of tests are in plain words", "[whole][words]") {
    std::size_t names = 0;
    for (const auto& entry : fs::recursive_directory_iterator(root / "tests")) {
        if (!entry.path().filename().string().ends_with("_test.cpp")) continue;
        const std::string source = text_of(entry.path());
        for (std::size_t at = source.find("\nTEST_CASE("); at != std::string::npos;
             at = source.find("\nTEST_CASE(", at + 1)) {
            const std::string name =
                literals_of(source.substr(at, source.find(") {", at) - at)).at(0).text;
            ++names;
            const Phrase* const phrase = found_in(name);
            if (phrase == nullptr) continue;
            FAIL_CHECK(entry.path().filename().string()
                       << ": \"" << name << "\": " << phrase->held_out
                       << "; instead: " << phrase->instead);
        }
    }
    CHECK(names > 1000);
}

TEST_CASE("texts that a user reads are in plain words", "[whole][words]") {
    std::size_t texts = 0;
    for (const char* folder : {"materials", "terrain", "thermal", "render", "scenes", "python"}) {
        for (const auto& entry : fs::recursive_directory_iterator(root / folder)) {
            const fs::path& file = entry.path();
            if (file.extension() != ".cpp" && file.extension() != ".hpp") continue;
            for (const Literal& literal : literals_of(text_of(file))) {
                if (literal.text.find(' ') == std::string::npos) continue;  // a name
                ++texts;
                const Phrase* const phrase = found_in(literal.text);
                if (phrase == nullptr || is_allowed(file, *phrase)) continue;
                FAIL_CHECK(fs::relative(file, root).string()
                           << ':' << literal.line << ": \"" << literal.text
                           << "\": " << phrase->held_out << "; instead: " << phrase->instead);
            }
        }
    }
    CHECK(texts > 3000);
}

TEST_CASE("pages that the program prints are in plain words", "[whole][words]") {
    for (const char* page :
         {"scenes/KEYS.md", "materials/LIBRARY.md", "tests/scenes/mistakes.md"}) {
        std::istringstream lines(text_of(root / page));
        std::size_t number = 0;
        for (std::string line; std::getline(lines, line);) {
            ++number;
            const Phrase* const phrase = found_in(line);
            if (phrase == nullptr) continue;
            FAIL_CHECK(page << ':' << number << ": " << line << ": " << phrase->held_out
                            << "; instead: " << phrase->instead);
        }
        CHECK(number > 20);
    }
}
