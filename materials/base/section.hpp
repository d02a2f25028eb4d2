#pragma once

#include <concepts>
#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "materials/base/confines.hpp"
#include "materials/base/error.hpp"
#include "materials/base/key.hpp"

namespace diurna {

struct DocumentState;

/// The value of an absent key. `said` replaces it in scenes/KEYS.md where the value alone is
/// unclear: {radius, "radius_m"}.
template <class T>
struct Or {
    T value{};
    std::string said;

    Or() = default;
    template <class U>
    requires std::convertible_to<U, T> Or(U&& v, std::string text = "")
        : value(std::forward<U>(v)), said(std::move(text)) {}
};

/// A word and its value.
template <class T>
struct Choice {
    const char* word;
    T value;
};

/// Names that a key may give: a material's, a texture's. `where` ends the message for an unknown
/// one: no texture "grvel" in [[texture]]; the hint is the nearest name, or the entry of `instead`,
/// and `listed`, the command that lists them.
struct Names {
    std::string what;
    std::vector<std::string> known;
    std::string where = "";
    std::map<std::string, std::string> instead{};  // remedies for known wrong names
    std::string listed = "";                       // "`diurna materials` lists them"; or ""
};

/// A table of a document, read key by key. Cheap to copy; lives as long as any copy of it or the
/// document.
///
/// Every call names the key and says in one line what it means, so that scenes/KEYS.md and the
/// schema come from the readers themselves (`diurna keys`); units are those of the key's suffix.
///
///     section.number("width_m", "of the front, wall to wall", {0.5, 1000.0})
///     section.number_or("heading_deg", "the way its front faces, from north", 180.0, {-360, 360})
///     section.choice_or("voids", "posts without elevation", VoidPolicy::refuse,
///                       {{"refuse", VoidPolicy::refuse}, {"fill", VoidPolicy::fill}})
///
/// A key without `or` is required, unless has() was called for it before.
class Section {
 public:
    bool has(const std::string& key) const;
    /// Keys present in the table, in the order of the file. Counts them all as known: for tables
    /// with free keys, such as the names of materials.
    std::vector<std::string> free_keys() const;
    /// Counts all keys as known, if the word that determines them is missing.
    void pass_over() const;

    double number(const std::string& key, const char* says, Range range = {}) const;
    double number_or(const std::string& key, const char* says, Or<double> fallback,
                     Range range = {}) const;
    /// A number, or one of the given words; the other member is NaN or "".
    struct NumberOrWord {
        double number;
        std::string word{};
    };
    NumberOrWord number_or_word(const std::string& key, const char* says, Or<double> fallback,
                                Range range, const std::vector<std::string>& words) const;
    int integer_or(const std::string& key, const char* says, Or<int> fallback, Range range) const;
    std::string text(const std::string& key, const char* says) const;
    std::string text_or(const std::string& key, const char* says, Or<std::string> fallback) const;
    /// The file that a text names, relative to the document's folder. "" after a mistake: the file
    /// does not exist, or it is outside the document's confines (materials/base/confines.hpp).
    std::filesystem::path file(const std::string& key, const char* says) const;
    /// The files that a text or an array of texts names; empty after a mistake.
    std::vector<std::filesystem::path> files(const std::string& key, const char* says) const;
    /// The same for a name taken from a key's value.
    std::filesystem::path file_named(const std::string& key, const std::string& name) const;
    const Confines& confines() const;
    /// One of the known names; anything else is a mistake with the nearest name as hint.
    std::string name(const std::string& key, const char* says, const Names& names) const;
    std::string name_or(const std::string& key, const char* says, Or<std::string> fallback,
                        const Names& names) const;
    /// One of the given words; anything else is a mistake with the nearest word.
    std::string word_or(const std::string& key, const char* says, Or<std::string> fallback,
                        const std::vector<std::string>& words) const;
    /// The value of one of the given words.
    template <class T>
    T choice_or(const std::string& key, const char* says, const T& fallback,
                const std::type_identity_t<std::vector<Choice<T>>>& choices) const;
    /// The word under `kind`, which determines the other keys of the table: after an unknown word
    /// all keys are skipped.
    std::string kind_or(const char* says, const char* fallback,
                        const std::vector<std::string>& words) const;
    bool flag_or(const std::string& key, const char* says, bool fallback) const;
    /// A moment with an offset (TOML date-time or quoted ISO 8601), as ISO 8601 text.
    std::string moment(const std::string& key, const char* says) const;
    /// An array of numbers; `count` 0 means any length.
    std::vector<double> numbers(const std::string& key, const char* says,
                                std::size_t count = 0) const;
    std::vector<double> numbers_or(const std::string& key, const char* says,
                                   Or<std::vector<double>> fallback, std::size_t count = 0) const;
    /// That many numbers, or one of the given words, which is its default: no numbers then.
    std::vector<double> numbers_or_word(const std::string& key, const char* says,
                                        const std::string& word, std::size_t count,
                                        Range range) const;
    std::vector<std::string> texts_or(const std::string& key, const char* says,
                                      Or<std::vector<std::string>> fallback) const;
    /// An array of arrays of `width` numbers, such as the corners of a polygon.
    std::vector<std::vector<double>> rows(const std::string& key, const char* says,
                                          std::size_t width, std::size_t least_count = 1) const;
    /// An array of values of any kind, as JSON; with a `width` above 1 of arrays of that length.
    /// Must not be empty.
    std::vector<std::vector<std::string>> values(const std::string& key, const char* says,
                                                 std::size_t width) const;
    /// A table; an empty one where it is absent.
    Section section(const std::string& key, const char* says) const;
    /// The same, required: if absent, its keys are not reported as missing.
    Section required_section(const std::string& key, const char* says) const;
    /// An array of tables ([[key]] or key = [{...}, {...}]); empty where absent.
    std::vector<Section> sections(const std::string& key, const char* says) const;
    /// The same, or one table [key].
    std::vector<Section> one_or_more_sections(const std::string& key, const char* says) const;

    /// "file:line:column: path.to.key" of a key, or of the table itself for "".
    std::string where(const std::string& key = "") const;
    /// Whether a mistake in it has been reported, so that consequences are not reported too.
    bool has_mistakes() const;
    /// Notes a mistake the caller found.
    void mistake(const std::string& key, const std::string& problem,
                 const std::string& hint = "") const;

 private:
    friend class Document;
    Section(std::shared_ptr<DocumentState> state, const void* table, std::string path,
            std::string pattern, bool missed = false);
    /// Records in the document that the key is read, and returns whether it is present.
    bool ask(const std::string& key, const char* says, Key::Kind kind, Key more = {}) const;
    void missing(const std::string& key, const std::string& expected) const;
    /// The value of a key if it is valid, else the fallback.
    double checked_number(const std::string& key, double fallback, Range range) const;
    std::string checked_text(const std::string& key, const std::string& fallback) const;
    std::string checked_name(const std::string& key, const std::string& fallback,
                             const Names& names) const;
    std::vector<double> checked_numbers(const std::string& key, std::vector<double> fallback,
                                        std::size_t count) const;
    std::vector<Section> sections_of(const std::string& key, const std::string& pattern) const;
    Section inner(const std::string& key, const char* says, bool required) const;

    std::shared_ptr<DocumentState> state_;
    const void* table_;    // toml::table, or null where the table is absent
    std::string path_;     // "terrain.rule[0]"
    std::string pattern_;  // "terrain.rule[]"
    bool missed_;          // absent and reported as such: its keys are not reported
};

template <class T>
T Section::choice_or(const std::string& key, const char* says, const T& fallback,
                     const std::type_identity_t<std::vector<Choice<T>>>& choices) const {
    std::vector<std::string> words;
    std::string fallback_word;
    for (const Choice<T>& choice : choices) {
        words.emplace_back(choice.word);
        if (fallback_word.empty() && choice.value == fallback) fallback_word = choice.word;
    }
    const std::string word = word_or(key, says, fallback_word, words);
    for (const Choice<T>& choice : choices) {
        if (word == choice.word) return choice.value;
    }
    return fallback;
}

}  // namespace diurna
