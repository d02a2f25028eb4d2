#include "scenes/job/keys/key_book.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <utility>

#include "materials/base/document.hpp"
#include "materials/base/error.hpp"
#include "materials/matter/read_library.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/keys/specimens.hpp"
#include "thermal/point/point_job_file.hpp"

namespace diurna {

namespace {

std::string table_of(const std::string& path) {
    const std::size_t dot = path.rfind('.');
    return dot == std::string::npos ? "" : path.substr(0, dot);
}

template <class T>
void add_once(std::vector<T>& to, const T& value) {
    if (std::find(to.begin(), to.end(), value) == to.end()) to.push_back(value);
}

/// What was asked of the tables of one path: which of them there were, which words they chose and
/// in which of them a key was asked for.
struct KeyReadings {
    std::map<std::string, std::map<std::string, std::string>>
        chosen;                                             // (table) words by their keys
    std::map<std::string, std::set<std::string>> asked;     // (key's path) tables
    std::map<std::string, std::set<std::string>> required;  // (key's path) tables

    void add(const Key& key) {
        auto& words = chosen[key.table];
        for (const auto& [word_key, word] : key.chosen) words[word_key] = word;
        if (key.kind == Key::Kind::tested) return;
        asked[key.path].insert(key.table);
        if (key.required) required[key.path].insert(key.table);
    }

    KeyEntry::Need need(const std::string& path) const {
        const auto found = required.find(path);
        if (found == required.end()) return KeyEntry::Need::optional;
        return found->second.size() == chosen.size() ? KeyEntry::Need::always
                                                     : KeyEntry::Need::sometimes;
    }

    /// The words by which tables with a key differ from all that are without it.
    std::string condition(const std::string& path, const Key& first) const {
        const std::set<std::string>& with = asked.at(path);
        // Where several would do, the word that was chosen last.
        for (auto last = first.chosen.rbegin(); last != first.chosen.rend(); ++last) {
            const std::string& word_key = last->first;
            std::set<std::string> words, others;
            for (const auto& [table, choices] : chosen) {
                const auto choice = choices.find(word_key);
                if (choice == choices.end()) continue;
                (with.contains(table) ? words : others).insert(choice->second);
            }
            const bool apart = std::none_of(words.begin(), words.end(), [&](const auto& word) {
                return others.contains(word);
            });
            if (others.empty() || !apart) continue;
            return fmt::format("{} = \"{}\"", word_key, fmt::join(words, "\" or \""));
        }
        return "";
    }
};

/// The keys that reading texts asks for; the tables of each text count apart.
template <class Read>
std::vector<Key> asked_by(const std::vector<std::string>& texts, const Read& read) {
    std::vector<Key> keys;
    for (const std::string& text : texts) {
        const Document document = Document::from_text(text, "specimen.toml");
        try {
            read(document);
        } catch (const InputError&) {
            // Specimens are full of mistakes; the keys were asked for all the same.
        }
        for (Key key : document.keys()) {
            key.table = fmt::format("{} {}", &text - texts.data(), key.table);
            keys.push_back(std::move(key));
        }
    }
    return keys;
}

void drop_within(const std::string& table, std::vector<KeyEntry>& entries,
                 const std::vector<KeyEntry>& known) {
    const std::vector<KeyEntry> there = entries_within(table, known);
    std::erase_if(entries, [&](const KeyEntry& entry) {
        return std::any_of(there.begin(), there.end(),
                           [&](const KeyEntry& k) { return k.path() == entry.path(); });
    });
}

}  // namespace

std::vector<KeyEntry> key_entries(std::span<const Key> asked) {
    std::map<std::string, KeyReadings> readings;  // (path of tables)
    for (const Key& key : asked) readings[table_of(key.path)].add(key);
    std::vector<KeyEntry> entries;
    std::map<std::string, std::size_t> place;  // (path)
    for (const Key& key : asked) {
        const std::string table = table_of(key.path);
        const auto [found, fresh] = place.try_emplace(key.path, entries.size());
        if (fresh) {
            const std::size_t begin = table.empty() ? 0 : table.size() + 1;
            entries.push_back({.table = table,
                               .name = key.path.substr(begin),
                               .says = {},
                               .fallbacks = {},
                               .ranges = {},
                               .words = {},
                               .condition = {}});
        }
        if (key.kind == Key::Kind::tested) continue;
        KeyEntry& entry = entries[found->second];
        if (entry.kind == Key::Kind::tested) {
            entry.kind = key.kind;
            entry.count = key.count;
            entry.need = readings[table].need(key.path);
            entry.condition = readings[table].condition(key.path, key);
        }
        if (!key.says.empty()) add_once(entry.says, key.says);
        if (!key.fallback.empty()) add_once(entry.fallbacks, key.fallback);
        for (const std::string& word : key.words) add_once(entry.words, word);
        const auto same = [&](Range r) {
            return r.least == key.range.least && r.most == key.range.most;
        };
        if (std::none_of(entry.ranges.begin(), entry.ranges.end(), same)) {
            entry.ranges.push_back(key.range);
        }
    }
    return entries;
}

std::vector<KeyEntry> entries_within(const std::string& prefix, std::vector<KeyEntry> entries) {
    for (KeyEntry& entry : entries) {
        entry.table = entry.table.empty() ? prefix : prefix + "." + entry.table;
    }
    return entries;
}

KeyBook key_book() {
    KeyBook book;
    const std::vector<Key> materials = asked_by(
        material_specimens, [](const Document& document) { read_material_library(document); });
    for (KeyEntry entry : key_entries(materials)) {
        if (entry.path() == "NAME") continue;  // the table itself
        entry.table = entry.table == "NAME" ? "" : entry.table.substr(std::string("NAME.").size());
        book.material.push_back(std::move(entry));
    }
    book.scene = key_entries(asked_by(scene_specimens, [](const Document& d) { read_scene(d); }));
    drop_within("material.NAME", book.scene, book.material);
    book.column =
        key_entries(asked_by(column_specimens, [](const Document& d) { read_column_job(d); }));
    drop_within("material", book.column, book.material);
    return book;
}

std::string unit_of(const std::string& key) {
    // The longest suffix wins; "_K3" is of a coefficient.
    static const std::array<std::pair<const char*, const char*>, 32> units = {{
        {"_kg_m3", "kg/m³"}, {"_J_kgK", "J/kgK"}, {"_W_m2K", "W/m²K"}, {"_per_m", "1/m"},
        {"_kg_s", "kg/s"},   {"_W_m2", "W/m²"},   {"_W_mK", "W/mK"},   {"_m_s", "m/s"},
        {"_s_m", "s/m"},     {"_mm_h", "mm/h"},   {"_deg", "°"},       {"_ppm", "ppm"},
        {"_km", "km"},       {"_mm", "mm"},       {"_cm", "cm"},       {"_um", "µm"},
        {"_K3", "1/K³"},     {"_per_h", "1/h"},   {"_m", "m"},         {"_s", "s"},
        {"_h", "h"},         {"_W_K", "W/K"},     {"_J_K", "J/K"},     {"_m3", "m³"},
        {"_W", "W"},         {"_K", "K"},         {"_mK", "mK"},       {"_ms", "ms"},
        {"_min", "min"},     {"_Hz", "Hz"},       {"_mrad", "mrad"},   {"_fF", "fF"},
    }};
    for (const auto& [suffix, unit] : units) {
        if (key.ends_with(suffix)) return unit;
    }
    return key == "metres_per_texel" ? "m" : "";
}

}  // namespace diurna
