#include <catch2/catch.hpp>

#include "materials/base/error.hpp"
#include "tests/support/read_mesh.hpp"
#include "tests/support/small_gltf.hpp"

using namespace diurna;
using namespace small_gltf;
using read_mesh::area;
using read_mesh::size;
using read_mesh::volume;

namespace {

const PrivateTempFolder private_temp_folder;

/// What the refusal of a file says; "": it was read.
std::string refusal(const Parts& parts) {
    try {
        read(parts);
    } catch (const InputError& error) {
        return error.mistakes().front().line();
    }
    return "";
}

Parts with_mode(int mode, std::vector<std::uint16_t> indices) {
    Parts parts;
    parts.primitive =
        fmt::format(R"({{"attributes":{{"POSITION":0}},"indices":1,"mode":{}}})", mode);
    parts.data[1] = {bytes_of(indices), 5123, indices.size(), "SCALAR"};
    return parts;
}

}  // namespace

TEST_CASE("a box of glTF has its area and volume", "[terrain][gltf]") {
    const MeshFile mesh = read({});
    CHECK(mesh.vertex.size() == 8);
    CHECK(area(mesh) == Approx(20.0));
    CHECK(volume(mesh) == Approx(6.0));
    REQUIRE(mesh.part.size() == 1);
    CHECK(mesh.part[0].node == "box");
    CHECK(mesh.notes.empty());
    CHECK(mesh.warnings.empty());
}

TEST_CASE("indices past the last vertex are refused in every mode", "[terrain][gltf]") {
    const int mode = GENERATE(range(0, 7));
    const std::uint16_t index = GENERATE(std::uint16_t{8}, std::uint16_t{60000});
    CAPTURE(mode, index);
    CHECK_THAT(refusal(with_mode(mode, {0, 1, 2, 3, 4, index})),
               Catch::Contains(fmt::format("found index {} (number 5)", index)));
}

TEST_CASE("fewer indices than a mode needs are refused", "[terrain][gltf]") {
    const auto [mode, count] = GENERATE(table<int, std::size_t>(
        {{1, 1}, {1, 3}, {2, 1}, {3, 1}, {4, 2}, {4, 35}, {5, 1}, {5, 2}, {6, 1}, {6, 2}}));
    CAPTURE(mode, count);
    std::vector<std::uint16_t> indices = box_indices();
    indices.resize(count);
    CHECK_THAT(refusal(with_mode(mode, indices)),
               Catch::Contains(fmt::format("found {} indices", count)));
}

TEST_CASE("without indices the vertices are counted", "[terrain][gltf]") {
    Parts parts;
    parts.primitive = R"({"attributes":{"POSITION":0}})";
    CHECK_THAT(refusal(parts), Catch::Contains("found 8 vertices for triangles"));
}

TEST_CASE("strips and fans are drawn as glTF numbers them", "[terrain][gltf]") {
    // The side z = 1 of the box, seen from outside.
    for (const auto& [mode, indices] :
         {std::pair{5, std::vector<std::uint16_t>{4, 5, 6, 7}}, {6, {4, 5, 7, 6}}}) {
        CAPTURE(mode);
        const MeshFile mesh = read(with_mode(mode, indices));
        REQUIRE(mesh.triangle.size() == 2);
        CHECK(area(mesh) == Approx(3.0));
        for (const auto& [a, b, c] : mesh.triangle) {
            const Eigen::Vector3d normal =
                (mesh.vertex[b] - mesh.vertex[a]).cross(mesh.vertex[c] - mesh.vertex[a]);
            CHECK(normal.z() > 0.0);
        }
    }
}

TEST_CASE("a node that mirrors its mesh keeps it facing outward", "[terrain][gltf]") {
    const std::string placed =
        GENERATE(as<std::string>{}, R"({"mesh":0,"scale":[-1,1,1]})",
                 R"({"mesh":0,"scale":[-1,-1,-1]})", R"({"mesh":0,"scale":[-1,-1,1]})",
                 R"({"mesh":0,"matrix":[0,0,1,0,0,1,0,0,1,0,0,0,5,6,7,1]})",
                 R"({"mesh":0,"rotation":[0,2,0,2],"scale":[1,-1,1]})");
    Parts parts{.nodes = "[" + placed + "]"};
    CAPTURE(placed);
    CHECK(volume(read(parts)) == Approx(6.0));
    // An open sheet, too: the side z = 1 faces away from what was the box's middle.
    parts.data[1] = {bytes_of(std::vector<std::uint16_t>{4, 5, 7}), 5123, 3, "SCALAR"};
    const MeshFile whole = read({.nodes = "[" + placed + "]"}), sheet = read(parts);
    Eigen::Vector3d middle = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& v : whole.vertex) middle += v / 8.0;
    const auto& [a, b, c] = sheet.triangle.at(0);
    const Eigen::Vector3d normal =
        (sheet.vertex[b] - sheet.vertex[a]).cross(sheet.vertex[c] - sheet.vertex[a]);
    CHECK(normal.dot(sheet.vertex[a] - middle) > 0.0);
}

TEST_CASE("nodes place what is below them", "[terrain][gltf]") {
    const MeshFile mesh =
        read({.nodes = R"([{"children":[1,2],"translation":[500000.1,100,4000000.2]},
{"mesh":0,"translation":[-4,0,0]},{"children":[3],"scale":[2,2,2]},{"mesh":0}])"});
    CHECK(mesh.triangle.size() == 24);
    CHECK(volume(mesh) == Approx(6.0 + 48.0).epsilon(1e-6));
    CHECK((size(mesh) - Eigen::Vector3d(7, 3, 4)).norm() < 1e-6);
}

TEST_CASE("instances of EXT_mesh_gpu_instancing are each there", "[terrain][gltf]") {
    const bool required = GENERATE(false, true);
    Parts parts{.nodes = R"([{"mesh":0,"scale":[2,2,2],"extensions":{"EXT_mesh_gpu_instancing":
{"attributes":{"TRANSLATION":2,"ROTATION":3,"SCALE":4}}}}])"};
    parts.more = required ? R"(,"extensionsRequired":["EXT_mesh_gpu_instancing"])" : "";
    parts.data.push_back({bytes_of<float>({0, 0, 0, 10, 0, 0, 20, 0, 0, 30, 0, 0}), 5126, 4});
    // Quarter turns about y, as shares of 127.
    parts.data.push_back(
        {bytes_of<std::int8_t>({0, 90, 0, 90, 0, 0, 0, 127, 0, 127, 0, 0, 0, 0, 0, 127}), 5120, 4,
         "VEC4", ",\"normalized\":true"});
    parts.data.push_back({bytes_of<float>({1, 1, 1, 1, 2, 1, -1, 1, 1, 1, 1, 3}), 5126, 4});
    const MeshFile mesh = read(parts);
    CHECK(mesh.triangle.size() == 48);
    CHECK(volume(mesh) == Approx(8.0 * 6.0 * (1 + 2 + 1 + 3)).epsilon(1e-6));
    CHECK(size(mesh).x() == Approx(64.0).epsilon(1e-6));

    parts.data[4].count = 3;
    CHECK_THAT(refusal(parts), Catch::Contains("SCALE") && Catch::Contains("expected 4"));
}

TEST_CASE("positions in whole numbers have the right size", "[terrain][gltf]") {
    const std::string says = R"(,"extensionsUsed":["KHR_mesh_quantization"])";
    std::vector<std::int16_t> shorts, shares;
    std::vector<std::uint8_t> small;
    const std::vector<float> places = box_places();
    for (std::size_t i = 0; i < places.size(); ++i) {
        shorts.push_back(std::int16_t(1000 * places[i]));
        shares.push_back(std::int16_t(places[i] * 32767 / 1.5f));
        small.push_back(std::uint8_t(2 * places[i] + 2));
        if (i % 3 != 2) continue;
        shorts.push_back(0);  // to four bytes
        shares.push_back(0);
        small.push_back(0);
    }
    struct Case {
        Data data;
        std::string scale;
    };
    for (const auto& [data, scale] :
         {Case{{bytes_of(shorts), 5122, 8, "VEC3", "", 8}, "[0.001,0.001,0.001]"},
          Case{{bytes_of(shares), 5122, 8, "VEC3", ",\"normalized\":true", 8}, "[1.5,1.5,1.5]"},
          Case{{bytes_of(small), 5121, 8, "VEC3", "", 4}, "[0.5,0.5,0.5]"},
          Case{{bytes_of(small), 5121, 8, "VEC3", ",\"normalized\":true", 4},
               "[127.5,127.5,127.5]"}}) {
        Parts parts{.nodes = R"([{"mesh":0,"scale":)" + scale + "}]", .more = says};
        parts.data[0] = data;
        const MeshFile mesh = read(parts);
        CAPTURE(scale);
        CHECK((size(mesh) - Eigen::Vector3d(2.0, 1.5, 2.0)).norm() < 2e-4);
        CHECK(volume(mesh) == Approx(6.0).epsilon(2e-4));
        parts.more = "";
        CHECK_THAT(refusal(parts), Catch::Contains("KHR_mesh_quantization"));
    }
}

TEST_CASE("an extension that is required and not followed is refused by its name",
          "[terrain][gltf]") {
    const std::string name = GENERATE(as<std::string>{}, "KHR_draco_mesh_compression",
                                      "EXT_meshopt_compression", "KHR_meshopt_compression",
                                      "MSFT_lod", "CESIUM_RTC", "KHR_node_visibility", "ABC_xyz");
    CHECK_THAT(refusal({.more = fmt::format(R"(,"extensionsRequired":["{}"])", name)}),
               Catch::Contains(name));
    // Where it is not required the file says that it can be read without.
    CHECK(refusal({.more = fmt::format(R"(,"extensionsUsed":["{}"])", name)}).empty());
}

TEST_CASE("extensions of materials, textures and lights change no shape", "[terrain][gltf]") {
    const MeshFile mesh = read({.more = R"(,"extensionsRequired":["KHR_materials_unlit",
"KHR_texture_basisu","EXT_texture_webp","KHR_texture_transform","KHR_lights_punctual"])"});
    CHECK(volume(mesh) == Approx(6.0));
}

TEST_CASE("buffers that are packed are refused by how", "[terrain][gltf]") {
    Parts parts;
    parts.primitive = R"({"attributes":{"POSITION":0},"indices":1,"extensions":
{"KHR_draco_mesh_compression":{"bufferView":0,"attributes":{"POSITION":0}}}})";
    CHECK(refusal(parts).empty());  // its accessors have data of their own
    std::string text = text_of(parts);
    text.replace(text.find(R"("bufferView":0,"componentType")"), 15, "");
    CHECK_THROWS_WITH(read_mesh::file_of("a.gltf", text),
                      Catch::Contains("KHR_draco_mesh_compression"));
    text = text_of({});
    const std::size_t uri = text.find(",\"uri\"");
    text.replace(uri, text.find('}', uri) - uri,
                 R"(,"extensions":{"EXT_meshopt_compression":{"fallback":true}})");
    CHECK_THROWS_WITH(read_mesh::file_of("a.gltf", text),
                      Catch::Contains("EXT_meshopt_compression"));
}

TEST_CASE("sparse accessors put their values in place of others", "[terrain][gltf]") {
    Parts parts;
    parts.data.push_back({bytes_of<std::uint16_t>({6, 7}), 5123, 2, "SCALAR"});
    parts.data.push_back({bytes_of<float>({-1, 3, 1, 1, 3, 1}), 5126, 2});
    parts.data[0].more = R"(,"sparse":{"count":2,"indices":{"bufferView":2,"componentType":5123},
"values":{"bufferView":3}})";
    CHECK(size(read(parts)).y() == Approx(3.0));
    parts.data[2].bytes = bytes_of<std::uint16_t>({6, 8});
    CHECK_THAT(refusal(parts), Catch::Contains("found index 8"));
}

TEST_CASE("a glTF of version 1 is refused", "[terrain][gltf]") {
    std::string text = text_of({});
    text.replace(text.find("2.0"), 3, "1.0");
    CHECK_THROWS_WITH(read_mesh::file_of("a.gltf", text), Catch::Contains("version '1.0'"));
}

// Two joints: one stays, the other lifts what hangs on it by 2; the node's own place does not
// count.
TEST_CASE("a skin puts its mesh where its joints are", "[terrain][gltf]") {
    Parts parts{.nodes = R"([{"mesh":0,"skin":0,"translation":[50,0,0]},{"children":[2]},
{"translation":[0,5,0]}])",
                .top = "[0,1]",
                .more = R"(,"skins":[{"joints":[1,2],"inverseBindMatrices":4}])"};
    parts.primitive = R"({"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"indices":1})";
    std::vector<std::uint8_t> joints;
    std::vector<float> shares, bound;
    for (int k = 0; k < 8; ++k) {
        for (const int j : {0, 1, 0, 0}) joints.push_back(std::uint8_t(j));
        const float lifted = (k & 2) != 0 ? 1.f : 0.f;
        for (const float w : {1.f - lifted, lifted, 0.f, 0.f}) shares.push_back(w);
    }
    for (const float down : {0.f, -3.f}) {
        for (int i = 0; i < 16; ++i) bound.push_back(i % 5 == 0 ? 1.f : i == 13 ? down : 0.f);
    }
    parts.data.push_back({bytes_of(joints), 5121, 8, "VEC4"});
    parts.data.push_back({bytes_of(shares), 5126, 8, "VEC4"});
    parts.data.push_back({bytes_of(bound), 5126, 2, "MAT4"});
    const MeshFile mesh = read(parts);
    CHECK((size(mesh) - Eigen::Vector3d(2.0, 3.5, 2.0)).norm() < 1e-6);
    CHECK(mesh.vertex[0].x() == Approx(-1.0));
    CHECK(volume(mesh) == Approx(14.0));
    parts.more = R"(,"skins":[{"joints":[1]}])";
    CHECK_THAT(refusal(parts), Catch::Contains("found joint 1"));
}

TEST_CASE("morph targets move places by their weights", "[terrain][gltf]") {
    Parts parts{.nodes = R"([{"mesh":0},{"mesh":0,"translation":[9,0,0],"weights":[2]}])",
                .top = "[0,1]"};
    parts.primitive =
        R"({"attributes":{"POSITION":0},"indices":1,"targets":[{"POSITION":2}]}],"weights":[1],"x":[)"
        "0";
    std::vector<float> up;
    for (int k = 0; k < 8; ++k) {
        for (const float x : {0.f, (k & 2) != 0 ? 0.5f : 0.f, 0.f}) up.push_back(x);
    }
    parts.data.push_back({bytes_of(up), 5126, 8});
    CHECK(volume(read(parts)) == Approx(4.0 * (1.5 + 0.5) + 4.0 * (1.5 + 1.0)));
}
