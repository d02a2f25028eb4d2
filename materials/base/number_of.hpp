#pragma once

#include <concepts>
#include <string>
#include <string_view>

namespace diurna {

/// A count with its noun: "1 facet", "3 facets". `many` is the plural where it is not `one` + "s".
std::string number_of(std::integral auto count, std::string_view one, std::string_view many = "") {
    std::string text = std::to_string(count) + ' ';
    if (count == 1 || many.empty()) text.append(one);
    if (count != 1) text.append(many.empty() ? std::string_view("s") : many);
    return text;
}

}  // namespace diurna
