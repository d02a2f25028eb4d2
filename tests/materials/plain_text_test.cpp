#include "materials/base/plain_text.hpp"

#include <catch2/catch.hpp>
#include <string>

using namespace diurna;

// UTF-8 by the table of RFC 3629, section 4; its examples of what is none: "overlong" C0 80, ED A0
// 80 (half a surrogate pair) and F4 90 80 80 (beyond U+10FFFF). Control characters: ISO 6429's C0,
// DEL and C1; those that turn text: Unicode's UAX 9, and line ends U+2028 and U+2029.
TEST_CASE("names keep every letter and lose other characters", "[materials][plain_text]") {
    for (const std::string text :
         {"", "asphalt", "Beton, grün", "日本", "\xf0\x9f\x8c\x9e", "a\"<&'>\\"}) {
        CAPTURE(text);
        CHECK(plain(text) == text);
        CHECK(is_plain(text));
    }
    const std::pair<std::string, std::string> cases[] = {
        {"a\x1b[2Jb", "a?[2Jb"},
        {"a\nb\tc\r", "a?b?c?"},
        {"\x7f", "?"},
        {std::string("a\0b", 3), "a?b"},
        {"\xc2\x9b"
         "31m",
         "??31m"},  // U+009B, CSI
        {"\xe2\x80\xae"
         "cba",
         "???cba"},                 // U+202E turns what follows
        {"\xe2\x81\xa6x", "???x"},  // U+2066
        {"\xe2\x80\xa8x", "???x"},  // U+2028, a line's end
        {"\x9b", "?"},              // alone no UTF-8
        {"\xff\xfe", "??"},
        {"\xc0\x80", "??"},  // overlong
        {"\xe0\x80\x80", "???"},
        {"\xed\xa0\x80", "???"},       // half of a pair
        {"\xf4\x90\x80\x80", "????"},  // beyond the last
        {"\xe6\x97", "??"},            // cut off
        {"\xe6"
         "a",
         "?a"}};
    for (const auto& [text, expected] : cases) {
        CAPTURE(expected);
        CHECK(plain(text) == expected);
        CHECK_FALSE(is_plain(text));
        CHECK(is_plain(plain(text)));
    }
}
