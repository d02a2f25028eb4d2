#include "terrain/objects/gltf_buffers.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cstdint>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "terrain/objects/gltf_extensions.hpp"
#include "terrain/objects/mesh_readers.hpp"

namespace diurna {

namespace {

using Json = nlohmann::json;

/// 0 to 63; -1: no letter of base64 (RFC 4648, of either alphabet).
int base64_value(char c) {
    if (c >= 'A' && c <= 'Z') return c - 'A';
    if (c >= 'a' && c <= 'z') return c - 'a' + 26;
    if (c >= '0' && c <= '9') return c - '0' + 52;
    if (c == '+' || c == '-') return 62;
    if (c == '/' || c == '_') return 63;
    return -1;
}

std::string from_base64(const Gltf& gltf, std::string_view text, const std::string& where) {
    while (text.ends_with('=')) text.remove_suffix(1);
    std::string bytes;
    bytes.reserve(text.size() * 3 / 4);
    std::uint32_t bits = 0;
    int count = 0;
    for (const char c : text) {
        const int value = base64_value(c);
        if (value < 0) throw gltf.fault(where, "is not base64");
        bits = bits << 6 | std::uint32_t(value);
        count += 6;
        if (count < 8) continue;
        count -= 8;
        bytes += static_cast<char>(bits >> count & 0xffu);
    }
    return bytes;
}

/// "%20" is a blank, and so on (RFC 3986).
std::string without_escapes(const std::string& uri) {
    std::string name;
    const auto digit = [](char c) {
        return c >= '0' && c <= '9' ? c - '0'
                                    : std::tolower(static_cast<unsigned char>(c)) - 'a' + 10;
    };
    for (std::size_t i = 0; i < uri.size(); ++i) {
        const bool escaped = uri[i] == '%' && i + 2 < uri.size() &&
                             std::isxdigit(static_cast<unsigned char>(uri[i + 1])) != 0 &&
                             std::isxdigit(static_cast<unsigned char>(uri[i + 2])) != 0;
        name += escaped ? static_cast<char>(16 * digit(uri[i + 1]) + digit(uri[i + 2])) : uri[i];
        if (escaped) i += 2;
    }
    return name;
}

}  // namespace

GltfBuffers::GltfBuffers(const Gltf& gltf, std::string_view own_piece,
                         const std::filesystem::path& folder, const Confines& confines)
    : gltf_(gltf), own_piece_(own_piece), folder_(folder), confines_(confines) {
    const Json &buffers = gltf.list("buffers"), &views = gltf.list("bufferViews");
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const std::string where = fmt::format("buffers[{}]", i);
        if (gltf.size(Gltf::member(buffers[i], "byteLength"), -1.0, where) < 0.0) {
            throw gltf.fault(where, "has no byteLength");
        }
    }
    for (std::size_t i = 0; i < views.size(); ++i) {
        const std::string where = fmt::format("bufferViews[{}]", i);
        const std::size_t of = gltf.index(Gltf::member(views[i], "buffer"), buffers.size(), where);
        const double from = gltf.size(Gltf::member(views[i], "byteOffset"), 0.0, where),
                     length = gltf.size(Gltf::member(views[i], "byteLength"), -1.0, where),
                     whole = gltf.size(Gltf::member(buffers[of], "byteLength"), 0.0, where);
        if (length < 0.0 || from + length > whole) {
            throw gltf.fault(where,
                             fmt::format("ends at byte {:.0f}, but the buffer has {:.0f} bytes",
                                         from + length, whole));
        }
    }
}

std::string_view GltfBuffers::view(std::size_t number) {
    const Json& view = gltf_.list("bufferViews")[number];
    const std::string_view bytes = buffer(Gltf::member(view, "buffer").get<std::size_t>());
    const std::string where = fmt::format("bufferViews[{}]", number);
    const double from = gltf_.size(Gltf::member(view, "byteOffset"), 0.0, where),
                 length = gltf_.size(Gltf::member(view, "byteLength"), 0.0, where);
    return bytes.substr(std::size_t(from), std::size_t(length));
}

std::string_view GltfBuffers::buffer(std::size_t number) {
    const Json& buffer = gltf_.list("buffers")[number];
    const std::string where = fmt::format("buffers[{}]", number);
    const Json& uri = Gltf::member(buffer, "uri");
    std::string_view bytes;
    if (uri.is_null()) {
        if (number != 0 || own_piece_.empty()) {
            const std::string packed = packing_of(buffer);
            throw gltf_.fault(
                where, packed.empty()
                           ? "has neither uri nor binary chunk"
                           : fmt::format("is compressed with {}, which is not supported", packed));
        }
        bytes = own_piece_;
    } else {
        if (!uri.is_string()) throw gltf_.fault(where + ".uri", "is not text");
        auto known = read_.find(number);
        if (known == read_.end()) {
            known =
                read_.emplace(number, bytes_named(uri.get<std::string>(), where + ".uri")).first;
        }
        bytes = known->second;
    }
    const double claimed = gltf_.size(Gltf::member(buffer, "byteLength"), 0.0, where);
    if (claimed > double(bytes.size())) {
        throw gltf_.fault(where,
                          fmt::format("declares {:.0f} bytes, but has {}", claimed, bytes.size()));
    }
    return bytes;
}

std::string GltfBuffers::bytes_named(const std::string& uri, const std::string& where) const {
    if (uri.starts_with("data:")) {
        const std::size_t comma = uri.find(',');
        if (comma == std::string::npos) throw gltf_.fault(where, "has no data");
        if (!std::string_view(uri).substr(0, comma).ends_with(";base64")) {
            throw gltf_.fault(where, "is not base64");
        }
        return from_base64(gltf_, std::string_view(uri).substr(comma + 1), where);
    }
    const std::string name = without_escapes(uri);
    if (name.find("://") != std::string::npos || name.find('\0') != std::string::npos) {
        throw gltf_.fault(where,
                          fmt::format("found {}, expected a file beside it", uri.substr(0, 80)));
    }
    const std::filesystem::path file = folder_ / name;
    if (const std::string why = why_not(confines_, file); !why.empty()) {
        throw InputError(gltf_.name(), fmt::format("names {}, which {}", file.string(), why),
                         allow_outside_hint);
    }
    try {
        return read_text(file, most_mesh_bytes);
    } catch (const InputError& error) {
        throw gltf_.fault(where, fmt::format("{}: {}", error.mistakes().front().where,
                                             error.mistakes().front().problem));
    }
}

}  // namespace diurna
