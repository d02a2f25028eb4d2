#include "terrain/objects/placed_mesh.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "materials/base/error.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

struct Piece {
    std::array<std::uint32_t, 3> corner;
    std::uint32_t whole;  // the triangle of the file it lies in
};

/// Halves every edge longer than a limit. What happens to an edge depends on its two ends alone, so
/// the triangles on its sides agree.
class EdgeCutter {
 public:
    EdgeCutter(std::vector<Eigen::Vector3d>& vertex, double longest)
        : vertex_(vertex), longest_(longest) {}

    std::vector<Piece> round(const std::vector<Piece>& pieces) {
        std::vector<Piece> out;
        out.reserve(pieces.size() * 2);
        for (const Piece& piece : pieces) cut(piece, out);
        return out;
    }

 private:
    double length(std::uint32_t a, std::uint32_t b) const {
        return (vertex_[a] - vertex_[b]).norm();
    }

    void cut(Piece piece, std::vector<Piece>& out) {
        auto& corner = piece.corner;
        const std::array<double, 3> edge{length(corner[0], corner[1]), length(corner[1], corner[2]),
                                         length(corner[2], corner[0])};
        std::rotate(corner.begin(),
                    corner.begin() + (std::max_element(edge.begin(), edge.end()) - edge.begin()),
                    corner.end());
        const auto [p, q, r] = corner;  // p-q is the longest
        if (length(p, q) <= longest_) {
            out.push_back(piece);
            return;
        }
        const auto keep = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
            out.push_back({{a, b, c}, piece.whole});
        };
        const std::uint32_t m = middle(p, q);
        if (length(q, r) > longest_) {
            const std::uint32_t n = middle(q, r);
            keep(m, q, n);
            keep(m, n, r);
        } else {
            keep(m, q, r);
        }
        if (length(r, p) > longest_) {
            const std::uint32_t n = middle(r, p);
            keep(p, m, n);
            keep(n, m, r);
        } else {
            keep(p, m, r);
        }
    }

    std::uint32_t middle(std::uint32_t a, std::uint32_t b) {
        const auto [known, fresh] = middle_.try_emplace({std::min(a, b), std::max(a, b)},
                                                        static_cast<std::uint32_t>(vertex_.size()));
        if (fresh) {
            const Eigen::Vector3d at = 0.5 * (vertex_[a] + vertex_[b]);
            vertex_.push_back(at);
        }
        return known->second;
    }

    std::vector<Eigen::Vector3d>& vertex_;
    double longest_;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle_;
};

/// The file's axes turned to east, north, up, with the front looking north.
Eigen::Vector3d upright(const Eigen::Vector3d& v, UpAxis up) {
    return up == UpAxis::z ? v : Eigen::Vector3d(-v.x(), v.z(), v.y());
}

/// Throws InputError for what is smaller than anything that a picture shows: of another unit.
void check_size(const std::vector<Eigen::Vector3d>& vertex) {
    constexpr double least = 1e-3;  // [m]
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& v : vertex) box.extend(v);
    const double size = vertex.empty() ? 0.0 : box.sizes().maxCoeff();
    if (size >= least) return;
    throw InputError("object",
                     fmt::format("has a size of {:.2g} m, expected at least {:g} m", size, least),
                     "check unit and scale of the file");
}

/// Throws InputError where cutting would make more triangles than a mesh's file may have: the
/// smallest number is that of equilateral ones, and of a thin one that of its edge's parts.
void check_pieces(const std::vector<Eigen::Vector3d>& vertex, const MeshFile& mesh,
                  double longest) {
    constexpr double most = 5e6;
    double pieces = 0.0;
    for (const auto& [a, b, c] : mesh.triangle) {
        const Eigen::Vector3d ab = vertex[b] - vertex[a], ac = vertex[c] - vertex[a];
        const double area = 0.5 * ab.cross(ac).norm() / (0.433 * longest * longest);
        const double edge = std::max({ab.norm(), ac.norm(), (ac - ab).norm()}) / longest;
        pieces += std::max({1.0, area, edge});
    }
    if (pieces <= most) return;
    throw InputError(
        "object",
        fmt::format("gives {:.2g} triangles with edges of {:g} m, expected at most {:g}", pieces,
                    longest, most),
        "increase largest_edge_m, or change unit or scale");
}

}  // namespace

MeshFrame::MeshFrame(const MeshFile& mesh, const Placing& placing)
    : up_(placing.up), metres_(placing.metres) {
    Eigen::AlignedBox3d box;
    for (const Eigen::Vector3d& v : mesh.vertex) box.extend(upright(v, up_) * metres_);
    foot_ = {box.center().x(), box.center().y(), box.min().z()};
}

Eigen::Vector3d MeshFrame::place(const Eigen::Vector3d& vertex) const {
    return upright(vertex, up_) * metres_ - foot_;
}

Eigen::Vector3d MeshFrame::direction(const Eigen::Vector3d& in_file) const {
    return upright(in_file, up_);
}

ObjectMesh placed_mesh(const MeshFile& mesh, const Placing& placing,
                       const std::vector<MaterialId>& material) {
    const MeshFrame frame(mesh, placing);
    std::vector<Eigen::Vector3d> vertex;
    for (const Eigen::Vector3d& v : mesh.vertex) vertex.push_back(frame.place(v));
    // Cut as it is made, so that the same object is the same triangles however it is turned.
    check_size(vertex);
    check_pieces(vertex, mesh, placing.largest_edge);
    std::vector<Piece> pieces;
    for (std::uint32_t t = 0; t < mesh.triangle.size(); ++t)
        pieces.push_back({mesh.triangle[t], t});
    EdgeCutter cutter(vertex, placing.largest_edge);
    for (std::size_t before = 0; before != pieces.size();) {
        before = pieces.size();
        pieces = cutter.round(pieces);
    }

    // Clockwise from north is against the sense of a turn about the vertical.
    const Eigen::AngleAxisd turn(-radians(placing.heading_deg), Eigen::Vector3d::UnitZ());
    const bool level = placing.pitch_deg == 0.0 && placing.roll_deg == 0.0;
    const Eigen::Quaterniond turns =
        turn * Eigen::AngleAxisd(radians(placing.pitch_deg), Eigen::Vector3d::UnitX()) *
        Eigen::AngleAxisd(radians(placing.roll_deg), Eigen::Vector3d::UnitY());
    for (Eigen::Vector3d& v : vertex) {
        const Eigen::Vector3d turned = level ? turn * v : turns * v;
        v = placing.base + turned;
    }

    ObjectMesh placed;
    for (const Eigen::Vector3d& v : vertex) placed.vertex.push_back(v.cast<float>());
    for (const Piece& piece : pieces) {
        placed.triangle.push_back(piece.corner);
        placed.material.push_back(material[mesh.part_of[piece.whole]]);
    }
    return placed;
}

}  // namespace diurna
