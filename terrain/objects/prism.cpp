#include "terrain/objects/prism.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/base/error.hpp"

namespace diurna {

namespace {

/// Counterclockwise, without repeated corners.
Ring tidy(const Ring& given) {
    Ring ring;
    for (const auto& p : given) {
        if (!p.allFinite()) throw InputError("building", "a corner is not a finite number");
        if (ring.empty() || (p - ring.back()).norm() > 1e-4) ring.push_back(p);
    }
    while (ring.size() > 1 && (ring.front() - ring.back()).norm() <= 1e-4) ring.pop_back();
    if (ring.size() < 3) {
        throw InputError("building",
                         fmt::format("found {} corners; a plan has three or more", ring.size()));
    }
    double area = 0.0;
    for (std::size_t i = 1; i + 1 < ring.size(); ++i) area += turn(ring[0], ring[i], ring[i + 1]);
    if (area < 0.0) std::reverse(ring.begin(), ring.end());
    return ring;
}

/// Triangles of a simple ring by cutting off ears (Meisters 1975).
std::vector<std::array<std::uint32_t, 3>> ears(const Ring& ring) {
    std::vector<std::uint32_t> left(ring.size());
    for (std::size_t i = 0; i < left.size(); ++i) left[i] = static_cast<std::uint32_t>(i);
    std::vector<std::array<std::uint32_t, 3>> triangles;
    const auto is_ear = [&](std::size_t i) {
        const std::size_t n = left.size();
        const auto &a = ring[left[(i + n - 1) % n]], &b = ring[left[i]],
                   &c = ring[left[(i + 1) % n]];
        if (turn(a, b, c) < 0.0) return false;
        return std::none_of(left.begin(), left.end(), [&](std::uint32_t k) {
            const auto& p = ring[k];
            return &p != &a && &p != &b && &p != &c && turn(a, b, p) >= 0.0 &&
                   turn(b, c, p) >= 0.0 && turn(c, a, p) >= 0.0;
        });
    };
    while (left.size() > 3) {
        std::size_t i = 0;
        while (i < left.size() && !is_ear(i)) ++i;
        if (i == left.size()) throw InputError("building", "its plan crosses itself");
        const std::size_t n = left.size();
        triangles.push_back({left[(i + n - 1) % n], left[i], left[(i + 1) % n]});
        left.erase(left.begin() + static_cast<std::ptrdiff_t>(i));
    }
    if (turn(ring[left[0]], ring[left[1]], ring[left[2]]) < 0.0) {
        throw InputError("building", "its plan crosses itself");
    }
    triangles.push_back({left[0], left[1], left[2]});
    return triangles;
}

}  // namespace

ObjectMesh prism(const PrismSpec& spec) {
    const Ring ring = tidy(spec.ring);
    ObjectMesh mesh;
    const auto add = [&](const Eigen::Vector2d& p, double z) {
        mesh.vertex.push_back(Eigen::Vector3d(p.x(), p.y(), z).cast<float>());
        return static_cast<std::uint32_t>(mesh.vertex.size() - 1);
    };
    const auto face = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, MaterialId material) {
        mesh.triangle.push_back({a, b, c});
        mesh.material.push_back(material);
    };
    const auto parts = [&](double length) {
        return std::max(1, static_cast<int>(std::ceil(length / spec.largest_edge)));
    };
    const int storeys = parts(spec.top - spec.bottom);
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Eigen::Vector2d a = ring[i], b = ring[(i + 1) % ring.size()];
        const int along = parts((b - a).norm());
        const auto first = static_cast<std::uint32_t>(mesh.vertex.size());
        for (int v = 0; v <= storeys; ++v) {
            for (int u = 0; u <= along; ++u) {
                add(a + (b - a) * (double(u) / along),
                    spec.bottom + (spec.top - spec.bottom) * v / storeys);
            }
        }
        const auto row = static_cast<std::uint32_t>(along + 1);
        for (std::uint32_t v = 0; v < static_cast<std::uint32_t>(storeys); ++v) {
            for (std::uint32_t u = 0; u + 1 < row; ++u) {
                const std::uint32_t p = first + v * row + u;
                face(p, p + 1, p + row + 1, spec.wall);
                face(p, p + row + 1, p + row, spec.wall);
            }
        }
    }
    const auto roof = static_cast<std::uint32_t>(mesh.vertex.size());
    for (const auto& p : ring) add(p, spec.top);
    for (const auto& [a, b, c] : ears(ring)) face(roof + a, roof + b, roof + c, spec.roof);
    return mesh;
}

}  // namespace diurna
