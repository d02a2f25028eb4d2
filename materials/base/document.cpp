#include "materials/base/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>
#include <vector>

#include "materials/base/document_state.hpp"
#include "materials/base/files.hpp"

namespace diurna {

namespace {

/// Notes the keys of a table, and of those in it, that nobody asked for.
void note_unasked(DocumentState& state, const toml::table& table, const std::string& path) {
    const auto found = state.table.find(path);
    if (found == state.table.end()) return;  // the reader stopped at a mistake above it
    const std::set<std::string>& asked = found->second.asked;
    const std::vector<std::string> known(asked.begin(), asked.end());
    for (const auto& [key, node] : table) {
        const std::string name(key.str());
        const std::string inner = joined_path(path, name);
        if (!asked.contains(name)) {
            std::string hint = did_you_mean(name, known);
            if (hint.empty()) hint = fmt::format("known here: {}", fmt::join(known, ", "));
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

std::function<void(std::span<const Key>)>& watcher() {
    static std::function<void(std::span<const Key>)> none;
    return none;
}

}  // namespace

Document::Document(std::shared_ptr<DocumentState> state) : state_(std::move(state)) {}

Document Document::from_file(const std::filesystem::path& file) {
    return from_text(read_text(file, 16u << 20), file.string());
}

Document Document::from_text(const std::string& text, const std::string& file) {
    auto state = std::make_shared<DocumentState>();
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

std::span<const Key> Document::keys() const { return state_->keys; }

void Document::watch(std::function<void(std::span<const Key>)> with) {
    watcher() = std::move(with);
}

}  // namespace diurna
