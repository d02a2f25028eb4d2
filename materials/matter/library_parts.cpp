#include "materials/matter/library_parts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>

#include "materials/base/data_folder.hpp"
#include "materials/base/error.hpp"
#include "materials/matter/everyday_words.hpp"

namespace diurna {

namespace {

/// The library's file, which is only read from.
const Document& library_document() {
    static std::mutex guard;
    static std::map<std::filesystem::path, Document> known;
    const std::filesystem::path file = data_folder() / "library.toml";
    const std::lock_guard lock(guard);
    auto found = known.find(file);
    if (found == known.end()) found = known.emplace(file, Document::from_file(file)).first;
    return found->second;
}

/// Where a material's table is.
struct MaterialTable {
    const Document* document;
    KeyPath table;
};

MaterialTable table_of_library(const std::string& name) { return {&library_document(), {name}}; }

KeyPath with_word(KeyPath path, const std::string& word) {
    path.push_back(word);
    return path;
}

/// The material that one of the document starts from.
std::optional<MaterialTable> table_it_is_like(const MaterialTable& place, const Document& scene,
                                              MaterialTables tables) {
    const bool own = place.document == &scene;
    const std::string like = place.document->text_at(with_word(place.table, "like"));
    const std::string name = own ? place.document->text_at(with_word(place.table, "name")) : "";
    if (!own) return like.empty() ? std::nullopt : std::optional(table_of_library(like));
    if (tables == MaterialTables::one) return table_of_library(like.empty() ? name : like);
    const std::string& self = place.table.back();
    const std::string& base = !like.empty() ? like : !name.empty() ? name : self;
    if (base != self && scene.holds({"material", base}))
        return MaterialTable{&scene, {"material", base}};
    return table_of_library(base);
}

/// The nearest of the materials that one is `like` that has this part; nothing if it has it itself,
/// or none does.
std::optional<MaterialTable> table_of_part(const Document& document, const KeyPath& table,
                                           const std::string& part, MaterialTables tables) {
    std::set<std::pair<const Document*, KeyPath>> seen;
    std::optional<MaterialTable> place = MaterialTable{&document, table};
    while (place && seen.insert({place->document, place->table}).second) {
        const KeyPath path = with_word(place->table, part);
        if (place->document->holds(path)) {
            const bool itself = place->document == &document && place->table == table;
            if (itself || !place->document->holds_parts(path)) return std::nullopt;
            return place;
        }
        place = table_it_is_like(*place, document, tables);
    }
    return std::nullopt;
}

/// Copies the table or array that a path leads into, if the document does not have it.
void add_part(Document& document, const std::string& path, MaterialTables tables) {
    const KeyPath words = key_path(path);
    const std::size_t before = tables == MaterialTables::one ? 1 : 2;  // words of the table
    if (words.size() < before + 2 || words.front() != "material") return;
    const KeyPath table(words.begin(), words.begin() + std::ptrdiff_t(before));
    const std::string& part = words[before];
    const auto place = table_of_part(document, table, part, tables);
    if (!place) return;
    document.copy_value(*place->document, with_word(place->table, part), with_word(table, part));
}

/// Materials that the file had before settings, to recognise misspelt names.
class NamedMaterials {
 public:
    NamedMaterials(const Document& document, MaterialTables tables)
        : known_(document.keys_at({"material"})), one_(tables == MaterialTables::one) {}

    /// Throws InputError if the path is of a material that nobody has and that is no whole new one.
    ///
    /// - where: of the setting
    void check(const Document& document, const std::string& path, const std::string& where) const {
        const KeyPath words = key_path(path);
        if (one_ || words.size() < 2 || words.front() != "material") return;
        const std::string& name = words[1];
        std::vector<std::string> known = library_document().keys_at({});
        known.insert(known.end(), known_.begin(), known_.end());
        if (std::find(known.begin(), known.end(), name) != known.end()) return;
        for (const char* of_new : {"like", "name", "layers"}) {
            const KeyPath key{"material", name, of_new};
            const bool only_a_part = !document.keys_at(key).empty();  // layers.0 made a table
            if (document.holds(key) && !only_a_part) return;
        }
        const auto word = everyday_words().find(name);
        std::string hint = word != everyday_words().end() ? "did you mean '" + word->second + "'?"
                                                          : did_you_mean(name, known);
        if (!hint.empty()) hint += ' ';
        throw InputError(where, fmt::format("unknown material \"{}\"", name),
                         hint + "`diurna materials` lists the library");
    }

 private:
    std::vector<std::string> known_;
    bool one_;
};

}  // namespace

void apply_settings(Document& document, const std::vector<std::string>& settings,
                    MaterialTables tables) {
    if (settings.empty()) return;
    const NamedMaterials named(document, tables);
    const auto path_of = [](const std::string& setting) {
        return setting.substr(0, setting.find('='));
    };
    for (const std::string& setting : settings) {
        add_part(document, path_of(setting), tables);
        document.set(setting);
    }
    for (const std::string& setting : settings) {
        named.check(document, path_of(setting), "--set " + path_of(setting));
    }
}

void move_values(Document& document, const std::vector<ValueMove>& moves, MaterialTables tables) {
    const NamedMaterials named(document, tables);
    for (const auto& [from, to] : moves) {
        add_part(document, to, tables);
        document.move_value(from, to);
    }
    for (const auto& [from, to] : moves) {
        named.check(document, to, document.file() + ": sweep.axis: " + to);
    }
}

}  // namespace diurna
