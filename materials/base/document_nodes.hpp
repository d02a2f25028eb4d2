#pragma once

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <utility>

#include "materials/base/document_state.hpp"

/// Helpers of the sources of Section for a file's nodes.
namespace diurna {

inline const toml::table* as_table(const void* table) {
    return static_cast<const toml::table*>(table);
}

/// The node of a key; null where it is absent.
inline const toml::node* node_of(const void* table, const std::string& key) {
    return table == nullptr ? nullptr : as_table(table)->get(key);
}

/// A value as the file has it, shortened, for "found ...".
inline std::string shown(const toml::node& node) {
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
inline bool finite_number(const toml::node& node, double& value) {
    if (!node.is_number()) return false;
    value = node.is_integer() ? static_cast<double>(node.as_integer()->get())
                              : node.as_floating_point()->get();
    return std::isfinite(value);
}

/// Default value in a list of keys: the given description, else the value.
inline std::string or_said(const std::string& said, std::string value) {
    return said.empty() ? std::move(value) : said;
}

template <class Test>
bool all_of_them(const toml::array& array, const Test& test) {
    return std::all_of(array.begin(), array.end(), test);
}

}  // namespace diurna
