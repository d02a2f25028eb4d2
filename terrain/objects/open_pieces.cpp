#include "terrain/objects/open_pieces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

namespace diurna {

namespace {

/// The same number for vertices at the same place.
std::vector<std::uint32_t> places(const std::vector<Eigen::Vector3f>& vertex) {
    std::map<std::array<float, 3>, std::uint32_t> known;
    std::vector<std::uint32_t> place;
    for (std::uint32_t v = 0; v < vertex.size(); ++v) {
        const Eigen::Vector3f& at = vertex[v];
        place.push_back(known.try_emplace({at.x(), at.y(), at.z()}, v).first->second);
    }
    return place;
}

/// Sets that grow together (union-find).
class Pieces {
 public:
    explicit Pieces(std::size_t triangles) : up_(triangles) {
        std::iota(up_.begin(), up_.end(), 0u);
    }
    std::uint32_t of(std::uint32_t t) {
        while (up_[t] != t) t = up_[t] = up_[up_[t]];
        return t;
    }
    void join(std::uint32_t a, std::uint32_t b) { up_[of(a)] = of(b); }

 private:
    std::vector<std::uint32_t> up_;
};

/// An edge of one triangle.
struct Rim {
    std::uint32_t triangle;
    Eigen::Vector3d from, to;
    double length = (to - from).norm();
};

/// The length of `rim` along which `other` lies on the same line.
double length_shared(const Rim& rim, const Rim& other) {
    const Eigen::Vector3d a = other.from - rim.from;
    const double length = rim.length, close = 1e-4 * length, reach = length + other.length;
    if (a.squaredNorm() > reach * reach) return 0.0;
    const Eigen::Vector3d unit = (rim.to - rim.from) / length, b = other.to - rim.from;
    if (a.cross(unit).norm() > close || b.cross(unit).norm() > close) return 0.0;
    const double first = std::min(a.dot(unit), b.dot(unit)),
                 last = std::max(a.dot(unit), b.dot(unit));
    return std::max(0.0, std::min(last, length) - std::max(first, 0.0));
}

/// Whether other rims of its piece run along all of it.
bool is_mended(const Rim& rim, const std::vector<Rim>& piece) {
    double shared = 0.0;
    for (const Rim& other : piece) {
        if (&other != &rim) shared += length_shared(rim, other);
    }
    return shared > 0.999 * rim.length;
}

}  // namespace

std::vector<std::uint8_t> open_pieces(const ObjectMesh& mesh) {
    constexpr std::size_t most_compared = 4000;  // rims of a piece: more are no rows by an edge
    const std::vector<std::uint32_t> place = places(mesh.vertex);
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> sides;
    for (std::uint32_t t = 0; t < mesh.triangle.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = place[mesh.triangle[t][k]],
                                b = place[mesh.triangle[t][(k + 1) % 3]];
            if (a != b) sides[std::minmax(a, b)].push_back(t);
        }
    }
    Pieces pieces(mesh.triangle.size());
    for (const auto& [edge, triangles] : sides) {
        for (const std::uint32_t t : triangles) pieces.join(triangles.front(), t);
    }
    std::vector<Rim> rims;
    for (const auto& [edge, triangles] : sides) {
        if (triangles.size() != 1) continue;
        rims.push_back({triangles.front(), mesh.vertex[edge.first].cast<double>(),
                        mesh.vertex[edge.second].cast<double>()});
    }
    // A row of triangles beside a long edge hangs together with what is beyond it.
    if (rims.size() <= most_compared) {
        for (const Rim& rim : rims) {
            for (const Rim& other : rims) {
                if (length_shared(rim, other) > 0.0) pieces.join(rim.triangle, other.triangle);
            }
        }
    }
    std::map<std::uint32_t, std::vector<Rim>> rims_of;
    for (const Rim& rim : rims) rims_of[pieces.of(rim.triangle)].push_back(rim);
    std::vector<std::uint8_t> open(mesh.triangle.size(), 0);
    for (const auto& [piece, its] : rims_of) {
        const bool closed = its.size() <= most_compared &&
                            std::all_of(its.begin(), its.end(), [&, &its = its](const Rim& rim) {
                                return is_mended(rim, its);
                            });
        open[piece] = closed ? 0 : 1;
    }
    for (std::uint32_t t = 0; t < open.size(); ++t) open[t] = open[pieces.of(t)];
    return open;
}

}  // namespace diurna
