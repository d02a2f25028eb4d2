#include <fmt/format.h>

#include <sstream>

#include "materials/base/document_nodes.hpp"
#include "materials/base/plain_text.hpp"
#include "materials/base/section.hpp"

namespace diurna {

namespace {

std::string json(const toml::node& node) {
    std::ostringstream text;
    text << toml::json_formatter{node};
    return text.str();
}

}  // namespace

std::vector<double> Section::checked_numbers(const std::string& key, std::vector<double> fallback,
                                             std::size_t count) const {
    const toml::node* node = node_of(table_, key);
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
            state_->note((*array)[i].source(), fmt::format("{}[{}]", joined_path(path_, key), i),
                         fmt::format("found {}, expected a number", shown((*array)[i])));
            return fallback;
        }
    }
    return values;
}

std::vector<double> Section::numbers(const std::string& key, const char* says,
                                     std::size_t count) const {
    if (!ask(key, says, Key::Kind::numbers, {.required = true, .count = count})) {
        missing(key, "an array of numbers");
    }
    return checked_numbers(key, std::vector<double>(count, 0.0), count);
}

std::vector<double> Section::numbers_or(const std::string& key, const char* says,
                                        Or<std::vector<double>> fallback, std::size_t count) const {
    const std::string value =
        fallback.value.empty() ? "" : fmt::format("[{:g}]", fmt::join(fallback.value, ", "));
    ask(key, says, Key::Kind::numbers, {.fallback = or_said(fallback.said, value), .count = count});
    return checked_numbers(key, std::move(fallback.value), count);
}

std::vector<double> Section::numbers_or_word(const std::string& key, const char* says,
                                             const std::string& word, std::size_t count,
                                             Range range) const {
    if (!ask(key, says, Key::Kind::numbers,
             {.fallback = word, .range = range, .count = count, .words = {word}})) {
        return {};
    }
    const toml::node& node = *node_of(table_, key);
    if (const toml::value<std::string>* text = node.as_string()) {
        if (text->get() == word) return {};
    }
    const toml::array* const array = node.as_array();
    std::vector<double> values(count);
    bool fits = array != nullptr && array->size() == count;
    for (std::size_t i = 0; fits && i < count; ++i) {
        fits = finite_number((*array)[i], values[i]) && values[i] >= range.least &&
               values[i] <= range.most;
    }
    if (fits) return values;
    mistake(key,
            fmt::format("found {}, expected \"{}\" or an array of {} numbers from {:g} to {:g}",
                        shown(node), word, count, range.least, range.most));
    return {};
}

std::vector<std::string> Section::texts_or(const std::string& key, const char* says,
                                           Or<std::vector<std::string>> fallback) const {
    const std::string value =
        fallback.value.empty() ? "" : fmt::format("[\"{}\"]", fmt::join(fallback.value, "\", \""));
    if (!ask(key, says, Key::Kind::texts, {.fallback = or_said(fallback.said, value)})) {
        return fallback.value;
    }
    const toml::node& node = *node_of(table_, key);
    const toml::array* array = node.as_array();
    // A moment is the text that it is written by: what it is asked for says whether it may be one.
    const auto is_text = [](const auto& n) { return n.is_string() || n.is_date_time(); };
    if (array == nullptr || !all_of_them(*array, is_text)) {
        mistake(key, fmt::format("found {}, expected an array of texts", shown(node)),
                node.is_string() ? fmt::format("write [{}]", shown(node)) : "");
        return fallback.value;
    }
    std::vector<std::string> values;
    for (const toml::node& element : *array) {
        values.push_back(element.is_string() ? element.as_string()->get() : shown(element));
        if (is_plain(values.back())) continue;
        mistake(key,
                fmt::format("found {}, expected text without control characters", shown(element)));
        return fallback.value;
    }
    return values;
}

std::vector<std::vector<double>> Section::rows(const std::string& key, const char* says,
                                               std::size_t width, std::size_t least_count) const {
    ask(key, says, Key::Kind::rows, {.required = true, .count = width});
    const toml::node* node = node_of(table_, key);
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
            state_->note(element.source(),
                         fmt::format("{}[{}]", joined_path(path_, key), found.size()),
                         fmt::format("expected an array of {} numbers", width));
            return {};
        }
        found.push_back(std::move(values));
    }
    return found;
}

std::vector<std::vector<std::string>> Section::values(const std::string& key, const char* says,
                                                      std::size_t width) const {
    ask(key, says, Key::Kind::values, {.required = true});
    const toml::node* node = node_of(table_, key);
    const toml::array* array = node != nullptr ? node->as_array() : nullptr;
    if (array == nullptr || array->empty()) {
        mistake(key, (node == nullptr ? "missing" : "found " + shown(*node)) +
                         ", expected an array of at least one value");
        return {};
    }
    std::vector<std::vector<std::string>> found;
    for (const toml::node& element : *array) {
        const toml::array* row = element.as_array();
        if (width > 1 && (row == nullptr || row->size() != width)) {
            state_->note(element.source(),
                         fmt::format("{}[{}]", joined_path(path_, key), found.size()),
                         fmt::format("found {}, expected an array of {} values, one for each key",
                                     shown(element), width));
            return {};
        }
        std::vector<std::string>& texts = found.emplace_back();
        for (std::size_t i = 0; i < width; ++i)
            texts.push_back(json(width > 1 ? (*row)[i] : element));
    }
    return found;
}

}  // namespace diurna
