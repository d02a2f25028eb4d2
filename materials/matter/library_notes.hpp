#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace diurna {

/// The text of a library file about one material, comments included.
struct MaterialNote {
    std::string name;
    std::string what;                // the comment beside its name
    std::string like;                // the material it starts from; "" without one
    std::vector<std::string> lines;  // below its name, unchanged
};

/// A tag for a source in comments, and its full text.
struct SourceNote {
    std::string tag;  // "W93"
    std::string text;
};

/// The comments of a library file: the sources of its numbers.
struct LibraryNotes {
    std::vector<MaterialNote> materials;  // in the file's order
    std::vector<SourceNote> sources;

    /// Null if the file has no material of that name.
    const MaterialNote* find(std::string_view name) const;
};

/// Of a library file: materials begin with "[name]  # what it is"; sources are in its head as "#
/// TAG  text", with continuation lines indented further. Throws InputError if it cannot be read.
LibraryNotes library_notes(const std::filesystem::path& file);

/// Whether a text contains a tag as a separate word.
bool names_source(std::string_view text, std::string_view tag);

/// Lines of a note that give a number without a comment on the line, above it within its array or
/// right above it.
std::vector<std::string> lines_without_source(const MaterialNote& note);

/// The comment lines at the head of a file, without their '#'.
std::vector<std::string> head_comment(const std::filesystem::path& file);

/// Files of spectra that a note's lines name, relative to the library.
std::vector<std::string> spectra_of(const MaterialNote& note);

}  // namespace diurna
