#include "materials/base/document.hpp"

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>
#include <tuple>

#include "materials/base/files.hpp"

namespace diurna {

struct Document::State {
    struct Placed {
        std::uint32_t line = 0, column = 0;
        Mistake mistake;
    };

    std::string file;
    toml::table root;
    std::map<const void*, std::set<std::string>> asked;  // per table
    std::vector<Placed> mistakes;

    std::string place(const toml::source_region& source, const std::string& path) const {
        if (source.begin.line == 0) return "--set " + path;  // it is not from the file
        return fmt::format("{}:{}:{}: {}", file, source.begin.line, source.begin.column, path);
    }
    void note(const toml::source_region& source, const std::string& path,
              const std::string& problem, const std::string& hint = "") {
        mistakes.push_back(
            {source.begin.line, source.begin.column, Mistake{place(source, path), problem, hint}});
    }
    void note_unasked(const toml::table& table, const std::string& path);
};

namespace {

using State = Document::State;

std::string joined(const std::string& path, const std::string& key) {
    return path.empty() ? key : key.empty() ? path : path + "." + key;
}

const toml::table* as_table(const void* table) { return static_cast<const toml::table*>(table); }

/// A value as the file has it, shortened, for "found ...".
std::string shown(const toml::node& node) {
    if (node.is_table()) return "a table";
    if (node.is_array()) return "an array";
    std::ostringstream text;
    node.visit([&](const auto& value) {
        if constexpr (toml::is_value<decltype(value)>) text << value;
    });
    if (node.is_string()) return '"' + node.as_string()->get().substr(0, 60) + '"';
    return text.str().substr(0, 60);
}

/// Integers count as numbers; nan and inf do not.
bool finite_number(const toml::node& node, double& value) {
    if (!node.is_number()) return false;
    value = node.is_integer() ? static_cast<double>(node.as_integer()->get())
                              : node.as_floating_point()->get();
    return std::isfinite(value);
}

std::string range_text(double least, double most) {
    if (std::isinf(least) && std::isinf(most)) return "a number";
    if (std::isinf(most)) return fmt::format("a number of {:g} or more", least);
    if (std::isinf(least)) return fmt::format("a number of at most {:g}", most);
    return fmt::format("a number from {:g} to {:g}", least, most);
}

}  // namespace

void State::note_unasked(const toml::table& table, const std::string& path) {
    const auto found = asked.find(&table);
    if (found == asked.end()) return;  // the reader stopped at a mistake above it
    const std::vector<std::string> known(found->second.begin(), found->second.end());
    for (const auto& [key, node] : table) {
        const std::string name(key.str());
        if (!found->second.contains(name)) {
            std::string hint = did_you_mean(name, known);
            if (hint.empty()) hint = fmt::format("known here: {}", fmt::join(known, ", "));
            note(key.source(), joined(path, name), "unknown key", hint);
        } else if (const toml::table* inner = node.as_table()) {
            note_unasked(*inner, joined(path, name));
        } else if (const toml::array* array = node.as_array()) {
            for (std::size_t i = 0; i < array->size(); ++i) {
                if (const toml::table* inner_table = (*array)[i].as_table()) {
                    note_unasked(*inner_table, fmt::format("{}[{}]", joined(path, name), i));
                }
            }
        }
    }
}

Document::Document(std::shared_ptr<State> state) : state_(std::move(state)) {}

Document Document::from_file(const std::filesystem::path& file) {
    return from_text(read_text(file, 16u << 20), file.string());
}

Document Document::from_text(const std::string& text, const std::string& file) {
    auto state = std::make_shared<State>();
    state->file = file;
    try {
        state->root = toml::parse(text, file);
    } catch (const toml::parse_error& error) {
        const auto& begin = error.source().begin;
        throw InputError(fmt::format("{}:{}:{}", file, begin.line, begin.column),
                         std::string(error.description()));
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
    } catch (const toml::parse_error&) {
        parsed.insert_or_assign("value", value);
    }
    toml::table* table = &state_->root;
    std::string rest = setting.substr(0, equals);
    for (std::size_t dot = rest.find('.'); dot != std::string::npos; dot = rest.find('.')) {
        const std::string key = rest.substr(0, dot);
        table->insert(key, toml::table{});  // does nothing where the key is there
        table = table->get(key)->as_table();
        if (table == nullptr) throw InputError("--set " + setting, "'" + key + "' is not a table");
        rest = rest.substr(dot + 1);
    }
    table->insert_or_assign(rest, std::move(*parsed.get("value")));
}

Section Document::root() const { return {state_, &state_->root, ""}; }

void Document::finish() const {
    state_->note_unasked(state_->root, "");
    if (state_->mistakes.empty()) return;
    std::stable_sort(state_->mistakes.begin(), state_->mistakes.end(),
                     [](const auto& a, const auto& b) {
                         return std::tie(a.line, a.column) < std::tie(b.line, b.column);
                     });
    std::vector<Mistake> mistakes;
    for (const auto& placed : state_->mistakes) mistakes.push_back(placed.mistake);
    throw InputError(std::move(mistakes));
}

Section::Section(std::shared_ptr<Document::State> state, const void* table, std::string path,
                 bool missed)
    : state_(std::move(state)), table_(table), path_(std::move(path)), missed_(missed) {
    if (table_ != nullptr) state_->asked[table_];
}

namespace {

/// The node of a key, which from now on counts as known; null where it is absent.
const toml::node* ask(State& state, const void* table, const std::string& key) {
    if (table == nullptr) return nullptr;
    state.asked[table].insert(key);
    return as_table(table)->get(key);
}

}  // namespace

bool Section::has(const std::string& key) const { return ask(*state_, table_, key) != nullptr; }

std::vector<std::string> Section::free_keys() const {
    std::vector<std::pair<toml::source_position, std::string>> keys;
    if (table_ != nullptr) {
        for (const auto& [key, node] : *as_table(table_)) {
            ask(*state_, table_, std::string(key.str()));
            keys.emplace_back(key.source().begin, std::string(key.str()));
        }
    }
    std::sort(keys.begin(), keys.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> names;
    for (auto& [position, name] : keys) names.push_back(std::move(name));
    return names;
}

std::string Section::where(const std::string& key) const {
    if (table_ == nullptr) return state_->file + ": " + joined(path_, key);
    const toml::node* node = key.empty() ? nullptr : as_table(table_)->get(key);
    const toml::source_region& source =
        node != nullptr ? node->source() : as_table(table_)->source();
    return state_->place(source, joined(path_, key));
}

void Section::mistake(const std::string& key, const std::string& problem,
                      const std::string& hint) const {
    if (missed_) return;
    const toml::table* table = table_ != nullptr ? as_table(table_) : &state_->root;
    const toml::node* node = key.empty() ? nullptr : table->get(key);
    state_->note(node != nullptr ? node->source() : table->source(), joined(path_, key), problem,
                 hint);
}

double Section::number(const std::string& key, double least, double most) const {
    if (!has(key)) {
        mistake(key, "missing, expected " + range_text(least, most));
        return std::clamp(0.0, least, most);
    }
    return number_or(key, least, least, most);
}

double Section::number_or(const std::string& key, double fallback, double least,
                          double most) const {
    const toml::node* node = ask(*state_, table_, key);
    double value = fallback;
    if (node == nullptr) return fallback;
    if (!finite_number(*node, value) || value < least || value > most) {
        mistake(key, fmt::format("found {}, expected {}", shown(*node), range_text(least, most)));
        return fallback;
    }
    return value;
}

int Section::integer_or(const std::string& key, int fallback, int least, int most) const {
    const double value = number_or(key, fallback, least, most);
    if (value != std::floor(value)) {
        mistake(key, fmt::format("found {:g}, expected a whole number", value));
        return fallback;
    }
    return static_cast<int>(value);
}

std::string Section::text(const std::string& key) const {
    if (!has(key)) mistake(key, "missing, expected a text in quotes");
    return text_or(key, "");
}

std::string Section::text_or(const std::string& key, const std::string& fallback) const {
    const toml::node* node = ask(*state_, table_, key);
    if (node == nullptr) return fallback;
    if (!node->is_string()) {
        mistake(key, fmt::format("found {}, expected a text in quotes", shown(*node)));
        return fallback;
    }
    return node->as_string()->get();
}

std::string Section::word_or(const std::string& key, const std::string& fallback,
                             const std::vector<std::string>& words) const {
    const std::string word = text_or(key, fallback);
    if (word == fallback || std::find(words.begin(), words.end(), word) != words.end()) return word;
    mistake(key, fmt::format("found \"{}\", expected one of: {}", word, fmt::join(words, ", ")),
            did_you_mean(word, words));
    return fallback;
}

bool Section::flag_or(const std::string& key, bool fallback) const {
    const toml::node* node = ask(*state_, table_, key);
    if (node == nullptr) return fallback;
    if (!node->is_boolean()) {
        mistake(key, fmt::format("found {}, expected true or false", shown(*node)));
        return fallback;
    }
    return node->as_boolean()->get();
}

std::string Section::moment(const std::string& key) const {
    if (!has(key)) mistake(key, "missing, expected a moment such as 2026-07-15T00:00:00-04:00");
    return moment_or(key, "1970-01-01T00:00:00Z");
}

std::string Section::moment_or(const std::string& key, const std::string& fallback) const {
    const toml::node* node = ask(*state_, table_, key);
    if (node == nullptr) return fallback;
    if (node->is_string()) return node->as_string()->get();
    if (!node->is_date_time() || !node->as_date_time()->get().offset) {
        mistake(key, fmt::format("found {}, expected a moment with its offset from UTC, such as "
                                 "2026-07-15T00:00:00-04:00",
                                 shown(*node)));
        return fallback;
    }
    return shown(*node);
}

std::vector<double> Section::numbers(const std::string& key, std::size_t count) const {
    if (!has(key)) mistake(key, "missing, expected an array of numbers");
    return numbers_or(key, std::vector<double>(count, 0.0), count);
}

std::vector<double> Section::numbers_or(const std::string& key, std::vector<double> fallback,
                                        std::size_t count) const {
    const toml::node* node = ask(*state_, table_, key);
    if (node == nullptr) return fallback;
    const toml::array* array = node->as_array();
    if (array == nullptr || (count != 0 && array->size() != count)) {
        mistake(key, fmt::format("found {}, expected an array of {} numbers", shown(*node),
                                 count != 0 ? std::to_string(count) : "any number of"));
        return fallback;
    }
    std::vector<double> values(array->size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!finite_number((*array)[i], values[i])) {
            state_->note((*array)[i].source(), fmt::format("{}[{}]", joined(path_, key), i),
                         fmt::format("found {}, expected a number", shown((*array)[i])));
            return fallback;
        }
    }
    return values;
}

std::vector<std::string> Section::texts_or(const std::string& key,
                                           std::vector<std::string> fallback) const {
    const toml::node* node = ask(*state_, table_, key);
    if (node == nullptr) return fallback;
    const toml::array* array = node->as_array();
    if (array == nullptr ||
        !std::all_of(array->begin(), array->end(), [](const auto& n) { return n.is_string(); })) {
        mistake(key, fmt::format("found {}, expected an array of texts", shown(*node)));
        return fallback;
    }
    std::vector<std::string> values;
    for (const toml::node& element : *array) values.push_back(element.as_string()->get());
    return values;
}

std::vector<std::vector<double>> Section::rows(const std::string& key, std::size_t width,
                                               std::size_t least_count) const {
    const toml::node* node = ask(*state_, table_, key);
    const toml::array* array = node != nullptr ? node->as_array() : nullptr;
    const std::string expected =
        fmt::format("expected an array of at least {} arrays of {} numbers", least_count, width);
    if (array == nullptr || array->size() < least_count) {
        mistake(key, (node == nullptr ? "missing" : "found " + shown(*node)) + ", " + expected);
        return {};
    }
    std::vector<std::vector<double>> found;
    for (const toml::node& element : *array) {
        const toml::array* row = element.as_array();
        std::vector<double> values(width);
        bool fits = row != nullptr && row->size() == width;
        for (std::size_t i = 0; fits && i < width; ++i) fits = finite_number((*row)[i], values[i]);
        if (!fits) {
            state_->note(element.source(), fmt::format("{}[{}]", joined(path_, key), found.size()),
                         fmt::format("expected an array of {} numbers", width));
            return {};
        }
        found.push_back(std::move(values));
    }
    return found;
}

Section Section::section(const std::string& key, bool required) const {
    const toml::node* node = ask(*state_, table_, key);
    const toml::table* table = node != nullptr ? node->as_table() : nullptr;
    if (node != nullptr && table == nullptr) {
        mistake(key,
                fmt::format("found {}, expected a table [{}]", shown(*node), joined(path_, key)));
    } else if (node == nullptr && required) {
        mistake(key, fmt::format("missing, expected a table [{}]", joined(path_, key)));
    }
    return {state_, table, joined(path_, key), missed_ || (required && table == nullptr)};
}

std::vector<Section> Section::sections(const std::string& key) const {
    const toml::node* node = ask(*state_, table_, key);
    if (node == nullptr) return {};
    const toml::array* array = node->as_array();
    if (array == nullptr ||
        !std::all_of(array->begin(), array->end(), [](const auto& n) { return n.is_table(); })) {
        mistake(key,
                fmt::format("found {}, expected tables [[{}]]", shown(*node), joined(path_, key)));
        return {};
    }
    std::vector<Section> found;
    for (const toml::node& element : *array) {
        found.push_back(Section(state_, element.as_table(),
                                fmt::format("{}[{}]", joined(path_, key), found.size())));
    }
    return found;
}

}  // namespace diurna
