#include "scenes/job/keys/keys_page.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "materials/base/article.hpp"

namespace diurna {

namespace {

constexpr const char* preface =
    R"md(# The keys of scene files, column files and materials

Printed by `diurna keys` from the descriptions in the program; `diurna keys --schema` prints a JSON Schema, with which
editors of TOML check and complete keys. A heading is the path of a table: `[a.b]` occurs once, `[[a.b]]` any number of
times; the author of the file chooses the name where a heading has `NAME`. The suffix of a key gives its unit. Places are
metres east and north of the site, headings clockwise from north. "required": the key must be present; "(required)": in
the cases that the description names. `diurna check SCENE` reports every error of a file with its place and the nearest
key.
)md";

/// "[[terrain.rule]]" of "terrain.rule[]".
std::string heading(const std::string& table) {
    if (table.empty()) return "the file itself";
    std::string path = table;
    const bool many = path.ends_with("[]");
    for (std::size_t at = path.find("[]"); at != std::string::npos; at = path.find("[]")) {
        path.erase(at, 2);
    }
    return many ? "`[[" + path + "]]`" : "`[" + path + "]`";
}

std::string type_of(const KeyEntry& entry) {
    switch (entry.kind) {
        case Key::Kind::number:
            return entry.words.empty() ? "number" : "number or word";
        case Key::Kind::whole:
            return "whole number";
        case Key::Kind::text:
            return "text";
        case Key::Kind::name:
            return "name of " + with_article(entry.words.front());
        case Key::Kind::word:
            return "word";
        case Key::Kind::flag:
            return "true or false";
        case Key::Kind::moment:
            return "instant";
        case Key::Kind::numbers:
            return (entry.count == 0 ? "numbers" : fmt::format("{} numbers", entry.count)) +
                   (entry.words.empty() ? "" : " or word");
        case Key::Kind::texts:
            return "texts";
        case Key::Kind::files:
            return "text or texts";
        case Key::Kind::rows:
            return fmt::format("rows of {} numbers", entry.count);
        case Key::Kind::values:
            return "values";
        default:
            return "";
    }
}

std::string default_of(const KeyEntry& entry) {
    const bool reported = entry.need == KeyEntry::Need::always ||
                          (entry.need == KeyEntry::Need::sometimes && !entry.condition.empty());
    if (reported) return "required";
    if (entry.need == KeyEntry::Need::sometimes) return "(required)";
    return entry.fallbacks.empty() ? "–" : fmt::format("{}", fmt::join(entry.fallbacks, " or "));
}

std::string range_of(const KeyEntry& entry) {
    if (entry.kind == Key::Kind::word) return fmt::format("{}", fmt::join(entry.words, ", "));
    std::vector<std::string> texts;
    for (const Range& range : entry.ranges) {
        const bool below = std::isinf(range.least), above = std::isinf(range.most);
        if (below && above) continue;
        texts.push_back(above   ? fmt::format("{:.10g} or more", range.least)
                        : below ? fmt::format("at most {:.10g}", range.most)
                                : fmt::format("{:.10g} to {:.10g}", range.least, range.most));
    }
    if (entry.kind == Key::Kind::number || entry.kind == Key::Kind::numbers) {
        texts.insert(texts.end(), entry.words.begin(), entry.words.end());
    }
    return fmt::format("{}", fmt::join(texts, " or "));
}

std::string meaning_of(const KeyEntry& entry) {
    std::string says = fmt::format("{}", fmt::join(entry.says, "; "));
    return entry.condition.empty() ? says : fmt::format("with {}: {}", entry.condition, says);
}

bool is_table(const KeyEntry& entry) {
    return entry.kind == Key::Kind::table || entry.kind == Key::Kind::tables;
}

std::string capitalised(std::string text) {
    if (!text.empty()) text[0] = static_cast<char>(std::toupper(text[0]));
    return text;
}

/// A section for every table of the entries: what it is, then its keys.
std::string chapter(const std::vector<KeyEntry>& entries, const std::string& base) {
    std::string out;
    const auto keys_of = [&](const std::string& table) {
        std::string rows;
        for (const KeyEntry& entry : entries) {
            if (entry.table != table || is_table(entry)) continue;
            const bool measured = entry.kind == Key::Kind::number ||
                                  entry.kind == Key::Kind::numbers || entry.kind == Key::Kind::rows;
            rows += fmt::format("| `{}` | {} | {} | {} | {} | {} |\n", entry.name, type_of(entry),
                                measured ? unit_of(entry.name) : "", default_of(entry),
                                range_of(entry), meaning_of(entry));
        }
        if (rows.empty()) return rows;
        return "\n| key | type | unit | default | range or words | meaning |\n"
               "|---|---|---|---|---|---|\n" +
               rows;
    };
    out += keys_of("");
    for (const KeyEntry& entry : entries) {
        if (!is_table(entry)) continue;
        const std::string table = entry.path() + (entry.kind == Key::Kind::tables ? "[]" : "");
        const std::string path = base.empty() ? table : base + "." + table;
        const bool required = entry.need == KeyEntry::Need::always;
        out += fmt::format("\n### {}\n\n{}{}.\n{}", heading(path), capitalised(meaning_of(entry)),
                           required ? "; required" : "", keys_of(table));
    }
    return out;
}

}  // namespace

std::string keys_page(const KeyBook& book) {
    std::string out = preface;
    out += "\n## Scene files\n" + chapter(book.scene, "");
    out += "\n## Column files\n" + chapter(book.column, "");
    out +=
        "\n## Materials\n\nThe keys of `[material.NAME]` in a scene, of `[material]` in a column "
        "file and of `[NAME]` in a library such as\n`materials/library.toml`, which has "
        "the values of the program's materials with their sources.\n";
    out += chapter(book.material, "NAME");
    return out;
}

}  // namespace diurna
