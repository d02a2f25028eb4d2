#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "materials/base/confines.hpp"
#include "materials/base/key.hpp"
#include "materials/base/section.hpp"

namespace diurna {

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
    /// names with dots are put in double quotes. Throws InputError if the table does not exist or
    /// part of the path is no table.
    void set(const std::string& setting);
    /// The same with a value from elsewhere in the file, which is removed there: mistakes are
    /// reported at its original place.
    ///
    /// - from: its path, "sweep.axis.0.values.2"
    void move_value(const std::string& from, const std::string& to);
    /// Removes a key of the root.
    void drop(const std::string& key);

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
