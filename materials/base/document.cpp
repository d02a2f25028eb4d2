#include "materials/base/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <sstream>
#include <string_view>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "materials/base/document_state.hpp"
#include "materials/base/files.hpp"
#include "materials/base/syntax_hints.hpp"

namespace diurna {

namespace {

/// Notes the keys of a table, and of those in it, that no reader requested.
void note_unasked(DocumentState& state, const toml::table& table, const std::string& path) {
    const auto found = state.table.find(path);
    if (found == state.table.end()) return;  // the reader stopped at a mistake above it
    const std::set<std::string>& asked = found->second.asked;
    const std::vector<std::string> known(asked.begin(), asked.end());
    for (const auto& [key, node] : table) {
        const std::string name(key.str());
        const std::string inner = joined_path(path, name);
        if (!asked.contains(name)) {
            // Looking for the nearest of many takes long; nobody is reported more than the first
            // ones.
            const bool reported = state.mistakes.size() < 10 * most_mistakes_reported;
            std::string hint = reported ? did_you_mean(name, known) : "";
            if (reported && hint.empty())
                hint = fmt::format("known keys: {}", fmt::join(known, ", "));
            state.note(key.source(), inner, "unknown key", hint);
        } else if (const toml::table* one = node.as_table()) {
            note_unasked(state, *one, inner);
        } else if (const toml::array* array = node.as_array()) {
            for (std::size_t i = 0; i < array->size(); ++i) {
                if (const toml::table* one_of = (*array)[i].as_table()) {
                    note_unasked(state, *one_of, fmt::format("{}[{}]", inner, i));
                }
            }
        }
    }
}

std::string text_of(const toml::table* table, std::string_view key) {
    const toml::node* text = table != nullptr ? table->get(key) : nullptr;
    return text != nullptr && text->is_string() ? text->as_string()->get() : "";
}

/// Its `name`; of a table without one, that of Document::name_tables.
///
/// - by: keys that make its name; null: there are none
std::string name_of(const toml::node& node, const std::string& kind,
                    const std::vector<std::string>* by) {
    const toml::table* table = node.as_table();
    const std::string name = text_of(table, "name");
    if (!name.empty() || by == nullptr || table == nullptr) return name;
    if (by->empty()) return kind;
    std::string joined;
    for (const std::string& key : *by) {
        const std::string text = text_of(table, key);
        if (text.empty()) return "";
        joined += (joined.empty() ? "" : "-") + text;
    }
    for (char& c : joined) {
        if (c == ' ' || c == '/' || c == ':') c = '_';
    }
    return joined;
}

/// - kind: the array's key
std::vector<std::string> names_of(const toml::array& tables, const std::string& kind,
                                  const DocumentState& state) {
    const auto by = state.usual_name.find(kind);
    std::vector<std::string> names;
    for (const toml::node& table : tables) {
        names.push_back(name_of(table, kind, by != state.usual_name.end() ? &by->second : nullptr));
    }
    return names;
}

/// What a word of a path leads to: a key of a table; of an array the element of that name or
/// number. Null where there is none.
///
/// - names: of an array's elements
toml::node* inner(toml::node& node, const std::string& word,
                  const std::vector<std::string>& names = {}) {
    if (toml::table* table = node.as_table()) return table->get(word);
    toml::array* array = node.as_array();
    if (array == nullptr) return nullptr;
    const auto named = std::find(names.begin(), names.end(), word);
    if (!word.empty() && named != names.end()) return &(*array)[std::size_t(named - names.begin())];
    std::size_t number = 0;
    const char* end = word.data() + word.size();
    const auto [read, error] = std::from_chars(word.data(), end, number);
    const bool whole = error == std::errc{} && read == end;
    return whole && number < array->size() ? &(*array)[number] : nullptr;
}

/// The node at a path; null where there is none.
toml::node* node_at(DocumentState& state, const KeyPath& path) {
    toml::node* node = &state.root;
    for (std::size_t i = 0; i < path.size() && node != nullptr; ++i) {
        const toml::array* array = node->as_array();
        node = inner(*node, path[i],
                     array != nullptr && i > 0 ? names_of(*array, path[i - 1], state)
                                               : std::vector<std::string>{});
    }
    return node;
}

/// "by name or number: 0 east, 1 west", of many the first; "by number: 0 to 2" without names.
std::string reported_names(const std::vector<std::string>& names) {
    constexpr std::size_t most = 8;
    const bool named =
        std::any_of(names.begin(), names.end(), [](const auto& name) { return !name.empty(); });
    if (!named) {
        return names.size() < 2 ? "by number: 0"
                                : fmt::format("by number: 0 to {}", names.size() - 1);
    }
    std::string text = "by name or number: ";
    for (std::size_t i = 0; i < names.size() && i < most; ++i) {
        text += fmt::format("{}{} {}", i > 0 ? ", " : "", i,
                            names[i].empty() ? "without a name" : names[i]);
    }
    return names.size() > most ? text + fmt::format(" ... of {}", names.size()) : text;
}

/// Of an array of one table, whether a path that omits its name continues in it: `word` is a key.
bool continues_in_only(toml::array& array, const std::string& word, bool last) {
    if (array.size() != 1) return false;
    const toml::table* only = array[0].as_table();
    return only != nullptr && (last || only->contains(word));
}

/// The table that a path's last word is a key of; tables that are not there are added.
std::pair<toml::table*, std::string> table_at(DocumentState& state, const std::string& path,
                                              const std::string& where) {
    const KeyPath words = key_path(path);
    toml::table* table = &state.root;
    for (std::size_t i = 0; i + 1 < words.size(); ++i) {
        table->insert(words[i], toml::table{});  // does nothing where the key is there
        toml::node* node = table->get(words[i]);
        if (toml::array* array = node->as_array(); array != nullptr) {
            const std::vector<std::string> names = names_of(*array, words[i], state);
            const std::string& word = words[i + 1];
            const bool last = i + 2 >= words.size();
            toml::node* element = inner(*node, word, names);
            if (element == nullptr && continues_in_only(*array, word, last)) {
                node = &(*array)[0];
            } else if (last) {
                throw InputError(
                    where,
                    fmt::format("does not name a key of one of '{}', expected {}.NAME.{}", words[i],
                                words[i], words.back()),
                    reported_names(names));
            } else if (element == nullptr) {
                const std::string hint = did_you_mean(word, names);
                throw InputError(where, fmt::format("unknown {} \"{}\"", words[i], word),
                                 hint.empty() ? reported_names(names) : hint);
            } else {
                node = element;
                ++i;
            }
        }
        table = node->as_table();
        if (table == nullptr) throw InputError(where, "'" + words[i] + "' is not a table");
    }
    return {table, words.back()};
}

/// Files that a copied value names, relative to `folder`, as absolute paths.
void name_absolutely(toml::node& node, const std::filesystem::path& folder) {
    if (toml::array* array = node.as_array()) {
        for (toml::node& one : *array) name_absolutely(one, folder);
    }
    toml::table* table = node.as_table();
    if (table == nullptr) return;
    for (auto&& [key, value] : *table) {
        if (toml::value<std::string>* text = value.as_string(); text != nullptr) {
            if (key.str().ends_with("file")) text->get() = (folder / text->get()).string();
        } else {
            name_absolutely(value, folder);
        }
    }
}

/// Throws InputError for more keys or values than memory is for, and for a key of more than a
/// hundred words: each is a table in the one before, and who reads or frees them calls itself. What
/// looks like one in a text of several lines is none, but no sentence has so many dots.
void check_limits(const std::string& text, const std::string& file) {
    constexpr std::size_t most_words = 100, most_bytes = 4096;
    constexpr std::ptrdiff_t most_keys = 200'000, most_values = 4'000'000;
    for (const auto& [mark, most, what] :
         {std::tuple{'=', most_keys, "keys"}, {',', most_values, "values"}}) {
        const auto found = std::count(text.begin(), text.end(), mark);
        if (found <= most) continue;
        throw InputError(
            file, fmt::format("has {} '{}', expected at most {} {}", found, mark, most, what));
    }
    std::size_t line = 1;
    for (std::size_t begin = 0; begin < text.size(); ++line) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        std::string_view key = std::string_view(text).substr(begin, end - begin);
        begin = end + 1;
        // Keys go on to the sign of equality or the bracket; inline tables' stand within braces.
        std::size_t dots = 0, bytes = 0;
        bool quoted = false;
        char mark = '"';
        for (std::size_t i = 0; i < key.size(); ++i) {
            const char c = key[i];
            if (quoted && c == '\\' && mark == '"') {
                ++i;
                continue;
            }
            if (c == '"' || c == '\'') {
                if (!quoted) mark = c;
                if (c == mark) quoted = !quoted;
            }
            if (quoted) continue;
            if (c == '#') break;
            const bool ends = c == '=' || c == ',' || c == '{' || c == '}' || c == ']' || c == '[';
            dots = ends ? 0 : dots + (c == '.');
            bytes = ends ? 0 : bytes + 1;
            if (dots < most_words && bytes <= most_bytes) continue;
            throw InputError(fmt::format("{}:{}:{}", file, line, i + 1),
                             fmt::format("found a key of more than {} words or {} bytes",
                                         most_words, most_bytes));
        }
    }
}

/// The line of this number, from 1.
std::string_view line_of(std::string_view text, std::size_t number) {
    for (std::size_t line = 1; line < number && !text.empty(); ++line) {
        text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1);
    }
    return text.substr(0, text.find('\n'));
}

std::function<void(std::span<const Key>)>& watcher() {
    static std::function<void(std::span<const Key>)> none;
    return none;
}

}  // namespace

KeyPath key_path(const std::string& text) {
    KeyPath words{""};
    bool quoted = false;
    for (const char c : text) {
        if (c == '"') {
            quoted = !quoted;
        } else if (c == '.' && !quoted) {
            words.emplace_back();
        } else {
            words.back() += c;
        }
    }
    return words;
}

Document::Document(std::shared_ptr<DocumentState> state) : state_(std::move(state)) {}

Document Document::from_file(const std::filesystem::path& file,
                             const std::optional<Confines>& confines) {
    return from_text(read_text(file, 16u << 20), file.string(), confines);
}

Document Document::from_text(const std::string& text, const std::string& file,
                             const std::optional<Confines>& confines) {
    auto state = std::make_shared<DocumentState>();
    state->file = file;
    state->confines = confines ? *confines : confines_of(file);
    if (is_utf16(text)) throw InputError(file, utf16_problem, utf16_hint);
    check_limits(text, file);
    try {
        state->root = toml::parse(text, file);
    } catch (const toml::parse_error& error) {
        const auto& begin = error.source().begin;
        throw InputError(fmt::format("{}:{}:{}", file, begin.line, begin.column),
                         std::string(error.description()), syntax_hint(line_of(text, begin.line)));
    }
    return Document(std::move(state));
}

void Document::set(const std::string& setting) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0) {
        throw InputError("--set " + setting, "expected key.path=value");
    }
    const std::string value = setting.substr(equals + 1);
    toml::table parsed;
    try {
        parsed = toml::parse("value = " + value, "--set " + setting);
    } catch (const toml::parse_error& error) {
        if (value.find_first_of("[{\"'") == 0) {
            throw InputError("--set " + setting,
                             fmt::format("is not a TOML value: {}", error.description()),
                             "in a shell, use single quotes: 'bands=[\"8-12\"]'");
        }
        parsed.insert_or_assign("value", value);
    }
    const auto [table, key] = table_at(*state_, setting.substr(0, equals), "--set " + setting);
    table->insert_or_assign(key, std::move(*parsed.get("value")));
}

void Document::move_value(const std::string& from, const std::string& to) {
    toml::node* value = node_at(*state_, key_path(from));
    if (value == nullptr) throw InputError(state_->file, "found no value at " + from);
    const toml::source_region source = value->source();
    const auto [table, key] = table_at(*state_, to, state_->place(source, to));
    value->visit([&table = table, &key = key, &source](auto& held) {
        table->insert_or_assign(toml::key(key, source), std::move(held));
    });
}

void Document::copy_value(const Document& from, const KeyPath& path, const KeyPath& to) {
    toml::node* value = node_at(*from.state_, path);
    if (value == nullptr || to.empty()) return;
    toml::table* table = &state_->root;
    for (std::size_t i = 0; i + 1 < to.size(); ++i) {
        table->insert(to[i], toml::table{});
        table = table->get(to[i])->as_table();
        if (table == nullptr) return;
    }
    const std::filesystem::path folder =
        std::filesystem::absolute(from.state_->file).lexically_normal().parent_path();
    value->visit([&](const auto& held) { table->insert_or_assign(to.back(), held); });
    if (from.state_ != state_) name_absolutely(*table->get(to.back()), folder);
}

void Document::drop(const std::string& key) { state_->root.erase(key); }

void Document::name_tables(const std::string& key, const std::vector<std::string>& by) {
    state_->usual_name[key] = by;
}

bool Document::holds(const KeyPath& path) const { return node_at(*state_, path) != nullptr; }

bool Document::holds_parts(const KeyPath& path) const {
    const toml::node* node = node_at(*state_, path);
    return node != nullptr && (node->is_table() || node->is_array());
}

std::string Document::text_at(const KeyPath& path) const {
    const toml::node* node = node_at(*state_, path);
    return node != nullptr && node->is_string() ? node->as_string()->get() : "";
}

std::vector<std::string> Document::keys_at(const KeyPath& path) const {
    std::vector<std::string> keys;
    const toml::node* node = node_at(*state_, path);
    const toml::table* table = node != nullptr ? node->as_table() : nullptr;
    if (table == nullptr) return keys;
    for (const auto& [key, value] : *table) keys.emplace_back(key.str());
    return keys;
}

std::string Document::text_without(std::span<const char* const> keys) const {
    toml::table rest = state_->root;
    for (const std::string_view key : keys) {
        const std::size_t dot = key.find('.');
        if (dot == key.npos) {
            rest.erase(key);
        } else if (toml::table* inner = rest[key.substr(0, dot)].as_table()) {
            inner->erase(key.substr(dot + 1));
        }
    }
    std::ostringstream text;
    text << toml::toml_formatter(rest);
    return text.str();
}

Section Document::root() const { return {state_, &state_->root, "", ""}; }

void Document::finish() const {
    if (watcher()) watcher()(state_->keys);
    note_unasked(*state_, state_->root, "");
    if (state_->mistakes.empty()) return;
    std::stable_sort(state_->mistakes.begin(), state_->mistakes.end(),
                     [](const auto& a, const auto& b) {
                         return std::tie(a.line, a.column) < std::tie(b.line, b.column);
                     });
    std::vector<Mistake> mistakes;
    for (const auto& placed : state_->mistakes) mistakes.push_back(placed.mistake);
    throw InputError(std::move(mistakes));
}

const std::string& Document::file() const { return state_->file; }

const Confines& Document::confines() const { return state_->confines; }

std::span<const Key> Document::keys() const { return state_->keys; }

void Document::watch(std::function<void(std::span<const Key>)> with) {
    watcher() = std::move(with);
}

}  // namespace diurna
