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
/// Asking for a value checks its type and range; what is wrong is noted with file:line:column and
/// a harmless value is returned, so that one reading finds every mistake of a file. `finish()`
/// adds the keys nobody asked for, with the nearest key that was, and throws InputError if
/// there is any mistake. Nothing read may be used before `finish()` has returned.
class Document {
 public:
    /// What it names may be read within `confines`, by themselves those of its own folder. Throws
    /// InputError at the first error of syntax.
    static Document from_file(const std::filesystem::path& file,
                              const std::optional<Confines>& confines = {});
    static Document from_text(const std::string& text, const std::string& file,
                              const std::optional<Confines>& confines = {});

    /// Puts a value in place of what the file says, or adds it: "time.step_s=300". What is no TOML
    /// value counts as a text, unless it begins as a list, a table or a text in quotes does. Of
    /// several tables [[observer]] one is called by its name or its number from 0:
    /// "observer.east.width=320"; names with dots stand between double quotes. Throws InputError if
    /// there is none, or if what is on the way is no table.
    void set(const std::string& setting);
    /// The same with a value that stands elsewhere in the file, which is gone from there: mistakes
    /// are reported of that place.
    ///
    /// - from: its path, "sweep.axis.0.values.2"
    void move_value(const std::string& from, const std::string& to);
    /// Takes a key of the root away.
    void drop(const std::string& key);

    /// What it says, settings included, but for some keys ("observer", "time.frames"): the same
    /// text for the same values, however they are laid out and whatever comments stand beside them.
    std::string text_without(std::span<const char* const> keys) const;

    Section root() const;
    void finish() const;

    const std::string& file() const;
    const Confines& confines() const;
    /// What was asked for so far, in that order.
    std::span<const Key> keys() const;

    /// For tests: called by every finish() of the process with that document's keys.
    static void watch(std::function<void(std::span<const Key>)> watcher);

 private:
    explicit Document(std::shared_ptr<DocumentState> state);
    std::shared_ptr<DocumentState> state_;
};

}  // namespace diurna
