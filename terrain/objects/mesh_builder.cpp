#include "terrain/objects/mesh_builder.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <bit>
#include <limits>

#include "materials/base/error.hpp"
#include "materials/base/number_of.hpp"
#include "materials/base/plain_text.hpp"
#include "terrain/objects/cut_polygon.hpp"
#include "terrain/objects/mesh_readers.hpp"
#include "terrain/objects/weld_vertices.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_triangles = 5'000'000;

/// Takes out vertices that are no corner of a triangle.
void drop_unused(MeshFile& mesh) {
    constexpr auto none = std::uint32_t(-1);
    std::vector<std::uint32_t> number(mesh.vertex.size(), none);
    for (const auto& corner : mesh.triangle) {
        for (const std::uint32_t v : corner) number[v] = 0;
    }
    std::uint32_t kept = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (number[v] == none) continue;
        mesh.vertex[kept] = Eigen::Vector3d(mesh.vertex[v]);
        number[v] = kept++;
    }
    mesh.vertex.resize(kept);
    for (auto& corner : mesh.triangle) {
        for (std::uint32_t& v : corner) v = number[v];
    }
}

}  // namespace

std::size_t MeshBuilder::Hash::operator()(const std::array<double, 3>& at) const {
    std::uint64_t key = 0;
    for (const double x : at) {
        key = (key ^ std::bit_cast<std::uint64_t>(x)) * 0x9e3779b97f4a7c15u;
        key ^= key >> 31;
    }
    return key;
}

std::uint16_t MeshBuilder::part(const std::string& node, const std::string& material) {
    const auto [known, fresh] =
        parts_.try_emplace({node, material}, static_cast<std::uint16_t>(mesh_.part.size()));
    if (fresh) {
        if (mesh_.part.size() > std::numeric_limits<std::uint16_t>::max()) {
            throw InputError(name_, "has more than 65536 parts");
        }
        mesh_.part.push_back({plain(node), plain(material)});
    }
    return known->second;
}

std::uint32_t MeshBuilder::vertex(const Eigen::Vector3d& at) {
    if (!(at.array().abs() <= most_coordinate).all()) {
        throw InputError(name_,
                         fmt::format("a vertex is not finite or exceeds {:g}: {:g} {:g} {:g}",
                                     most_coordinate, at.x(), at.y(), at.z()));
    }
    // −0 is 0.
    const std::array<double, 3> place{at.x() + 0.0, at.y() + 0.0, at.z() + 0.0};
    const auto [known, fresh] =
        number_.try_emplace(place, static_cast<std::uint32_t>(mesh_.vertex.size()));
    if (fresh) mesh_.vertex.emplace_back(place[0], place[1], place[2]);
    return known->second;
}

void MeshBuilder::triangle(const std::array<std::uint32_t, 3>& corner, std::uint16_t part) {
    if (mesh_.triangle.size() >= most_triangles) {
        throw InputError(name_, fmt::format("has more than {} triangles", most_triangles));
    }
    const auto [a, b, c] = corner;
    if (a == b || b == c || c == a) return;
    mesh_.triangle.push_back(corner);
    mesh_.part_of.push_back(part);
}

void MeshBuilder::polygon(std::span<const std::uint32_t> corner, std::uint16_t part,
                          const std::string& where) {
    if (corner.size() == 3) {
        triangle({corner[0], corner[1], corner[2]}, part);
        return;
    }
    std::vector<Eigen::Vector3d> places;
    for (const std::uint32_t v : corner) places.push_back(mesh_.vertex[v]);
    const CutPolygon cut = cut_polygon(places);
    if (!cut.sound && crossing_++ == 0) first_crossing_ = where;
    for (const auto& [a, b, c] : cut.triangle) triangle({corner[a], corner[b], corner[c]}, part);
}

void MeshBuilder::note(const std::string& line) {
    if (std::find(mesh_.notes.begin(), mesh_.notes.end(), line) == mesh_.notes.end()) {
        mesh_.notes.push_back(line);
    }
}

void MeshBuilder::stored_as_float(double largest) {
    step_ = std::max(step_, largest * double(std::numeric_limits<float>::epsilon()));
}

MeshFile MeshBuilder::finish() {
    if (mesh_.triangle.empty()) throw InputError(name_, "has no triangles");
    const WeldedVertices welded = weld_vertices(mesh_);
    if (mesh_.triangle.empty()) throw InputError(name_, "has only triangles without area");
    drop_unused(mesh_);
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& at : mesh_.vertex) box.extend(at);
    const double size = box.sizes().maxCoeff();
    if (step_ > 1e-3 * size) {
        warn(fmt::format(
            "its coordinates are 32-bit numbers with a spacing of {:.2g} this far from the origin; "
            "the mesh has a size of {:.3g} (the file's unit), so its shape is rounded",
            step_, size));
    }
    if (crossing_ > 0) {
        warn(fmt::format(
            "{} of its mesh self-intersecting, the first at {}: the triangles cover another area",
            number_of(crossing_, "polygon", "polygons"), first_crossing_));
    }
    if (const std::string line = welded_note(welded); !line.empty()) note(line);
    if (const std::string line = nearly_closed_warning(welded); !line.empty()) warn(line);
    return std::move(mesh_);
}

}  // namespace diurna
