#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "materials/base/confines.hpp"
#include "materials/base/key.hpp"
#include "materials/base/section.hpp"

namespace diurna {

/// The words of a path: material, grass, layers, 0. Tables are named by their keys, elements of
/// arrays by `name` or number from 0.
using KeyPath = std::vector<std::string>;

/// Dots separate words, except within double quotes: object."truck 1.5".heading_deg.
KeyPath key_path(const std::string& text);

/// A TOML file read key by key: scene files, column files, material libraries.
///
/// Reading a value checks its type and range; a mistake is noted with file:line:column and a
/// harmless value is returned, so that one reading finds every mistake of a file. `finish()` adds
/// the keys that were never read, with the nearest known key, and throws InputError if there is any
/// mistake. Nothing read may be used before `finish()` has returned.
class Document {
 public:
    /// Files that it names must be within `confines`, by default its own folder. Throws InputError
    /// at the first syntax error.
    static Document from_file(const std::filesystem::path& file,
                              const std::optional<Confines>& confines = {});
    static Document from_text(const std::string& text, const std::string& file,
                              const std::optional<Confines>& confines = {});

    /// Replaces a value of the file, or adds it: "time.step_s=300". Text that is no TOML value
    /// counts as a string, unless it begins like a list, a table or a quoted string. One of several
    /// tables [[observer]] is selected by its name or its number from 0: "observer.east.width=320";
    /// names with dots are put in double quotes. A table that is the only one of its kind needs
    /// neither: "observer.width=320". Throws InputError if the table does not exist or part of the
    /// path is no table.
    void set(const std::string& setting);
    /// The same with a value from elsewhere in the file, which is removed there: mistakes are
    /// reported at its original place.
    ///
    /// - from: its path, "sweep.axis.0.values.2"
    void move_value(const std::string& from, const std::string& to);
    /// Copies a value of another document; what is at the path `to` is replaced. Files that its
    /// keys ("file", "index_file") name get absolute paths.
    void copy_value(const Document& from, const KeyPath& path, const KeyPath& to);
    /// Removes a key of the root.
    void drop(const std::string& key);
    /// Names for set() of the tables [[key]] that have none: the texts of these keys, joined by
    /// '-'; without keys, `key` itself.
    void name_tables(const std::string& key, const std::vector<std::string>& by);

    bool holds(const KeyPath& path) const;
    /// Whether it is a table or an array.
    bool holds_parts(const KeyPath& path) const;
    /// "" where there is no text.
    std::string text_at(const KeyPath& path) const;
    /// The keys of a table, sorted; none where there is no table.
    std::vector<std::string> keys_at(const KeyPath& path) const;

    /// The document's values, settings included, without some keys ("observer", "time.frames"): the
    /// same text for the same values, independent of layout and comments.
    std::string text_without(std::span<const char* const> keys) const;

    Section root() const;
    void finish() const;

    const std::string& file() const;
    const Confines& confines() const;
    /// The keys read so far, in that order.
    std::span<const Key> keys() const;

    /// For tests: called by every finish() of the process with that document's keys.
    static void watch(std::function<void(std::span<const Key>)> watcher);

 private:
    explicit Document(std::shared_ptr<DocumentState> state);
    std::shared_ptr<DocumentState> state_;
};

}  // namespace diurna
