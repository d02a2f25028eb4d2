#include "terrain/objects/weld_vertices.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "terrain/objects/mesh_pieces.hpp"
#include "tests/support/read_mesh.hpp"

using namespace diurna;
using namespace read_mesh;

namespace {

const PrivateTempFolder private_temp_folder;

/// Loose triangles whose corners lie up to `apart` from where they should, along each axis.
MeshFile loose(const std::vector<std::array<Eigen::Vector3d, 3>>& triangles, double apart) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> way(-apart, apart);
    MeshFile mesh{.part = {{"a", ""}}};
    for (const auto& corner : triangles) {
        const auto first = static_cast<std::uint32_t>(mesh.vertex.size());
        for (const Eigen::Vector3d& at : corner) {
            const double x = way(random), y = way(random), z = way(random);
            mesh.vertex.push_back(at + Eigen::Vector3d(x, y, z));
        }
        mesh.triangle.push_back({first, first + 1, first + 2});
        mesh.part_of.push_back(0);
    }
    return mesh;
}

MeshPieces pieces_of(const MeshFile& mesh) { return mesh_pieces(mesh.vertex, mesh.triangle); }

const Box crate{{0, 0, 0}, {1.2, 0.8, 0.9}};

/// A square of n × n squares, each of two triangles, at a height.
std::vector<std::array<Eigen::Vector3d, 3>> sheet(int n, double height) {
    std::vector<std::array<Eigen::Vector3d, 3>> all;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const auto at = [&](int x, int y) {
                return Eigen::Vector3d(double(i + x) / n, double(j + y) / n, height);
            };
            all.push_back({at(0, 0), at(1, 0), at(1, 1)});
            all.push_back({at(0, 0), at(1, 1), at(0, 1)});
        }
    }
    return all;
}

}  // namespace

TEST_CASE("a box whose triangles lie apart by some of its size is one closed body",
          "[terrain][weld]") {
    const double apart = GENERATE(1e-12, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4, 3e-4);
    const double scale = GENERATE(1e-3, 1.0, 1e3);  // mm, km: it is the shape that counts
    CAPTURE(apart, scale);
    MeshFile mesh = loose(crate.triangles(), apart);
    for (Eigen::Vector3d& at : mesh.vertex) at *= scale;
    const WeldedVertices welded = weld_vertices(mesh);
    CHECK(welded.joined == 36 - 8);
    CHECK(welded.farthest <= 4.0 * apart * scale);
    CHECK(welded.nearly_closed == 0);
    const MeshPieces pieces = pieces_of(mesh);
    REQUIRE(pieces.size() == 1);
    CHECK(pieces.closed[0]);
    CHECK(pieces.rows.empty());
    CHECK(area(mesh) == Approx(5.52 * scale * scale).epsilon(10.0 * apart));
    CHECK(volume(mesh) == Approx(0.864 * scale * scale * scale).epsilon(10.0 * apart));
    CHECK_FALSE(welded_note(welded).empty());
}

TEST_CASE("a corner of two vertices with a needle between them is one corner", "[terrain][weld]") {
    const double apart = GENERATE(1e-12, 1e-9, 1e-7, 3e-7, 1e-6);
    CAPTURE(apart);
    // Two of the triangles at a corner end a little beside it, along an edge of both.
    MeshFile mesh = loose(crate.triangles(), 0.0);
    weld_vertices(mesh);
    const std::uint32_t corner = mesh.triangle[0][0];
    const auto second = static_cast<std::uint32_t>(mesh.vertex.size());
    mesh.vertex.push_back(mesh.vertex[corner] + Eigen::Vector3d(apart, 0.0, 0.0));
    std::vector<std::size_t> at;  // triangles at the corner
    for (std::size_t t = 0; t < mesh.triangle.size(); ++t) {
        for (const std::uint32_t v : mesh.triangle[t]) {
            if (v == corner) at.push_back(t);
        }
    }
    // One takes the second vertex; needles lie along its two edges at the corner.
    const std::size_t moved = at.front();
    auto& triangle = mesh.triangle[moved];
    const std::size_t k =
        std::size_t(std::find(triangle.begin(), triangle.end(), corner) - triangle.begin());
    const std::uint32_t next = triangle[(k + 1) % 3], last = triangle[(k + 2) % 3];
    triangle[k] = second;
    mesh.triangle.push_back({corner, next, second});
    mesh.triangle.push_back({second, last, corner});
    mesh.part_of.resize(mesh.triangle.size(), 0);
    weld_vertices(mesh);
    const MeshPieces pieces = pieces_of(mesh);
    REQUIRE(pieces.size() == 1);
    CHECK(pieces.closed[0]);
    CHECK(mesh.triangle.size() == 12);
    CHECK(area(mesh) == Approx(5.52).epsilon(10.0 * apart + 1e-12));
}

TEST_CASE("what is apart by more is left open and warned of", "[terrain][weld]") {
    MeshFile gaps = loose(crate.triangles(), 3e-3);
    const WeldedVertices welded = weld_vertices(gaps);
    CHECK(welded.joined == 0);
    CHECK(welded.nearly_closed == 1);
    CHECK(welded.gap > 1e-3);
    CHECK_FALSE(nearly_closed_warning(welded).empty());

    auto triangles = crate.triangles();
    triangles.pop_back();  // half of a side of 0.8 m by 0.9 m
    MeshFile hole = loose(triangles, 0.0);
    const WeldedVertices found = weld_vertices(hole);
    CHECK(found.nearly_closed == 1);
    CHECK(found.hole_share == Approx(0.36 / (5.52 - 0.36)).epsilon(1e-6));
}

TEST_CASE("what is meant to be open is not warned of", "[terrain][weld]") {
    auto open_box = crate.triangles();
    open_box.erase(open_box.begin() + 2, open_box.begin() + 4);  // no lid
    for (const auto& triangles : {open_box, sheet(4, 0.0)}) {
        MeshFile mesh = loose(triangles, 0.0);
        const WeldedVertices welded = weld_vertices(mesh);
        CHECK(welded.nearly_closed == 0);
        CHECK(pieces_of(mesh).size() == 1);
    }
}

TEST_CASE("a sheet of loose triangles is one sheet", "[terrain][weld]") {
    const double apart = GENERATE(1e-7, 1e-6, 1e-5, 3e-5);
    MeshFile mesh = loose(sheet(4, 0.0), apart);
    const WeldedVertices welded = weld_vertices(mesh);
    const MeshPieces pieces = pieces_of(mesh);
    CHECK(pieces.size() == 1);
    CHECK_FALSE(pieces.closed[0]);
    CHECK(pieces.rims.size() == 16);
    CHECK(welded.joined == 6 * 16 - 25);
}

TEST_CASE("thin bodies and sheets side by side stay as they are", "[terrain][weld]") {
    MeshFile foil = mesh_of({{{0, 0, 0}, {1, 1, 2e-6}}});
    weld_vertices(foil);
    CHECK(foil.triangle.size() == 12);
    CHECK(volume(foil) == Approx(2e-6));

    const double height = GENERATE(1e-4, 1e-3);
    auto both = sheet(4, 0.0);
    for (const auto& triangle : sheet(4, height)) both.push_back(triangle);
    MeshFile two = loose(both, 0.0);
    weld_vertices(two);
    const MeshPieces pieces = pieces_of(two);
    CHECK(pieces.size() == 2);
    CHECK_FALSE(pieces.closed[0]);
    CHECK_FALSE(pieces.closed[1]);
}
