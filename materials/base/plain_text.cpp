#include "materials/base/plain_text.hpp"

#include <cstddef>
#include <cstdint>

namespace diurna {

namespace {

struct Character {
    std::size_t bytes = 1;
    bool plain = false;
};

bool steers(std::uint32_t code) {
    return code < 0x20 || (code >= 0x7f && code <= 0x9f) || (code >= 0x2028 && code <= 0x202e) ||
           (code >= 0x2066 && code <= 0x2069);
}

/// The first one; of what is no UTF-8 (RFC 3629) a byte.
Character first_of(std::string_view text) {
    const auto lead = static_cast<unsigned char>(text[0]);
    if (lead < 0x80) return {1, !steers(lead)};
    const std::size_t bytes = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
    if (lead < 0xc2 || lead > 0xf4 || bytes > text.size()) return {};
    std::uint32_t code = lead & (0x7fu >> bytes);
    for (std::size_t i = 1; i < bytes; ++i) {
        const auto next = static_cast<unsigned char>(text[i]);
        if ((next & 0xc0u) != 0x80) return {};
        code = code << 6 | (next & 0x3fu);
    }
    constexpr std::uint32_t least[] = {0, 0, 0x80, 0x800, 0x10000};
    const bool surrogate = code >= 0xd800 && code <= 0xdfff;
    if (code < least[bytes] || code > 0x10ffff || surrogate) return {};
    return {bytes, !steers(code)};
}

}  // namespace

std::string plain(std::string_view text) {
    std::string out;
    while (!text.empty()) {
        const Character next = first_of(text);
        out += next.plain ? std::string(text.substr(0, next.bytes)) : std::string(next.bytes, '?');
        text.remove_prefix(next.bytes);
    }
    return out;
}

bool is_plain(std::string_view text) { return plain(text) == text; }

}  // namespace diurna
