#pragma once

#include <string>
#include <string_view>

namespace diurna {

/// A noun with its indefinite article: "a material", "an object".
inline std::string with_article(std::string_view noun) {
    const bool vowel = !noun.empty() && std::string_view("aeiou").find(noun.front()) != noun.npos;
    return std::string(vowel ? "an " : "a ").append(noun);
}

}  // namespace diurna
