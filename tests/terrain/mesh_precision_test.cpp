#include <catch2/catch.hpp>

#include "terrain/objects/placed_mesh.hpp"
#include "terrain/objects/ply_file.hpp"
#include "tests/support/read_mesh.hpp"
#include "tests/support/small_gltf.hpp"

using namespace diurna;
using namespace read_mesh;

namespace {

const PrivateTempFolder private_temp_folder;

const Eigen::Vector3d crate(1.2, 0.8, 0.9);
const double crate_area = 5.52;

std::string obj_of(const Box& box) {
    std::string text;
    for (const auto& corner : box.triangles()) {
        for (const Eigen::Vector3d& v : corner) {
            text += fmt::format("v {:.6f} {:.6f} {:.6f}\n", v.x(), v.y(), v.z());
        }
        text += "f -3 -2 -1\n";
    }
    return text;
}

std::string text_stl_of(const Box& box) {
    std::string text = "solid crate\n";
    for (const auto& corner : box.triangles()) {
        text += "facet normal 0 0 0\nouter loop\n";
        for (const Eigen::Vector3d& v : corner) {
            text += fmt::format("vertex {:.6f} {:.6f} {:.6f}\n", v.x(), v.y(), v.z());
        }
        text += "endloop\nendfacet\n";
    }
    return text + "endsolid crate\n";
}

std::string binary_stl_of(const Box& box) {
    std::string text(80, ' ');
    text += small_gltf::bytes_of<std::uint32_t>({12});
    for (const auto& corner : box.triangles()) {
        text += small_gltf::bytes_of<float>({0, 0, 0});
        for (const Eigen::Vector3d& v : corner) {
            text += small_gltf::bytes_of<float>({float(v.x()), float(v.y()), float(v.z())});
        }
        text += std::string(2, '\0');
    }
    return text;
}

}  // namespace

TEST_CASE("a crate in national coordinates keeps its size to a micrometre",
          "[terrain][mesh_file]") {
    const Eigen::Vector3d place =
        GENERATE(Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(751092.4, 4023151.5, 300.0),
                 Eigen::Vector3d(-9374000.25, 4344000.125, 250.0));
    const Box box{place, crate};
    ScratchFolder folder("ply");
    const MeshFile loose = mesh_of({box});
    write_ply(folder.path / "a.ply", loose.vertex, loose.triangle);
    for (const MeshFile& mesh : {file_of("a.obj", obj_of(box)), file_of("a.stl", text_stl_of(box)),
                                 read_mesh_file(folder.path / "a.ply")}) {
        CHECK(mesh.vertex.size() == 8);
        CHECK((size(mesh) - crate).norm() < 2e-6);
        CHECK(area(mesh) == Approx(crate_area).epsilon(1e-6));
        CHECK(volume(mesh) == Approx(0.864).epsilon(1e-6));
        CHECK(mesh.warnings.empty());
        // As it stands in a scene, in floats.
        const ObjectMesh placed =
            placed_mesh(mesh, {.up = UpAxis::z, .largest_edge = 5.0}, {MaterialId{0}});
        Eigen::AlignedBox3f stands;
        for (const Eigen::Vector3f& v : placed.vertex) stands.extend(v);
        CHECK((stands.sizes().cast<double>() - crate).norm() < 3e-6);
    }
}

TEST_CASE("a file that rounds its own coordinates is warned of", "[terrain][mesh_file]") {
    const Box away{{751092.4, 4023151.5, 300.0}, {120, 80, 90}};
    const MeshFile mesh = file_of("a.stl", binary_stl_of(away));
    REQUIRE(mesh.warnings.size() == 1);
    CHECK_THAT(mesh.warnings[0], Catch::Contains("32-bit"));
    CHECK(file_of("a.stl", binary_stl_of({{0, 0, 0}, crate})).warnings.empty());
}

TEST_CASE("polygons of OBJ and PLY are cut with their area", "[terrain][mesh_file]") {
    // A bar whose ends are an L of area 64; length 3; area 248 and volume 192.
    const double plan[6][2] = {{0, 0}, {10, 0}, {10, 4}, {4, 4}, {4, 10}, {0, 10}};
    std::string obj, ply;
    for (const double x : {0.0, 3.0}) {
        for (const auto& [y, z] : plan) {
            obj += fmt::format("v {} {} {}\n", x, y, z);
            ply += fmt::format("{} {} {}\n", x, y, z);
        }
    }
    std::vector<std::vector<int>> faces{{5, 4, 3, 2, 1, 0}, {6, 7, 8, 9, 10, 11}};
    for (int i = 0; i < 6; ++i) faces.push_back({i, (i + 1) % 6, 6 + (i + 1) % 6, 6 + i});
    for (const auto& face : faces) {
        obj += "f";
        ply += std::to_string(face.size());
        for (const int v : face) {
            obj += fmt::format(" {}", v + 1);
            ply += fmt::format(" {}", v);
        }
        obj += "\n";
        ply += "\n";
    }
    ply =
        "ply\nformat ascii 1.0\nelement vertex 12\nproperty float x\nproperty float y\n"
        "property float z\nelement face 8\nproperty list uchar int vertex_indices\nend_header\n" +
        ply;
    for (const MeshFile& mesh : {file_of("a.obj", obj), file_of("a.ply", ply)}) {
        CHECK(mesh.triangle.size() == 20);
        CHECK(area(mesh) == Approx(248.0));
        CHECK(volume(mesh) == Approx(192.0));
    }
    const MeshFile crossing = file_of("a.obj", "v 0 0 0\nv 2 2 0\nv 2 0 0\nv 0 2 0\nf 1 2 3 4\n");
    REQUIRE(crossing.warnings.size() == 1);
    CHECK_THAT(crossing.warnings[0], Catch::Contains("line 5"));
}

TEST_CASE("faces of OBJ may stand above their vertices, and in several groups",
          "[terrain][mesh_file]") {
    const MeshFile mesh =
        file_of("a.obj",
                "mtllib nowhere.mtl\nf 1 2 3\no one two\nusemtl red paint\nf 1 2 4\ng end\nusemtl\n"
                "f 2//1 3//1 4//1\nv 0 0 0\nv 1 0 0 1.0\nv 0 1 0 0.5 0.5 0.5\nv 0 0 1\nvn 0 0 1\n"
                "g one two\nusemtl red paint\nf 1/ 3/ 4/\n");
    CHECK(mesh.triangle.size() == 4);
    REQUIRE(mesh.part.size() == 3);
    CHECK(mesh.part[1].node == "one two");
    CHECK(mesh.part[1].material == "red paint");
    CHECK(mesh.part_of == std::vector<std::uint16_t>{0, 1, 2, 1});
}
