#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <utility>

#include "materials/base/error.hpp"
#include "materials/base/number_of.hpp"
#include "terrain/objects/gltf_extensions.hpp"
#include "terrain/objects/gltf_meshes.hpp"
#include "terrain/objects/gltf_nodes.hpp"
#include "terrain/objects/mesh_builder.hpp"
#include "terrain/objects/mesh_readers.hpp"

namespace diurna {

namespace {

using Json = nlohmann::json;

/// The mesh's name, else the node's, else its number: by which a scene can name it as a part.
std::string part_name(const Gltf& gltf, const GltfPlacing& placing) {
    for (const Json* named :
         {&gltf.list("meshes")[placing.mesh], &gltf.list("nodes")[placing.node]}) {
        const Json& name = Gltf::member(*named, "name");
        if (name.is_string() && !name.get_ref<const std::string&>().empty()) {
            return name.get<std::string>();
        }
    }
    return fmt::format("meshes[{}]", placing.mesh);
}

/// The transform of a place that hangs on joints; that of its node where it hangs on none.
Eigen::Affine3d transform_at(const Gltf& gltf, const GltfPrimitive& primitive,
                             const GltfPlacing& placing, std::size_t place) {
    if (placing.joint.empty() || primitive.pulls == 0) return placing.transform;
    Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
    double whole = 0.0;
    for (std::size_t i = place * primitive.pulls; i < (place + 1) * primitive.pulls; ++i) {
        const auto& [joint, share] = primitive.pull[i];
        if (share == 0.0) continue;
        if (joint >= placing.joint.size()) {
            throw gltf.fault(
                fmt::format("meshes[{}]", placing.mesh),
                fmt::format("found joint {}, but its skin has {}", joint, placing.joint.size()));
        }
        sum += share * placing.joint[joint].matrix();
        whole += share;
    }
    if (!(whole > 0.0)) return placing.transform;
    return Eigen::Affine3d(Eigen::Matrix4d(sum / whole));
}

/// Appends a primitive where it is placed; a transform that mirrors reverses its corners (glTF 2.0,
/// 3.7.4).
void append(MeshBuilder& mesh, const Gltf& gltf, const GltfPrimitive& primitive,
            const GltfPlacing& placing, std::uint16_t part) {
    std::vector<std::uint32_t> vertex;
    vertex.reserve(primitive.place.size());
    bool mirrored = false;
    double stretch = 0.0;
    for (std::size_t v = 0; v < primitive.place.size(); ++v) {
        const Eigen::Affine3d transform = transform_at(gltf, primitive, placing, v);
        vertex.push_back(mesh.vertex(transform * primitive.place[v]));
        if (v > 0) continue;
        mirrored = transform.linear().determinant() < 0.0;
        stretch = transform.linear().colwise().norm().maxCoeff();
    }
    for (const auto& [a, b, c] : primitive.triangle) {
        mesh.triangle(mirrored ? std::array{vertex[a], vertex[c], vertex[b]}
                               : std::array{vertex[a], vertex[b], vertex[c]},
                      part);
    }
    mesh.stored_as_float(primitive.largest_float * stretch);
}

MeshFile read_json(const std::string& name, std::string_view json, std::string_view own_piece,
                   const std::filesystem::path& folder, const Confines& confines) {
    const Gltf gltf(name, json);
    check_gltf_extensions(gltf);
    GltfBuffers buffers(gltf, own_piece, folder, confines);
    GltfAccessors accessors(gltf, buffers);
    MeshBuilder mesh(name);
    // By mesh, and by node where that has weights of its own.
    std::map<std::pair<std::size_t, std::size_t>, std::vector<GltfPrimitive>> known;
    std::size_t undrawn = 0;
    for (const GltfPlacing& placing : gltf_placings(gltf, accessors)) {
        const std::vector<double> weights =
            gltf_weights(gltf, gltf.list("nodes")[placing.node], "nodes");
        const std::pair key(placing.mesh, weights.empty() ? 0 : placing.node + 1);
        auto at = known.find(key);
        if (at == known.end()) {
            at = known.emplace(key, gltf_primitives(gltf, accessors, placing.mesh, weights)).first;
        }
        const std::vector<GltfPrimitive>& primitives = at->second;
        const std::string own = part_name(gltf, placing);
        for (std::size_t p = 0; p < primitives.size(); ++p) {
            if (!primitives[p].drawn) ++undrawn;
            if (primitives[p].triangle.empty()) continue;
            const std::string part = primitives.size() > 1 ? fmt::format("{}-{}", own, p) : own;
            append(mesh, gltf, primitives[p], placing, mesh.part(part, primitives[p].material));
        }
    }
    if (undrawn > 0)
        mesh.note(fmt::format("{} of points or lines skipped", number_of(undrawn, "primitive")));
    return mesh.finish();
}

std::uint32_t number_at(std::string_view text, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, text.data() + at, sizeof value);
    return value;
}

}  // namespace

MeshFile read_gltf(const std::string& name, std::string_view text,
                   const std::filesystem::path& folder, const Confines& confines) {
    if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    return read_json(name, text, {}, folder, confines);
}

MeshFile read_glb(const std::string& name, std::string_view text,
                  const std::filesystem::path& folder, const Confines& confines) {
    if (text.size() < 20 || !text.starts_with("glTF")) {
        throw InputError(
            name, "is not a binary glTF file: expected at least 20 bytes that begin with glTF");
    }
    if (number_at(text, 4) != 2) {
        throw InputError(name, fmt::format("has glTF version {}, expected 2", number_at(text, 4)));
    }
    if (number_at(text, 8) != text.size()) {
        throw InputError(
            name, fmt::format("declares {} bytes, but has {}", number_at(text, 8), text.size()));
    }
    const std::size_t json = number_at(text, 12);
    if (text.substr(16, 4) != "JSON" || 20 + json > text.size()) {
        throw InputError(name, fmt::format("its first chunk is not JSON of {} bytes", json));
    }
    // Then pieces of any kind, of which the binary one is the first if there.
    std::string_view binary;
    if (28 + json <= text.size()) {
        const std::size_t bytes = number_at(text, 20 + json);
        if (28 + json + bytes > text.size()) {
            throw InputError(name, fmt::format("its second chunk declares {} bytes, but has {}",
                                               bytes, text.size() - 28 - json));
        }
        if (text.substr(24 + json, 4) == std::string_view("BIN\0", 4)) {
            binary = text.substr(28 + json, bytes);
        }
    }
    return read_json(name, text.substr(20, json), binary, folder, confines);
}

}  // namespace diurna
