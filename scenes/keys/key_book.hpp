#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "materials/base/key.hpp"

namespace diurna {

/// A key as all its readings together tell.
struct KeyEntry {
    enum class Need { optional, sometimes, always };

    std::string table;  // that it stands in: "terrain.rule[]"; "" the root
    std::string name;   // "slope_deg"; "NAME": free
    Key::Kind kind = Key::Kind::tested;
    Need need = Need::optional;
    std::vector<std::string> says;       // what the readings say of it, each once
    std::vector<std::string> fallbacks;  // in place of an absent one
    std::vector<Range> ranges;           // that a number may lie in
    std::size_t count = 0;               // of numbers, or of a row's
    std::vector<std::string> words;
    std::string condition;  // of asking for it at all: kind = "gloss" or "metal"; "": always

    std::string path() const { return table.empty() ? name : table + "." + name; }
};

/// Entries in the order of asking. Readings with different lines, ranges or fallbacks are put
/// together; what word a key depends on is found from where it was asked for and where not.
std::vector<KeyEntry> key_entries(std::span<const Key> asked);

/// Every key that the readers know, found by letting them read the specimens.
struct KeyBook {
    std::vector<KeyEntry> scene;     // without what stands under `material`
    std::vector<KeyEntry> column;    // likewise
    std::vector<KeyEntry> material;  // of [material.NAME] in scenes, [material] in columns, [NAME]
                                     // in libraries
};
KeyBook key_book();

/// The entries as they stand in the table `prefix`.
std::vector<KeyEntry> entries_within(const std::string& prefix, std::vector<KeyEntry> entries);

/// "W/m²K" of a key such as film_W_m2K, from its suffix; "" where it has none.
std::string unit_of(const std::string& key);

}  // namespace diurna
