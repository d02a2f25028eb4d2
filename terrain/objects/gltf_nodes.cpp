#include "terrain/objects/gltf_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "terrain/objects/mesh_readers.hpp"

namespace diurna {

namespace {

using Json = nlohmann::json;

constexpr std::size_t most_depth = 256;  // of nodes: who reads them calls itself

constexpr auto no_parent = std::size_t(-1);

/// `k` is the child of `parent`; throws where it has another.
void adopt(const Gltf& gltf, std::vector<std::size_t>& parents, std::size_t k, std::size_t parent,
           const std::string& where) {
    if (parents[k] != no_parent) {
        throw gltf.fault(where, fmt::format("node {} has two parents, expected a tree", k));
    }
    parents[k] = parent;
}

/// Throws where a node is below itself, or too deep.
void check_depths(const Gltf& gltf, const std::vector<std::size_t>& parents) {
    // From every node up to one whose depth is known, and down again; who comes back is below
    // itself.
    std::vector<std::size_t> depth(parents.size(), 0), way;
    for (std::size_t i = 0; i < parents.size(); ++i) {
        way.clear();
        std::size_t at = i;
        for (; at != no_parent && depth[at] == 0 && way.size() <= most_depth; at = parents[at]) {
            way.push_back(at);
        }
        std::size_t above = at == no_parent ? 0 : depth[at];
        if (above + way.size() > most_depth) {
            throw gltf.fault(
                fmt::format("nodes[{}]", i),
                fmt::format("is nested more than {} deep, or below itself", most_depth));
        }
        for (auto node = way.rbegin(); node != way.rend(); ++node) depth[*node] = ++above;
    }
}

/// Nodes are trees: each has one parent at most, none is below itself, none too deep. Returns the
/// parents.
std::vector<std::size_t> check_nodes(const Gltf& gltf) {
    const Json& nodes = gltf.list("nodes");
    const std::size_t meshes = gltf.list("meshes").size();
    std::vector<std::size_t> parents(nodes.size(), no_parent);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const std::string where = fmt::format("nodes[{}]", i);
        const Json &mesh = Gltf::member(nodes[i], "mesh"),
                   &children = Gltf::member(nodes[i], "children");
        if (!mesh.is_null()) gltf.index(mesh, meshes, where + ".mesh");
        for (const auto& [key, count] :
             {std::pair{"matrix", 16u}, {"translation", 3u}, {"scale", 3u}, {"rotation", 4u}}) {
            const Json& value = Gltf::member(nodes[i], key);
            if (value.is_null()) continue;
            const bool fits =
                value.is_array() && value.size() == count &&
                std::all_of(value.begin(), value.end(), [](const Json& x) {
                    return x.is_number() && std::abs(x.get<double>()) <= most_coordinate;
                });
            if (!fits) throw gltf.fault(where + "." + key, fmt::format("is not {} numbers", count));
        }
        if (children.is_null()) continue;
        if (!children.is_array()) throw gltf.fault(where + ".children", "is not an array");
        for (const Json& child : children) {
            const std::size_t k = gltf.index(child, nodes.size(), where + ".children");
            adopt(gltf, parents, k, i, where + ".children");
        }
    }
    check_depths(gltf, parents);
    const Json& scenes = gltf.list("scenes");
    for (const Json& scene : scenes) {
        const Json& roots = Gltf::member(scene, "nodes");
        if (roots.is_null()) continue;
        if (!roots.is_array()) throw gltf.fault("scenes.nodes", "is not an array");
        for (const Json& root : roots) gltf.index(root, nodes.size(), "scenes.nodes");
    }
    const Json& chosen = Gltf::member(gltf.all(), "scene");
    if (!chosen.is_null()) gltf.index(chosen, scenes.size(), "scene");
    return parents;
}

/// The nodes at the top of the scene that is shown.
std::vector<std::size_t> tops(const Gltf& gltf, const std::vector<std::size_t>& parents) {
    std::vector<std::size_t> tops;
    const Json &scenes = gltf.list("scenes"), &chosen = Gltf::member(gltf.all(), "scene");
    if (scenes.empty()) {
        for (std::size_t i = 0; i < parents.size(); ++i) {
            if (parents[i] == no_parent) tops.push_back(i);
        }
        return tops;
    }
    const Json& scene = scenes[chosen.is_null() ? 0 : chosen.get<std::size_t>()];
    for (const Json& node : Gltf::member(scene, "nodes")) {
        const auto top = node.get<std::size_t>();
        if (std::find(tops.begin(), tops.end(), top) == tops.end()) tops.push_back(top);
    }
    return tops;
}

std::vector<double> numbers_of(const Json& node, const char* key, std::vector<double> fallback) {
    const Json& value = Gltf::member(node, key);
    return value.is_null() ? fallback : value.get<std::vector<double>>();
}

Eigen::Affine3d composed(const Eigen::Vector3d& translation, const Eigen::Vector4d& xyzw,
                         const Eigen::Vector3d& scale, const Gltf& gltf, const std::string& where) {
    if (!(xyzw.norm() > 1e-6)) throw gltf.fault(where, "has a rotation of length zero");
    const Eigen::Quaterniond turn(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
    return Eigen::Translation3d(translation) * turn.normalized() *
           Eigen::Scaling(scale.x(), scale.y(), scale.z());
}

Eigen::Affine3d transform_of(const Gltf& gltf, const Json& node, const std::string& where) {
    if (!Gltf::member(node, "matrix").is_null()) {
        const std::vector<double> columns = numbers_of(node, "matrix", {});
        return Eigen::Affine3d(Eigen::Matrix4d(columns.data()));
    }
    const std::vector<double> t = numbers_of(node, "translation", {0, 0, 0}),
                              r = numbers_of(node, "rotation", {0, 0, 0, 1}),
                              s = numbers_of(node, "scale", {1, 1, 1});
    return composed(Eigen::Vector3d(t.data()), Eigen::Vector4d(r.data()), Eigen::Vector3d(s.data()),
                    gltf, where);
}

/// Of EXT_mesh_gpu_instancing; one that changes nothing where the node has none.
std::vector<Eigen::Affine3d> instances_of(const Gltf& gltf, const Json& node,
                                          GltfAccessors& accessors, const std::string& of) {
    const Json& extension =
        Gltf::member(Gltf::member(node, "extensions"), "EXT_mesh_gpu_instancing");
    if (extension.is_null()) return {Eigen::Affine3d::Identity()};
    const std::string where = of + ".EXT_mesh_gpu_instancing";
    const Json& attributes = Gltf::member(extension, "attributes");
    std::vector<double> t, r, s;
    std::size_t count = 0;
    const auto read = [&](const char* key, const char* kind, std::size_t each,
                          std::vector<double>& number) {
        const Json& accessor = Gltf::member(attributes, key);
        if (accessor.is_null()) return;
        const std::size_t at =
            gltf.index(accessor, gltf.list("accessors").size(), where + "." + key);
        number = accessors.numbers(at, kind, where + "." + key);
        if (count != 0 && number.size() != each * count) {
            throw gltf.fault(where + "." + key, fmt::format("has {} elements, expected {}",
                                                            number.size() / each, count));
        }
        count = number.size() / each;
    };
    read("TRANSLATION", "VEC3", 3, t);
    read("ROTATION", "VEC4", 4, r);
    read("SCALE", "VEC3", 3, s);
    std::vector<Eigen::Affine3d> instances;
    for (std::size_t i = 0; i < count; ++i) {
        using Three = Eigen::Vector3d;
        instances.push_back(
            composed(t.empty() ? Three(Three::Zero()) : Three(&t[3 * i]),
                     r.empty() ? Eigen::Vector4d(0, 0, 0, 1) : Eigen::Vector4d(&r[4 * i]),
                     s.empty() ? Three(Three::Ones()) : Three(&s[3 * i]), gltf, where));
    }
    if (instances.empty()) {
        throw gltf.fault(where, "has none of TRANSLATION, ROTATION and SCALE");
    }
    return instances;
}

Eigen::Affine3d transform_from_top(const Gltf& gltf, const std::vector<std::size_t>& parents,
                                   std::size_t node) {
    Eigen::Affine3d transform = Eigen::Affine3d::Identity();
    for (std::size_t at = node; at != no_parent; at = parents[at]) {
        transform =
            transform_of(gltf, gltf.list("nodes")[at], fmt::format("nodes[{}]", at)) * transform;
    }
    return transform;
}

/// From a mesh's axes as they were bound to each joint of a node's skin to the scene's.
std::vector<Eigen::Affine3d> joints_of(const Gltf& gltf, GltfAccessors& accessors,
                                       const std::vector<std::size_t>& parents, const Json& node,
                                       const std::string& where) {
    const Json &number = Gltf::member(node, "skin"), &skins = gltf.list("skins");
    if (number.is_null()) return {};
    const Json& skin = skins[gltf.index(number, skins.size(), where + ".skin")];
    const Json &joints = Gltf::member(skin, "joints"),
               &bound = Gltf::member(skin, "inverseBindMatrices");
    if (!joints.is_array() || joints.empty()) throw gltf.fault(where + ".skin", "has no joints");
    std::vector<double> inverse;
    if (!bound.is_null()) {
        inverse =
            accessors.numbers(gltf.index(bound, gltf.list("accessors").size(), where + ".skin"),
                              "MAT4", where + ".skin");
        if (inverse.size() < 16 * joints.size()) {
            throw gltf.fault(where + ".skin", fmt::format("has {} joints, but {} matrices",
                                                          joints.size(), inverse.size() / 16));
        }
    }
    std::vector<Eigen::Affine3d> transforms;
    for (std::size_t j = 0; j < joints.size(); ++j) {
        transforms.push_back(transform_from_top(
            gltf, parents, gltf.index(joints[j], parents.size(), where + ".skin.joints")));
        if (bound.is_null()) continue;
        transforms.back() = transforms.back() * Eigen::Affine3d(Eigen::Matrix4d(&inverse[16 * j]));
    }
    return transforms;
}

}  // namespace

std::vector<GltfPlacing> gltf_placings(const Gltf& gltf, GltfAccessors& accessors) {
    constexpr std::size_t most = 1'000'000;
    const std::vector<std::size_t> parents = check_nodes(gltf);
    const Json& nodes = gltf.list("nodes");
    std::vector<GltfPlacing> placings;
    std::size_t joints = 0;
    struct At {
        std::size_t node;
        Eigen::Affine3d above;
    };
    std::vector<At> next;
    for (const std::size_t top : tops(gltf, parents)) {
        next.push_back({top, Eigen::Affine3d::Identity()});
    }
    std::reverse(next.begin(), next.end());
    while (!next.empty()) {
        const At at = next.back();
        next.pop_back();
        const Json& node = nodes[at.node];
        const std::string where = fmt::format("nodes[{}]", at.node);
        const Eigen::Affine3d transform = at.above * transform_of(gltf, node, where);
        if (const Json& mesh = Gltf::member(node, "mesh"); !mesh.is_null()) {
            for (const Eigen::Affine3d& instance : instances_of(gltf, node, accessors, where)) {
                placings.push_back({mesh.get<std::size_t>(), at.node, transform * instance, {}});
            }
            placings.back().joint = joints_of(gltf, accessors, parents, node, where);
            joints += placings.back().joint.size();
        }
        if (placings.size() > most || joints > most) {
            throw gltf.fault(where, fmt::format("places more than {} meshes or joints", most));
        }
        const Json& children = Gltf::member(node, "children");
        for (auto child = children.rbegin(); child != children.rend(); ++child) {
            next.push_back({child->get<std::size_t>(), transform});
        }
    }
    return placings;
}

}  // namespace diurna
