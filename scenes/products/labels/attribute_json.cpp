#include "scenes/products/labels/attribute_json.hpp"

#include <charconv>
#include <sstream>

namespace diurna {

namespace {

using OrderedJson = nlohmann::ordered_json;

OrderedJson value_of(const std::string& text) {
    OrderedJson numbers = OrderedJson::array();
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        double number = 0.0;
        const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), number);
        if (problem != std::errc() || end != word.data() + word.size()) return text;
        numbers.push_back(number);
    }
    if (numbers.empty()) return text;
    return numbers.size() == 1 ? numbers.front() : numbers;
}

}  // namespace

OrderedJson attribute_json(const std::map<std::string, std::string>& attributes) {
    OrderedJson json = OrderedJson::object();
    for (const auto& [name, text] : attributes) {
        const auto dot = name.find('.');
        if (dot == std::string::npos) continue;
        json[name.substr(0, dot)][name.substr(dot + 1)] = value_of(text);
    }
    return json;
}

}  // namespace diurna
