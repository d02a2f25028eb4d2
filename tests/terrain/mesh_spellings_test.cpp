#include <catch2/catch.hpp>
#include <string>

#include "materials/base/error.hpp"
#include "terrain/objects/mesh_pieces.hpp"
#include "terrain/objects/weld_vertices.hpp"
#include "tests/support/read_mesh.hpp"

// Meshes as programs write them: comments, marks, capitals, strips; corners that lie on each other.

using namespace diurna;
using namespace read_mesh;

namespace {

const PrivateTempFolder private_temp_folder;

const std::string tetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

std::string replaced(std::string text, const std::string& part, const std::string& by) {
    for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += by.size()) {
        text.replace(at, part.size(), by);
    }
    return text;
}

bool is_closed(const MeshFile& mesh) {
    return mesh_pieces(mesh.vertex, mesh.triangle).rims.empty();
}

}  // namespace

TEST_CASE("what OBJ files have beside their numbers changes no result", "[terrain][mesh][obj]") {
    const MeshFile plain = file_of("a.obj", tetrahedron);
    for (const std::string& text :
         {replaced(tetrahedron, "\n", " # a comment\n"), replaced(tetrahedron, "\n", "# glued\n"),
          "\xEF\xBB\xBF" + tetrahedron, "# C:\\models\\\n" + tetrahedron,
          "mtllib C:\\a\\\n" + tetrahedron, replaced(tetrahedron, "f 1 3 2", "f 1 3 \\\n2")}) {
        CAPTURE(text);
        const MeshFile mesh = file_of("a.obj", text);
        CHECK(mesh.vertex.size() == 4);
        CHECK(mesh.triangle.size() == 4);
        CHECK(volume(mesh) == Approx(1.0 / 6.0));
    }
    CHECK(file_of("a.obj", "usemtl paint#2\n" + tetrahedron).part.at(0).material == "paint#2");
    CHECK_THROWS_WITH(file_of("a.obj", std::string("\xFF\xFE", 2) + tetrahedron),
                      Catch::Contains("UTF-16"));
}

TEST_CASE("STL in capitals is STL", "[terrain][mesh][stl]") {
    const std::string facet =
        "FACET NORMAL 0 0 -1\nOUTER LOOP\nVERTEX 0 0 0\nVERTEX 0 1 0\nVERTEX 1 0 0\nENDLOOP\n"
        "ENDFACET\n";
    const std::string text = "SOLID BOX\n" + facet + "ENDSOLID BOX\n";
    CHECK(area(file_of("a.stl", text + std::string(100, ' '))) == Approx(0.5));
}

TEST_CASE("PLY: strips of triangles are faces, points are not", "[terrain][mesh][ply]") {
    const std::string head =
        "ply\nformat ascii 1.0\nCOMMENT made here\\\nelement vertex 8\nproperty float x\n"
        "property float y\nproperty float z\n";
    const std::string corners =
        "-1 -1 0\n1 -1 0\n1 1 0\n-1 1 0\n-1 -1 1.5\n1 -1 1.5\n1 1 1.5\n-1 1 1.5\n";
    const std::string strips =
        head + "element tristrips 1\nproperty list int int vertex_indices\nend_header\n" + corners +
        "14 4 5 7 6 2 5 1 4 0 7 3 2 0 1\n";
    MeshFile box = file_of("a.ply", strips);
    CHECK(box.triangle.size() == 12);
    CHECK(is_closed(box));
    CHECK(area(box) == Approx(2.0 * 4.0 + 4.0 * 3.0));
    CHECK(std::abs(volume(box)) == Approx(6.0));
    // Two strips, −1 between them: top and bottom.
    const MeshFile two =
        file_of("a.ply", head + "element tristrips 1\nproperty list int int vertex_indices\n" +
                             "end_header\n" + corners + "9 4 5 7 6 -1 0 3 1 2\n");
    CHECK(two.triangle.size() == 4);
    CHECK_THROWS_WITH(file_of("a.ply", head + "end_header\n" + corners),
                      Catch::Contains("point cloud"));
}

TEST_CASE("a corner that is two vertices with a needle between them is one",
          "[terrain][mesh][weld]") {
    const double apart = GENERATE(1e-12, 1e-10, 1e-8, 1e-7, 3e-7, 1e-6);
    CAPTURE(apart);
    // A tetrahedron whose top is two vertices: a needle closes the edge that each has of its own.
    MeshFile mesh{.part = {{"a", ""}}};
    mesh.vertex = {{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {apart, 0, 2}};
    mesh.triangle = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 4}, {3, 1, 4}, {3, 4, 2}};
    mesh.part_of.assign(mesh.triangle.size(), 0);
    weld_vertices(mesh);
    CHECK(mesh.triangle.size() == 4);
    CHECK(is_closed(mesh));
    CHECK(volume(mesh) == Approx(8.0 / 6.0));
}

TEST_CASE("a pole of loose triangles, whose corners lie nearly together, is closed",
          "[terrain][mesh][weld]") {
    // A cone whose tip is a ring of corners 1e-7 apart; every triangle has corners of its own.
    const int n = 24;
    MeshFile mesh{.part = {{"a", ""}}};
    const auto at = [&](double radius, double z, int k) {
        const double angle = 2.0 * 3.14159265358979 * (k % n) / n;
        return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), z);
    };
    const auto add = [&](const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                         const Eigen::Vector3d& c) {
        const auto first = static_cast<std::uint32_t>(mesh.vertex.size());
        mesh.vertex.insert(mesh.vertex.end(), {a, b, c});
        mesh.triangle.push_back({first, first + 1, first + 2});
        mesh.part_of.push_back(0);
    };
    for (int k = 0; k < n; ++k) {
        add({0, 0, 0}, at(1.0, 0.0, k + 1), at(1.0, 0.0, k));
        add(at(1.0, 0.0, k), at(1.0, 0.0, k + 1), at(1e-7, 1.0, k));
        add(at(1.0, 0.0, k + 1), at(1e-7, 1.0, k + 1), at(1e-7, 1.0, k));
    }
    weld_vertices(mesh);
    CHECK(is_closed(mesh));
    CHECK(mesh.triangle.size() == std::size_t(2 * n));
    CHECK(std::abs(volume(mesh)) ==
          Approx(0.5 * n * std::sin(2.0 * 3.14159265358979 / n) / 3.0).epsilon(1e-5));
}

TEST_CASE("a corner beside the edge of another face is joined to the edge",
          "[terrain][mesh][weld]") {
    const double gap = GENERATE(0.0, 1e-5, 2e-4, 1e-3);
    CAPTURE(gap);
    // A box of 2 m: its top has a corner in the middle of its front edge, moved inward by the gap.
    MeshFile mesh{.part = {{"a", ""}}};
    mesh.vertex = {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0},  {0, 0, 2},
                   {2, 0, 2}, {2, 2, 2}, {0, 2, 2}, {1, gap, 2}};
    mesh.triangle = {{0, 2, 1}, {0, 3, 2}, {0, 1, 5}, {0, 5, 4}, {1, 2, 6}, {1, 6, 5}, {2, 3, 7},
                     {2, 7, 6}, {3, 0, 4}, {3, 4, 7}, {4, 8, 7}, {8, 5, 6}, {8, 6, 7}};
    mesh.part_of.assign(mesh.triangle.size(), 0);
    const WeldedVertices welded = weld_vertices(mesh);
    CHECK(welded.nearly_closed == 0);
    CHECK(volume(mesh) == Approx(8.0).epsilon(1e-3));
    CHECK(is_closed(mesh));
    if (gap > 2e-4) CHECK_THAT(welded_note(welded), Catch::Contains("with an edge"));
}
