#include "materials/base/section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "materials/base/article.hpp"
#include "materials/base/document_nodes.hpp"
#include "materials/base/plain_text.hpp"

namespace diurna {

namespace {

/// The names of tables, if each has one and no other has it; else empty.
std::vector<std::string> names_of_tables(const toml::array& tables) {
    std::vector<std::string> names;
    for (const toml::node& one : tables) {
        names.push_back((*one.as_table())["name"].value_or(std::string()));
    }
    std::vector<std::string> sorted = names;
    std::sort(sorted.begin(), sorted.end());
    const bool twice = std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
    const bool all = !sorted.empty() && !sorted.front().empty();
    return all && !twice ? names : std::vector<std::string>{};
}

/// A name as part of a path, in the form that --set reads.
std::string quoted_if_needed(const std::string& name) {
    const bool plain = std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return std::isalnum(c) != 0 || c == '_' || c == '-';
    });
    return plain ? name : "\"" + name + "\"";
}

std::string range_text(Range range) {
    const bool below = std::isinf(range.least), above = std::isinf(range.most);
    if (below && above) return "a number";
    if (above) return fmt::format("a number of at least {:g}", range.least);
    if (below) return fmt::format("a number of at most {:g}", range.most);
    return fmt::format("a number from {:g} to {:g}", range.least, range.most);
}

std::string number_text(double value) {
    return std::isnan(value) ? "" : fmt::format("{:g}", value);
}

}  // namespace

Section::Section(std::shared_ptr<DocumentState> state, const void* table, std::string path,
                 std::string pattern, bool missed)
    : state_(std::move(state)),
      table_(table),
      path_(std::move(path)),
      pattern_(std::move(pattern)),
      missed_(missed) {
    state_->table[path_];
}

bool Section::ask(const std::string& key, const char* says, Key::Kind kind, Key more) const {
    DocumentState::Table& table = state_->table[path_];
    table.asked.insert(key);
    if (kind == Key::Kind::tested) table.tested.insert(key);
    more.table = path_;
    more.path = joined_path(pattern_, table.free ? "NAME" : key);
    more.kind = kind;
    more.says = says;
    more.required = more.required && !table.tested.contains(key);
    more.chosen = table.chosen;
    state_->keys.push_back(std::move(more));
    return node_of(table_, key) != nullptr;
}

void Section::missing(const std::string& key, const std::string& expected) const {
    mistake(key, "missing, expected " + expected);
}

bool Section::has(const std::string& key) const { return ask(key, "", Key::Kind::tested); }

std::vector<std::string> Section::free_keys() const {
    state_->table[path_].free = true;
    std::vector<std::pair<toml::source_position, std::string>> keys;
    if (table_ != nullptr) {
        for (const auto& [key, node] : *as_table(table_)) {
            state_->table[path_].asked.insert(std::string(key.str()));
            keys.emplace_back(key.source().begin, std::string(key.str()));
        }
    }
    std::sort(keys.begin(), keys.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> names;
    for (auto& [position, name] : keys) {
        if (!is_plain(name))
            mistake(name, "expected a name without line breaks and control characters");
        names.push_back(std::move(name));
    }
    return names;
}

void Section::pass_over() const {
    if (table_ == nullptr) return;
    for (const auto& [key, node] : *as_table(table_)) {
        state_->table[path_].asked.insert(std::string(key.str()));
    }
}

std::string Section::where(const std::string& key) const {
    if (table_ == nullptr) return state_->file + ": " + joined_path(path_, key);
    const toml::node* node = key.empty() ? nullptr : node_of(table_, key);
    const toml::source_region& source =
        node != nullptr ? node->source() : as_table(table_)->source();
    return state_->place(source, joined_path(path_, key));
}

bool Section::has_mistakes() const {
    return std::any_of(state_->mistakes.begin(), state_->mistakes.end(), [&](const auto& reported) {
        const std::string rest =
            reported.path.starts_with(path_) ? reported.path.substr(path_.size()) : "-";
        return rest.empty() || rest.front() == '.' || rest.front() == '[';
    });
}

void Section::mistake(const std::string& key, const std::string& problem,
                      const std::string& hint) const {
    if (missed_) return;
    const toml::table* table = table_ != nullptr ? as_table(table_) : &state_->root;
    const toml::node* node = key.empty() ? nullptr : table->get(key);
    state_->note(node != nullptr ? node->source() : table->source(), joined_path(path_, key),
                 problem, hint);
}

double Section::number(const std::string& key, const char* says, Range range) const {
    if (!ask(key, says, Key::Kind::number, {.required = true, .range = range})) {
        missing(key, range_text(range));
        return std::clamp(0.0, range.least, range.most);
    }
    return checked_number(key, range.least, range);
}

double Section::number_or(const std::string& key, const char* says, Or<double> fallback,
                          Range range) const {
    const std::string reported = or_said(fallback.said, number_text(fallback.value));
    if (!ask(key, says, Key::Kind::number, {.fallback = reported, .range = range})) {
        return fallback.value;
    }
    return checked_number(key, fallback.value, range);
}

Section::NumberOrWord Section::number_or_word(const std::string& key, const char* says,
                                              Or<double> fallback, Range range,
                                              const std::vector<std::string>& words) const {
    const std::string reported = or_said(fallback.said, number_text(fallback.value));
    if (!ask(key, says, Key::Kind::number,
             {.fallback = reported, .range = range, .words = words})) {
        return {fallback.value};
    }
    const toml::node& node = *node_of(table_, key);
    if (!node.is_string()) return {checked_number(key, fallback.value, range)};
    const std::string word = node.as_string()->get();
    if (std::find(words.begin(), words.end(), word) != words.end()) return {std::nan(""), word};
    mistake(key,
            fmt::format("found \"{}\", expected {} or {}", word, range_text(range),
                        fmt::join(words, ", ")),
            did_you_mean(word, words));
    return {fallback.value};
}

double Section::checked_number(const std::string& key, double fallback, Range range) const {
    const toml::node& node = *node_of(table_, key);
    double value = fallback;
    if (!finite_number(node, value) || value < range.least || value > range.most) {
        mistake(key, fmt::format("found {}, expected {}", shown(node), range_text(range)));
        return fallback;
    }
    return value;
}

int Section::integer_or(const std::string& key, const char* says, Or<int> fallback,
                        Range range) const {
    const std::string reported = or_said(fallback.said, std::to_string(fallback.value));
    if (!ask(key, says, Key::Kind::whole, {.fallback = reported, .range = range})) {
        return fallback.value;
    }
    const double value = checked_number(key, fallback.value, range);
    if (value != std::floor(value)) {
        mistake(key, fmt::format("found {:g}, expected a whole number", value));
        return fallback.value;
    }
    return static_cast<int>(value);
}

std::string Section::checked_text(const std::string& key, const std::string& fallback) const {
    const toml::node* node = node_of(table_, key);
    if (node == nullptr) return fallback;
    if (!node->is_string()) {
        mistake(key, fmt::format("found {}, expected a text in quotes", shown(*node)));
        return fallback;
    }
    const std::string text = node->as_string()->get();
    if (is_plain(text)) return text;
    mistake(key, fmt::format("found {}, expected text without line breaks and control characters",
                             shown(*node)));
    return fallback;
}

std::string Section::text(const std::string& key, const char* says) const {
    if (!ask(key, says, Key::Kind::text, {.required = true})) missing(key, "a text in quotes");
    return checked_text(key, "");
}

std::string Section::text_or(const std::string& key, const char* says,
                             Or<std::string> fallback) const {
    ask(key, says, Key::Kind::text, {.fallback = or_said(fallback.said, fallback.value)});
    return checked_text(key, fallback.value);
}

std::string Section::checked_name(const std::string& key, const std::string& fallback,
                                  const Names& names) const {
    const toml::node* node = node_of(table_, key);
    const std::string name = checked_text(key, fallback);
    if (node == nullptr || !node->is_string()) return name;
    if (std::find(names.known.begin(), names.known.end(), name) == names.known.end()) {
        const auto instead = names.instead.find(name);
        std::string hint =
            instead != names.instead.end() ? instead->second : did_you_mean(name, names.known);
        if (!names.listed.empty()) hint += (hint.empty() ? "" : " ") + names.listed;
        mistake(key, fmt::format("unknown {} \"{}\"{}", names.what, name, names.where), hint);
    }
    return name;
}

std::string Section::name(const std::string& key, const char* says, const Names& names) const {
    if (!ask(key, says, Key::Kind::name, {.required = true, .words = {names.what}})) {
        missing(key, "the name of " + with_article(names.what));
    }
    return checked_name(key, "", names);
}

std::string Section::name_or(const std::string& key, const char* says, Or<std::string> fallback,
                             const Names& names) const {
    ask(key, says, Key::Kind::name,
        {.fallback = or_said(fallback.said, fallback.value), .words = {names.what}});
    return checked_name(key, fallback.value, names);
}

std::string Section::word_or(const std::string& key, const char* says, Or<std::string> fallback,
                             const std::vector<std::string>& words) const {
    ask(key, says, Key::Kind::word,
        {.fallback = or_said(fallback.said, fallback.value), .words = words});
    std::string word = checked_text(key, fallback.value);
    if (word != fallback.value && std::find(words.begin(), words.end(), word) == words.end()) {
        mistake(key, fmt::format("found \"{}\", expected one of: {}", word, fmt::join(words, ", ")),
                did_you_mean(word, words));
        word = fallback.value;
    }
    DocumentState::Table& table = state_->table[path_];
    table.chosen.emplace_back(key, word);
    state_->keys.back().chosen = table.chosen;
    return word;
}

std::string Section::kind_or(const char* says, const char* fallback,
                             const std::vector<std::string>& words) const {
    const std::string kind = word_or("kind", says, fallback, words);
    const toml::node* node = node_of(table_, "kind");
    if (node != nullptr && (!node->is_string() || node->as_string()->get() != kind)) pass_over();
    return kind;
}

bool Section::flag_or(const std::string& key, const char* says, bool fallback) const {
    if (!ask(key, says, Key::Kind::flag, {.fallback = fallback ? "true" : "false"})) {
        return fallback;
    }
    const toml::node& node = *node_of(table_, key);
    if (node.is_boolean()) return node.as_boolean()->get();
    mistake(key, fmt::format("found {}, expected true or false", shown(node)));
    return fallback;
}

std::string Section::moment(const std::string& key, const char* says) const {
    const std::string example = "2026-07-15T00:00:00-04:00", harmless = "1970-01-01T00:00:00Z";
    if (!ask(key, says, Key::Kind::moment, {.required = true})) {
        missing(key, "an instant such as " + example);
        return harmless;
    }
    const toml::node& node = *node_of(table_, key);
    if (node.is_string()) return node.as_string()->get();
    if (!node.is_date_time() || !node.as_date_time()->get().offset) {
        mistake(key, fmt::format("found {}, expected an instant with its UTC offset, such as {}",
                                 shown(node), example));
        return harmless;
    }
    return shown(node);
}

Section Section::inner(const std::string& key, const char* says, bool required) const {
    ask(key, says, Key::Kind::table, {.required = required});
    const toml::node* node = node_of(table_, key);
    const toml::table* table = node != nullptr ? node->as_table() : nullptr;
    const std::string path = joined_path(path_, key);
    if (node != nullptr && table == nullptr) {
        mistake(key, fmt::format("found {}, expected a table [{}]", shown(*node), path));
    } else if (node == nullptr && required) {
        missing(key, fmt::format("a table [{}]", path));
    }
    return {state_, table, path, state_->keys.back().path,
            missed_ || (required && table == nullptr)};
}

Section Section::section(const std::string& key, const char* says) const {
    return inner(key, says, false);
}

Section Section::required_section(const std::string& key, const char* says) const {
    return inner(key, says, true);
}

std::vector<Section> Section::sections(const std::string& key, const char* says) const {
    if (!ask(key, says, Key::Kind::tables)) return {};
    return sections_of(key, state_->keys.back().path + "[]");
}

std::vector<Section> Section::one_or_more_sections(const std::string& key, const char* says) const {
    if (!ask(key, says, Key::Kind::tables, {.count = 1})) return {};
    const std::string pattern = state_->keys.back().path + "[]";
    const toml::node& node = *node_of(table_, key);
    if (!node.is_table()) return sections_of(key, pattern);
    return {Section(state_, node.as_table(), joined_path(path_, key), pattern)};
}

std::vector<Section> Section::sections_of(const std::string& key,
                                          const std::string& pattern) const {
    const toml::node& node = *node_of(table_, key);
    const toml::array* array = node.as_array();
    if (array == nullptr || !all_of_them(*array, [](const auto& n) { return n.is_table(); })) {
        const bool only_set = node.is_table() && node.source().begin.line == 0;
        const std::string path = joined_path(path_, key);
        mistake(key, only_set ? fmt::format("the file has no table [[{}]] to be changed", path)
                              : fmt::format("found {}, expected tables [[{}]]", shown(node), path));
        return {};
    }
    const std::vector<std::string> names = names_of_tables(*array);
    std::vector<Section> found;
    for (const toml::node& element : *array) {
        const std::string path = fmt::format("{}[{}]", joined_path(path_, key), found.size());
        DocumentState::Named& named = state_->by_name[path];
        if (path_.empty() && array->size() == 1) named.alone = key;
        if (!names.empty()) {
            const std::string all = joined_path(state_->named(path_, true), key);
            named.path = joined_path(all, quoted_if_needed(names[found.size()]));
        }
        found.push_back(Section(state_, element.as_table(), path, pattern));
    }
    return found;
}

}  // namespace diurna
