#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "materials/base/error.hpp"

namespace diurna {

/// A TOML file read key by key: scene files, column files, material libraries.
///
/// Asking for a value checks its type and range; what is wrong is noted with file:line:column and
/// a harmless value is returned, so that one reading finds every mistake of a file. `finish()`
/// adds the keys nobody asked for, with the nearest key that was, and throws InputError if
/// there is any mistake. Nothing read may be used before `finish()` has returned.
class Document {
 public:
    /// Throws InputError at the first error of syntax.
    static Document from_file(const std::filesystem::path& file);
    static Document from_text(const std::string& text, const std::string& file);

    /// Puts a value in place of what the file says, or adds it: "time.step_s=300". What is no TOML
    /// value counts as a text. Throws InputError if a table on the way is none.
    void set(const std::string& setting);

    class Section root() const;
    void finish() const;

    struct State;  // hides the TOML library

 private:
    explicit Document(std::shared_ptr<State> state);
    std::shared_ptr<State> state_;
};

/// A table of a document. Cheap to copy; lives as long as any copy of it or the document.
class Section {
 public:
    static constexpr double infinity = std::numeric_limits<double>::infinity();

    bool has(const std::string& key) const;
    /// Keys present in the table, in the order of the file. Asking counts them all as known: for
    /// tables whose keys are free, such as the names of materials.
    std::vector<std::string> free_keys() const;

    double number(const std::string& key, double least = -infinity, double most = infinity) const;
    double number_or(const std::string& key, double fallback, double least = -infinity,
                     double most = infinity) const;
    int integer_or(const std::string& key, int fallback, int least, int most) const;
    std::string text(const std::string& key) const;
    std::string text_or(const std::string& key, const std::string& fallback) const;
    /// One of the given words; anything else is a mistake with the nearest word.
    std::string word_or(const std::string& key, const std::string& fallback,
                        const std::vector<std::string>& words) const;
    bool flag_or(const std::string& key, bool fallback) const;
    /// A moment with an offset (TOML date-time or quoted ISO 8601), as ISO 8601 text.
    std::string moment(const std::string& key) const;
    std::string moment_or(const std::string& key, const std::string& fallback) const;
    /// An array of numbers; `count` 0 means any length.
    std::vector<double> numbers(const std::string& key, std::size_t count = 0) const;
    std::vector<double> numbers_or(const std::string& key, std::vector<double> fallback,
                                   std::size_t count = 0) const;
    std::vector<std::string> texts_or(const std::string& key,
                                      std::vector<std::string> fallback) const;
    /// An array of arrays of `width` numbers, such as the corners of a polygon.
    std::vector<std::vector<double>> rows(const std::string& key, std::size_t width,
                                          std::size_t least_count = 1) const;
    /// A table; an empty one (with the mistake noted if `required`) where it is absent.
    Section section(const std::string& key, bool required = false) const;
    /// An array of tables ([[key]] or key = [{...}, {...}]); empty where absent.
    std::vector<Section> sections(const std::string& key) const;

    /// "file:line:column: path.to.key" of a key, or of the table itself for "".
    std::string where(const std::string& key = "") const;
    /// Notes a mistake the caller found.
    void mistake(const std::string& key, const std::string& problem,
                 const std::string& hint = "") const;

 private:
    friend class Document;
    friend struct Document::State;
    Section(std::shared_ptr<Document::State> state, const void* table, std::string path,
            bool missed = false);
    std::shared_ptr<Document::State> state_;
    const void* table_;  // toml::table, or null where the table is absent
    std::string path_;
    bool missed_;  // absent and noted as such: what it lacks is no further mistake
};

}  // namespace diurna
