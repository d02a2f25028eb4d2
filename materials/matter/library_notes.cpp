#include "materials/matter/library_notes.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <sstream>

#include "materials/base/files.hpp"

namespace diurna {

namespace {

std::string trimmed_text(std::string_view text) {
    const auto first = text.find_first_not_of(" \t\r");
    if (first == std::string_view::npos) return {};
    return std::string(text.substr(first, text.find_last_not_of(" \t\r") - first + 1));
}

/// Before and after the first '#' outside quotes.
struct Split {
    std::string_view code, comment;
};
Split split(std::string_view line) {
    bool quoted = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (line[i] == '"') quoted = !quoted;
        if (line[i] == '#' && !quoted) return {line.substr(0, i), line.substr(i + 1)};
    }
    return {line, {}};
}

bool is_tag(std::string_view word) {
    return word.size() >= 2 && std::all_of(word.begin(), word.end(), [](unsigned char c) {
               return std::isupper(c) != 0 || std::isdigit(c) != 0;
           });
}

bool is_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0; }

/// "like = "NAME"" of a line.
std::string like_of(std::string_view code) {
    if (!code.starts_with("like")) return {};
    const auto open = code.find('"'), close = code.rfind('"');
    if (open == std::string_view::npos || close == open) return {};
    return std::string(code.substr(open + 1, close - open - 1));
}

/// A line of the file's head into the list of sources.
void add_source(std::string_view comment, std::vector<SourceNote>& sources) {
    if (!comment.starts_with("   ")) return;
    const std::string text = trimmed_text(comment);
    const auto space = text.find("  ");
    const std::string word = text.substr(0, space);
    if (!comment.starts_with("    ") && space != std::string::npos && is_tag(word)) {
        sources.push_back({word, trimmed_text(text.substr(space))});
    } else if (comment.starts_with("      ") && !sources.empty()) {
        sources.back().text += " " + text;
    }
}

/// A number of the material's, not of a file's name or an index in quotes.
bool gives_number(std::string_view code) {
    bool quoted = false;
    char before = ' ';
    for (const char c : code) {
        if (c == '"') quoted = !quoted;
        if (!quoted && std::isdigit(static_cast<unsigned char>(c)) != 0 && !is_word(before) &&
            before != '_') {
            return true;
        }
        before = c;
    }
    return false;
}

}  // namespace

const MaterialNote* LibraryNotes::find(std::string_view name) const {
    const auto found = std::find_if(materials.begin(), materials.end(),
                                    [&](const MaterialNote& note) { return note.name == name; });
    return found == materials.end() ? nullptr : &*found;
}

LibraryNotes library_notes(const std::filesystem::path& file) {
    LibraryNotes notes;
    std::istringstream text(read_text(file));
    for (std::string line; std::getline(text, line);) {
        const auto [code, comment] = split(line);
        if (code.starts_with('[') && !code.starts_with("[[")) {
            const auto close = code.find(']');
            notes.materials.push_back({.name = std::string(code.substr(1, close - 1)),
                                       .what = trimmed_text(comment),
                                       .like = {},
                                       .lines = {}});
        } else if (notes.materials.empty()) {
            if (trimmed_text(code).empty()) add_source(comment, notes.sources);
        } else {
            MaterialNote& note = notes.materials.back();
            if (note.like.empty()) note.like = like_of(code);
            note.lines.push_back(line);
        }
    }
    // What stands before the next material's name, after an empty line, is a heading of the file.
    for (MaterialNote& note : notes.materials) {
        const auto empty = std::find(note.lines.begin(), note.lines.end(), "");
        note.lines.erase(empty, note.lines.end());
    }
    return notes;
}

bool names_source(std::string_view text, std::string_view tag) {
    for (std::size_t at = text.find(tag); at != std::string_view::npos;
         at = text.find(tag, at + 1)) {
        const bool begins = at == 0 || !is_word(text[at - 1]);
        const std::size_t end = at + tag.size();
        if (begins && (end == text.size() || !is_word(text[end]))) return true;
    }
    return false;
}

std::vector<std::string> lines_without_source(const MaterialNote& note) {
    std::vector<std::string> found;
    bool reported = false;  // by the line above
    for (const std::string& line : note.lines) {
        const auto [code, comment] = split(line);
        const bool alone = trimmed_text(code).empty();
        const bool here = !trimmed_text(comment).empty();
        if (!alone && gives_number(code) && !here && !reported) found.push_back(line);
        reported = alone && here;
    }
    return found;
}

std::vector<std::string> head_comment(const std::filesystem::path& file) {
    std::vector<std::string> lines;
    std::istringstream text(read_text(file));
    for (std::string line; std::getline(text, line) && line.starts_with('#');) {
        lines.push_back(trimmed_text(std::string_view(line).substr(1)));
    }
    return lines;
}

std::vector<std::string> spectra_of(const MaterialNote& note) {
    std::vector<std::string> files;
    for (const std::string& line : note.lines) {
        const std::string_view code = split(line).code;
        for (std::size_t at = code.find("\"spectra/"); at != std::string_view::npos;
             at = code.find("\"spectra/", at + 1)) {
            const auto close = code.find('"', at + 1);
            files.emplace_back(code.substr(at + 1, close - at - 1));
        }
    }
    return files;
}

}  // namespace diurna
