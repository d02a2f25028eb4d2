#include "scenes/charts/html.hpp"

#include <cstdint>

#include "materials/base/plain_text.hpp"

namespace diurna {

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : plain(text)) {
        if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '&')
            out += "&amp;";
        else if (c == '"')
            out += "&quot;";
        else if (c == '\'')
            out += "&#39;";
        else
            out += c;
    }
    return out;
}

std::string base64(std::span<const std::byte> bytes) {
    constexpr const char* digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    out.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t block = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            block = (block << 8) |
                    (i + k < bytes.size() ? static_cast<std::uint32_t>(bytes[i + k]) : 0u);
        }
        for (std::size_t k = 0; k < 4; ++k) {
            out += i + k <= bytes.size() ? digits[(block >> (18 - 6 * k)) & 63u] : '=';
        }
    }
    return out;
}

}  // namespace diurna
