#include "terrain/objects/gltf_meshes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "terrain/objects/gltf_extensions.hpp"

namespace diurna {

namespace {

using Json = nlohmann::json;

/// What a mode draws, and how many corners it needs (glTF 2.0, 3.7.2.1).
struct Mode {
    const char* name;
    std::size_t least, multiple;
};
constexpr std::array<Mode, 7> modes{{{"points", 1, 1},
                                     {"lines", 2, 2},
                                     {"a line loop", 2, 1},
                                     {"a line strip", 2, 1},
                                     {"triangles", 3, 3},
                                     {"a triangle strip", 3, 1},
                                     {"a triangle fan", 3, 1}}};

/// Vertices, without the check that indices are of them.
std::vector<Eigen::Vector3d> places_of(const Gltf& gltf, GltfAccessors& accessors,
                                       std::size_t accessor, const std::string& where,
                                       double& largest_float) {
    const int type = accessors.component_type(accessor);
    constexpr int of_float = 5126, of_uint32 = 5125;
    if (type == of_uint32 || (type != of_float && !uses_extension(gltf, "KHR_mesh_quantization"))) {
        throw gltf.fault(
            where, fmt::format("have component type {}, expected {} (float){}", type, of_float,
                               type == of_uint32 ? ""
                                                 : ", or KHR_mesh_quantization among "
                                                   "extensionsUsed"));
    }
    const std::vector<double> number = accessors.numbers(accessor, "VEC3", where);
    std::vector<Eigen::Vector3d> place;
    place.reserve(number.size() / 3);
    for (std::size_t i = 0; i + 2 < number.size(); i += 3) place.emplace_back(&number[i]);
    if (type == of_float) {
        for (const double x : number) largest_float = std::max(largest_float, std::abs(x));
    }
    return place;
}

/// The corners as they are drawn, one after the other.
std::vector<std::uint32_t> corners_of(const Gltf& gltf, GltfAccessors& accessors,
                                      const Json& primitive, std::size_t vertices, const Mode& mode,
                                      const std::string& of) {
    const Json& indices = Gltf::member(primitive, "indices");
    std::vector<std::uint32_t> corner;
    const std::string where = indices.is_null() ? of : of + ".indices";
    if (indices.is_null()) {
        corner.resize(vertices);
        std::iota(corner.begin(), corner.end(), 0u);
    } else {
        corner =
            accessors.indices(gltf.index(indices, gltf.list("accessors").size(), where), where);
    }
    const char* what = indices.is_null() ? "vertices" : "indices";
    if (corner.size() < mode.least || corner.size() % mode.multiple != 0) {
        throw gltf.fault(
            where, fmt::format("found {} {} for {}, expected {}", corner.size(), what, mode.name,
                               mode.multiple > 1 ? fmt::format("a multiple of {}", mode.multiple)
                                                 : fmt::format("at least {}", mode.least)));
    }
    for (std::size_t i = 0; i < corner.size(); ++i) {
        if (corner[i] < vertices) continue;
        throw gltf.fault(where, fmt::format("found index {} (number {}), but there are {} vertices",
                                            corner[i], i, vertices));
    }
    return corner;
}

std::vector<std::array<std::uint32_t, 3>> triangles_of(const std::vector<std::uint32_t>& corner,
                                                       std::size_t mode) {
    std::vector<std::array<std::uint32_t, 3>> triangle;
    if (mode == 4) {
        for (std::size_t i = 0; i + 2 < corner.size(); i += 3) {
            triangle.push_back({corner[i], corner[i + 1], corner[i + 2]});
        }
    }
    for (std::size_t i = 0; mode > 4 && i + 2 < corner.size(); ++i) {
        if (mode == 6) {
            triangle.push_back({corner[i + 1], corner[i + 2], corner[0]});
        } else {
            triangle.push_back({corner[i], corner[i + 1 + i % 2], corner[i + 2 - i % 2]});
        }
    }
    return triangle;
}

void drop_unused_places(GltfPrimitive& primitive) {
    constexpr auto none = std::uint32_t(-1);
    std::vector<std::uint32_t> number(primitive.place.size(), none);
    std::vector<Eigen::Vector3d> used;
    std::vector<GltfPrimitive::Pull> pull;
    for (auto& corner : primitive.triangle) {
        for (std::uint32_t& v : corner) {
            if (number[v] == none) {
                number[v] = static_cast<std::uint32_t>(used.size());
                used.push_back(primitive.place[v]);
                const auto first = primitive.pull.begin() + std::ptrdiff_t(v * primitive.pulls);
                pull.insert(pull.end(), first, first + std::ptrdiff_t(primitive.pulls));
            }
            v = number[v];
        }
    }
    primitive.place = std::move(used);
    primitive.pull = std::move(pull);
}

/// Adds what morph targets move, by their weights.
void move_by_targets(const Gltf& gltf, GltfAccessors& accessors, const Json& targets,
                     const std::vector<double>& weights, const std::string& where,
                     std::vector<Eigen::Vector3d>& place) {
    for (std::size_t t = 0; t < std::min(targets.size(), weights.size()); ++t) {
        const Json& position = Gltf::member(targets[t], "POSITION");
        if (weights[t] == 0.0 || position.is_null()) continue;
        const std::size_t at =
            gltf.index(position, gltf.list("accessors").size(), where + ".targets");
        const std::vector<double> moved = accessors.numbers(at, "VEC3", where + ".targets");
        if (moved.size() != 3 * place.size()) {
            throw gltf.fault(where + ".targets", fmt::format("found {} places, expected {}",
                                                             moved.size() / 3, place.size()));
        }
        for (std::size_t v = 0; v < place.size(); ++v) {
            place[v] += weights[t] * Eigen::Vector3d(&moved[3 * v]);
        }
    }
}

/// Joints on which the places hang, four in each of JOINTS_0, JOINTS_1 and so on.
void read_pulls(const Gltf& gltf, GltfAccessors& accessors, const Json& attributes,
                const std::string& where, GltfPrimitive& read) {
    std::vector<std::vector<double>> joints, shares;
    for (int set = 0;; ++set) {
        const Json &joint = Gltf::member(attributes, fmt::format("JOINTS_{}", set).c_str()),
                   &weight = Gltf::member(attributes, fmt::format("WEIGHTS_{}", set).c_str());
        if (joint.is_null() || weight.is_null()) break;
        joints.push_back(accessors.numbers(joint.get<std::size_t>(), "VEC4", where));
        shares.push_back(accessors.numbers(weight.get<std::size_t>(), "VEC4", where));
        if (joints.back().size() == 4 * read.place.size() &&
            shares.back().size() == 4 * read.place.size()) {
            continue;
        }
        throw gltf.fault(where,
                         fmt::format("does not have the {} elements of JOINTS_{} or WEIGHTS_{}",
                                     read.place.size(), set, set));
    }
    read.pulls = 4 * joints.size();
    for (std::size_t v = 0; v < read.place.size(); ++v) {
        for (std::size_t set = 0; set < joints.size(); ++set) {
            for (std::size_t k = 4 * v; k < 4 * v + 4; ++k) {
                read.pull.push_back(
                    {static_cast<std::uint32_t>(std::clamp(joints[set][k], 0.0, 65535.0)),
                     shares[set][k]});
            }
        }
    }
}

std::string material_of(const Gltf& gltf, const Json& primitive, const std::string& where) {
    const Json &material = Gltf::member(primitive, "material"), &all = gltf.list("materials");
    if (material.is_null()) return "";
    const Json& name =
        Gltf::member(all[gltf.index(material, all.size(), where + ".material")], "name");
    return name.is_string() ? name.get<std::string>() : "";
}

GltfPrimitive read_primitive(const Gltf& gltf, GltfAccessors& accessors, const Json& primitive,
                             const std::vector<double>& weights, const std::string& where) {
    GltfPrimitive read;
    read.material = material_of(gltf, primitive, where);
    const Json &attributes = Gltf::member(primitive, "attributes"),
               &mode = Gltf::member(primitive, "mode"), &all = gltf.list("accessors");
    if (!attributes.is_object()) throw gltf.fault(where, "has no attributes");
    for (const auto& [key, accessor] : attributes.items()) {
        gltf.index(accessor, all.size(), where + "." + key.substr(0, 40));
    }
    const std::size_t number = mode.is_null() ? 4 : gltf.index(mode, modes.size(), where + ".mode");
    const Json& position = Gltf::member(attributes, "POSITION");
    const bool has_data =
        !position.is_null() &&
        (!Gltf::member(all[position.get<std::size_t>()], "bufferView").is_null() ||
         !Gltf::member(all[position.get<std::size_t>()], "sparse").is_null());
    if (const std::string packed = packing_of(primitive); !has_data && !packed.empty()) {
        throw gltf.fault(where,
                         fmt::format("is compressed with {}, which is not supported", packed));
    }
    if (position.is_null()) throw gltf.fault(where, "has no POSITION");
    read.place = places_of(gltf, accessors, position.get<std::size_t>(), where + ".POSITION",
                           read.largest_float);
    const std::vector<std::uint32_t> corner =
        corners_of(gltf, accessors, primitive, read.place.size(), modes[number], where);
    read.triangle = triangles_of(corner, number);
    read.drawn = number >= 4;
    if (const Json& targets = Gltf::member(primitive, "targets"); targets.is_array()) {
        move_by_targets(gltf, accessors, targets, weights, where, read.place);
    }
    read_pulls(gltf, accessors, attributes, where, read);
    drop_unused_places(read);
    return read;
}

}  // namespace

std::vector<GltfPrimitive> gltf_primitives(const Gltf& gltf, GltfAccessors& accessors,
                                           std::size_t mesh, std::vector<double> weights) {
    const Json& primitives = Gltf::member(gltf.list("meshes")[mesh], "primitives");
    const std::string where = fmt::format("meshes[{}]", mesh);
    if (!primitives.is_array()) throw gltf.fault(where, "has no primitives");
    if (weights.empty()) weights = gltf_weights(gltf, gltf.list("meshes")[mesh], where);
    std::vector<GltfPrimitive> read;
    for (std::size_t p = 0; p < primitives.size(); ++p) {
        read.push_back(read_primitive(gltf, accessors, primitives[p], weights,
                                      fmt::format("{}.primitives[{}]", where, p)));
    }
    return read;
}

std::vector<double> gltf_weights(const Gltf& gltf, const Json& of, const std::string& where) {
    const Json& weights = Gltf::member(of, "weights");
    if (weights.is_null()) return {};
    const bool fits =
        weights.is_array() && std::all_of(weights.begin(), weights.end(), [](const Json& x) {
            return x.is_number() && std::abs(x.get<double>()) < 1e6;
        });
    if (!fits) throw gltf.fault(where + ".weights", "are not numbers");
    return weights.get<std::vector<double>>();
}

}  // namespace diurna
