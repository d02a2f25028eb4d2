#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "materials/base/key.hpp"

namespace diurna {

/// A key, combined from all its readings.
struct KeyEntry {
    enum class Need { optional, sometimes, always };

    std::string table;  // its table: "terrain.rule[]"; "" the root
    std::string name;   // "slope_deg"; "NAME": free
    Key::Kind kind = Key::Kind::tested;
    Need need = Need::optional;
    std::vector<std::string> says;       // the readings' descriptions, each once
    std::vector<std::string> fallbacks;  // values if absent
    std::vector<Range> ranges;           // allowed ranges of a number
    std::size_t count = 0;               // of numbers, or of a row's
    std::vector<std::string> words;
    std::string condition;  // when it is read: kind = "gloss" or "metal"; "": always

    std::string path() const { return table.empty() ? name : table + "." + name; }
};

/// Entries in the order of reading. Readings with different descriptions, ranges or fallbacks are
/// combined; the word on which a key depends is derived from where it was read and where not.
std::vector<KeyEntry> key_entries(std::span<const Key> asked);

/// Every key that the readers know, collected by reading the specimens.
struct KeyBook {
    std::vector<KeyEntry> scene;     // without those under `material`
    std::vector<KeyEntry> column;    // the same
    std::vector<KeyEntry> material;  // of [material.NAME] in scenes, [material] in columns, [NAME]
                                     // in libraries
};
KeyBook key_book();

/// The entries with names relative to the table `prefix`.
std::vector<KeyEntry> entries_within(const std::string& prefix, std::vector<KeyEntry> entries);

/// "W/m²K" of a key such as film_W_m2K, from its suffix; "" without one.
std::string unit_of(const std::string& key);

}  // namespace diurna
