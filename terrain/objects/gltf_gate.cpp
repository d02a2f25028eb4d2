#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>

#include "materials/base/error.hpp"
#include "terrain/objects/gltf_json.hpp"
#include "terrain/objects/mesh_gate.hpp"

namespace diurna {

namespace {

using Json = nlohmann::json;

/// Bytes that a buffer has, however many it claims.
double bytes_of(const Gltf& gltf, const Json& buffer, double own_piece,
                const std::filesystem::path& folder, const std::string& where) {
    const Json& uri = Gltf::member(buffer, "uri");
    if (uri.is_null()) return own_piece;
    if (!uri.is_string()) throw gltf.fault(where + ".uri", "is no text");
    const auto& text = uri.get_ref<const std::string&>();
    if (text.starts_with("data:")) {
        const std::size_t comma = text.find(',');
        if (comma == std::string::npos) throw gltf.fault(where + ".uri", "has no data");
        const bool wrong =
            std::any_of(text.begin() + std::ptrdiff_t(comma) + 1, text.end(), [](unsigned char c) {
                return std::isalnum(c) == 0 && c != '+' && c != '/' && c != '=' && c != '-' &&
                       c != '_';
            });
        if (wrong) throw gltf.fault(where + ".uri", "is no base64");
        return 0.75 * double(text.size() - comma - 1);
    }
    // Not there, with %20, or elsewhere (whose size nobody is told): left to who opens it.
    namespace fs = std::filesystem;
    std::error_code problem;
    const fs::path here = fs::canonical(folder.empty() ? "." : folder, problem);
    const fs::path real = fs::canonical(here / text, problem);
    if (problem ||
        std::mismatch(here.begin(), here.end(), real.begin(), real.end()).first != here.end()) {
        return -1.0;
    }
    const auto size = fs::file_size(real, problem);
    return problem ? -1.0 : double(size);
}

void check_buffers(const Gltf& gltf, double own_piece, const std::filesystem::path& folder) {
    const Json &buffers = gltf.list("buffers"), &views = gltf.list("bufferViews");
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const std::string where = fmt::format("buffers[{}]", i);
        const double told = gltf.size(Gltf::member(buffers[i], "byteLength"), -1.0, where),
                     has = bytes_of(gltf, buffers[i], own_piece, folder, where);
        if (told < 0.0) throw gltf.fault(where, "has no byteLength");
        if (has >= 0.0 && told > has) {
            throw gltf.fault(where, fmt::format("claims {:.0f} bytes, has {:.0f}", told, has));
        }
    }
    for (std::size_t i = 0; i < views.size(); ++i) {
        const std::string where = fmt::format("bufferViews[{}]", i);
        const std::size_t of = gltf.index(Gltf::member(views[i], "buffer"), buffers.size(), where);
        const double from = gltf.size(Gltf::member(views[i], "byteOffset"), 0.0, where),
                     length = gltf.size(Gltf::member(views[i], "byteLength"), -1.0, where),
                     whole = gltf.size(Gltf::member(buffers[of], "byteLength"), 0.0, where);
        if (length < 0.0 || from + length > whole) {
            throw gltf.fault(where, fmt::format("ends at byte {:.0f} of a buffer of {:.0f}",
                                                from + length, whole));
        }
    }
}

/// Bytes of an accessor's element.
double element_bytes(const Gltf& gltf, const Json& accessor, const std::string& where) {
    struct Kind {
        const char* name;
        int numbers;
    };
    constexpr std::array<Kind, 7> kinds{{{"SCALAR", 1},
                                         {"VEC2", 2},
                                         {"VEC3", 3},
                                         {"VEC4", 4},
                                         {"MAT2", 4},
                                         {"MAT3", 9},
                                         {"MAT4", 16}}};
    constexpr std::array<Kind, 6> types{
        {{"5120", 1}, {"5121", 1}, {"5122", 2}, {"5123", 2}, {"5125", 4}, {"5126", 4}}};
    const Json &type = Gltf::member(accessor, "type"),
               &component = Gltf::member(accessor, "componentType");
    const auto kind = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) {
        return type.is_string() && type.get_ref<const std::string&>() == k.name;
    });
    if (kind == kinds.end()) throw gltf.fault(where, "is of no known type: " + Gltf::shown(type));
    const auto of = std::find_if(types.begin(), types.end(),
                                 [&](const Kind& k) { return Gltf::shown(component) == k.name; });
    if (of == types.end()) {
        throw gltf.fault(where, "is of no known component type: " + Gltf::shown(component));
    }
    return double(kind->numbers) * of->numbers;
}

void check_accessors(const Gltf& gltf) {
    constexpr double most_without_data = 1e8;  // bytes of zeros
    const Json &accessors = gltf.list("accessors"), &views = gltf.list("bufferViews");
    for (std::size_t i = 0; i < accessors.size(); ++i) {
        const std::string where = fmt::format("accessors[{}]", i);
        const Json &one = accessors[i], &view = Gltf::member(one, "bufferView");
        const double element = element_bytes(gltf, one, where),
                     count = gltf.size(Gltf::member(one, "count"), 0.0, where),
                     from = gltf.size(Gltf::member(one, "byteOffset"), 0.0, where);
        if (count < 1.0) throw gltf.fault(where, "has no elements");
        if (view.is_null()) {
            if (count * element > most_without_data) {
                throw gltf.fault(where, fmt::format("claims {:.0f} elements of no data", count));
            }
            continue;
        }
        const Json& in = views[gltf.index(view, views.size(), where)];
        const double stride = gltf.size(Gltf::member(in, "byteStride"), element, where),
                     length = gltf.size(Gltf::member(in, "byteLength"), 0.0, where);
        if (from + (count - 1.0) * stride + element > length) {
            throw gltf.fault(where, fmt::format("claims {:.0f} elements, its {:.0f} bytes hold "
                                                "fewer",
                                                count, length));
        }
    }
}

void check_meshes(const Gltf& gltf) {
    const Json &meshes = gltf.list("meshes"), &accessors = gltf.list("accessors");
    const auto has = [&](std::size_t accessor, const char* key, const char* what) {
        return Gltf::shown(Gltf::member(accessors[accessor], key)) == what;
    };
    for (std::size_t i = 0; i < meshes.size(); ++i) {
        const Json& primitives = Gltf::member(meshes[i], "primitives");
        if (!primitives.is_array())
            throw gltf.fault(fmt::format("meshes[{}]", i), "has no primitives");
        for (const Json& primitive : primitives) {
            const std::string where = fmt::format("meshes[{}].primitives", i);
            const Json &attributes = Gltf::member(primitive, "attributes"),
                       &indices = Gltf::member(primitive, "indices"),
                       &mode = Gltf::member(primitive, "mode");
            if (!attributes.is_object()) throw gltf.fault(where, "has no attributes");
            for (const auto& [key, accessor] : attributes.items()) {
                const std::size_t at = gltf.index(accessor, accessors.size(), where);
                if (key == "POSITION" && !has(at, "type", "\"VEC3\"")) {
                    throw gltf.fault(where, "has positions that are not VEC3");
                }
            }
            if (!mode.is_null()) gltf.index(mode, 7, where + ".mode");
            if (indices.is_null()) continue;
            const std::size_t at = gltf.index(indices, accessors.size(), where + ".indices");
            const bool whole = has(at, "componentType", "5121") ||
                               has(at, "componentType", "5123") || has(at, "componentType", "5125");
            if (!whole || !has(at, "type", "\"SCALAR\"")) {
                throw gltf.fault(where + ".indices", "are no whole numbers");
            }
        }
    }
}

void check_json(const std::string& name, std::string_view json, double own_piece,
                const std::filesystem::path& folder) {
    const Gltf gltf(name, json);
    check_gltf_nodes(gltf);
    if (gltf.first_version()) return;
    check_buffers(gltf, own_piece, folder);
    check_accessors(gltf);
    check_meshes(gltf);
}

std::uint32_t number_at(std::string_view text, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, text.data() + at, sizeof value);
    return value;
}

}  // namespace

void check_gltf(const std::string& name, std::string_view text,
                const std::filesystem::path& folder) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    check_json(name, text, 0.0, folder);
}

void check_glb(const std::string& name, std::string_view text,
               const std::filesystem::path& folder) {
    if (text.size() < 20 || !text.starts_with("glTF")) {
        throw InputError(name, "is no binary glTF: expected 20 bytes or more that begin with glTF");
    }
    if (number_at(text, 4) != 2) {
        throw InputError(name,
                         fmt::format("is of glTF version {}, expected 2", number_at(text, 4)));
    }
    if (number_at(text, 8) != text.size()) {
        throw InputError(name,
                         fmt::format("claims {} bytes, has {}", number_at(text, 8), text.size()));
    }
    const std::size_t json = number_at(text, 12);
    if (text.substr(16, 4) != "JSON" || 20 + json > text.size()) {
        throw InputError(name, fmt::format("its first piece is no JSON of {} bytes", json));
    }
    double binary = 0.0;
    if (28 + json <= text.size()) {
        binary = number_at(text, 20 + json);
        if (28.0 + double(json) + binary > double(text.size())) {
            throw InputError(name, fmt::format("its second piece claims {:.0f} bytes, has {}",
                                               binary, text.size() - 28 - json));
        }
    }
    check_json(name, text.substr(20, json), binary, folder);
}

}  // namespace diurna
