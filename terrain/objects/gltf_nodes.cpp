#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "terrain/objects/gltf_json.hpp"
#include "terrain/objects/mesh_gate.hpp"

namespace diurna {

namespace {

using Json = nlohmann::json;

constexpr std::size_t most_depth = 256;  // of nodes: who reads them calls itself

constexpr auto no_parent = std::size_t(-1);

/// `k` is the child of `parent`; throws where it has another.
void adopt(const Gltf& gltf, std::vector<std::size_t>& parents, std::size_t k, std::size_t parent,
           const std::string& where) {
    if (parents[k] != no_parent) {
        throw gltf.fault(where, fmt::format("node {} is a child twice, expected a tree", k));
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
            throw gltf.fault(fmt::format("nodes[{}]", i),
                             fmt::format("lies more than {} deep, or below itself", most_depth));
        }
        for (auto node = way.rbegin(); node != way.rend(); ++node) depth[*node] = ++above;
    }
}

/// The same tree where nodes have names.
void check_named_nodes(const Gltf& gltf) {
    const Json& nodes = Gltf::member(gltf.all(), "nodes");
    std::map<std::string, std::size_t> number;
    for (const auto& [key, node] : nodes.items()) number.emplace(key, number.size());
    std::vector<std::size_t> parents(nodes.size(), no_parent);
    for (const auto& [key, node] : nodes.items()) {
        const std::string where = fmt::format("nodes.{}.children", key.substr(0, 40));
        const Json& children = Gltf::member(node, "children");
        if (children.is_null()) continue;
        if (!children.is_array()) throw gltf.fault(where, "is no array");
        for (const Json& child : children) {
            const auto found =
                child.is_string() ? number.find(child.get<std::string>()) : number.end();
            if (found == number.end()) {
                throw gltf.fault(where, fmt::format("no node {}", Gltf::shown(child)));
            }
            adopt(gltf, parents, found->second, number.at(key), where);
        }
    }
    check_depths(gltf, parents);
}

/// Nodes are trees: each has one parent at most, none is below itself, none too deep.
void check_nodes(const Gltf& gltf) {
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
        if (!children.is_array()) throw gltf.fault(where + ".children", "is no array");
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
        if (!roots.is_array()) throw gltf.fault("scenes.nodes", "is no array");
        for (const Json& root : roots) gltf.index(root, nodes.size(), "scenes.nodes");
    }
    const Json& chosen = Gltf::member(gltf.all(), "scene");
    if (!chosen.is_null()) gltf.index(chosen, scenes.size(), "scene");
}

}  // namespace

void check_gltf_nodes(const Gltf& gltf) {
    if (gltf.first_version()) {
        check_named_nodes(gltf);
    } else {
        check_nodes(gltf);
    }
}

}  // namespace diurna
