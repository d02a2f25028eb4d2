#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "tests/corpus/run_corpus.hpp"

namespace {

using corpus::changed;
using corpus::Family;
using corpus::Malformed;

Malformed mesh(const std::string& name, const std::string& file, const std::string& text) {
    return {.name = file + ": " + name,
            .files = {{"scene.toml", changed(yard::scene, "crate.obj", file)}, {file, text}}};
}

template <class T>
std::string bytes(T value) {
    std::string text(sizeof value, '\0');
    std::memcpy(text.data(), &value, sizeof value);
    return text;
}

Family obj() {
    const std::string& fine = yard::crate;
    const auto with = [&](const std::string& name, const std::string& from, const std::string& to) {
        return mesh(name, "m.obj", changed(fine, from, to));
    };
    std::string polygon = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf", many = fine;
    for (int i = 0; i < 3000000; ++i) polygon += i % 3 == 0 ? " 1" : i % 3 == 1 ? " 2" : " 3";
    return {
        mesh("nothing", "m.obj", ""),
        mesh("comments", "m.obj", "# nothing\n"),
        mesh("vertices alone", "m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n"),
        mesh("faces alone", "m.obj", "f 1 2 3\n"),
        with("v abc", "v -2 -2 0", "v abc"),
        with("v of words", "v -2 -2 0", "v a b c"),
        with("v 7,5", "v -2 -2 0", "v 7,5 0 0"),
        with("v -2,5 -2,5 0,0", "v -2 -2 0", "v -2,5 -2,5 0,0"),
        with("v of two numbers", "v -2 -2 0", "v -2 -2"),
        with("v of one number", "v -2 -2 0", "v -2"),
        with("v of none", "v -2 -2 0", "v"),
        with("v nan", "v -2 -2 0", "v nan 0 0"),
        with("v inf", "v -2 -2 0", "v inf 0 0"),
        with("v 1e999", "v -2 -2 0", "v 1e999 0 0"),
        with("v 1e39, beyond floats", "v -2 -2 0", "v 1e39 0 0"),
        with("v 1e30", "v -2 -2 0", "v 1e30 0 0"),
        with("v 1e7: 10 000 km", "v -2 -2 0", "v 1e7 0 0"),
        with("v 0x10", "v -2 -2 0", "v 0x10 0 0"),
        with("v 1.2.3", "v -2 -2 0", "v 1.2.3 0 0"),
        with("index 99", "f 1 4 3 2", "f 1 4 3 99"),
        with("index 0", "f 1 4 3 2", "f 0 4 3 2"),
        with("index -9", "f 1 4 3 2", "f -9 4 3 2"),
        with("index 1e3", "f 1 4 3 2", "f 1e3 4 3"),
        with("index 99999999999", "f 1 4 3 2", "f 99999999999 4 3"),
        with("index x", "f 1 4 3 2", "f x y z"),
        with("index 1.5", "f 1 4 3 2", "f 1.5 4 3"),
        with("index 1//99", "f 1 4 3 2", "f 1//99 4//1 3//1"),
        with("a face of two", "f 1 4 3 2", "f 1 4"),
        with("a face of one", "f 1 4 3 2", "f 1"),
        with("a face of none", "f 1 4 3 2", "f"),
        mesh("faces without area", "m.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n"),
        mesh("one point", "m.obj", "v 0 0 0\nv 0 0 0\nv 0 0 0\nf 1 2 3\n"),
        mesh("a face of one corner", "m.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 1\n"),
        mesh("a polygon of three million corners", "m.obj", polygon + "\n"),
        mesh("a line of 60 MB", "m.obj", fine + "g " + std::string(60000000, 'x') + "\n"),
        mesh("NULs", "m.obj", std::string(4000, '\0')),
        mesh("HTML", "m.obj", "<html><body>no</body></html>\n"),
        mesh("a curve", "m.obj", "v 0 0 0\nv 1 0 0\ncstype bezier\ndeg 3\ncurv 0 1 1 2 1 2\nend\n"),
        mesh("another ending", "m.fbx", fine),
        mesh("no ending", "m", fine),
    };
}

Family ply() {
    const auto head = [](const std::string& format, const std::string& vertices,
                         const std::string& faces) {
        return "ply\nformat " + format + " 1.0\nelement vertex " + vertices +
               "\nproperty float x\nproperty float y\nproperty float z\nelement face " + faces +
               "\nproperty list uchar int vertex_indices\nend_header\n";
    };
    const std::string three = "0 0 0\n1 0 0\n0 1 0\n", binary = "binary_little_endian";
    std::string points;
    for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) points += bytes(x);
    const std::string face = std::string("\x03") + bytes(0) + bytes(1) + bytes(2);
    const auto m = [](const std::string& name, const std::string& text) {
        return mesh(name, "m.ply", text);
    };
    return {
        m("nothing", ""),
        m("its name alone", "ply\n"),
        m("38 bytes", "ply\nformat ascii 1.0\nelement vertex 9999"),
        m("an element of 10^18", "ply\nelement x 1000000000000000000\nend_header\n"),
        m("10^18 points", head("ascii", "1000000000000000000", "1") + three),
        m("4 billion points", head("ascii", "4294967295", "1") + three + "3 0 1 2\n"),
        m("2 billion points, binary", head(binary, "2000000000", "1") + points + face),
        m("2 billion faces, binary", head(binary, "3", "2000000000") + points + face),
        m("2 billion faces", head("ascii", "3", "2000000000") + three + "3 0 1 2\n"),
        m("-1 points", head("ascii", "-1", "1") + three + "3 0 1 2\n"),
        m("x points", head("ascii", "x", "1") + three + "3 0 1 2\n"),
        m("fewer points than told", head("ascii", "4", "1") + three + "3 0 1 2\n"),
        m("fewer faces than told", head("ascii", "3", "2") + three + "3 0 1 2\n"),
        m("fewer points than told, binary", head(binary, "30", "1") + points + face),
        m("half a face, binary", head(binary, "3", "1") + points + face.substr(0, 7)),
        m("index 99", head("ascii", "3", "1") + three + "3 0 1 99\n"),
        m("index -1", head("ascii", "3", "1") + three + "3 0 1 -1\n"),
        m("index 99, binary",
          head(binary, "3", "1") + points + std::string("\x03") + bytes(0) + bytes(1) + bytes(99)),
        m("index -1, binary",
          head(binary, "3", "1") + points + std::string("\x03") + bytes(0) + bytes(1) + bytes(-1)),
        m("a list of -3", changed(head("ascii", "3", "1"), "uchar", "int") + three + "-3 0 1 2\n"),
        m("a list of -3, binary", changed(head(binary, "3", "1"), "uchar", "int") + points +
                                      bytes(-3) + bytes(0) + bytes(1) + bytes(2)),
        m("a list of 2 billion, binary",
          changed(head(binary, "3", "1"), "uchar", "int") + points + bytes(2000000000) + bytes(0)),
        m("a list of 4 billion, binary", changed(head(binary, "3", "1"), "uchar", "uint") + points +
                                             bytes(0xffffffffu) + bytes(0)),
        m("x is nan", head("ascii", "3", "1") + "nan 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
        m("x is a word", head("ascii", "3", "1") + "abc 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
        m("x is 7,5", head("ascii", "3", "1") + "7,5 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
        m("x is nan, binary",
          head(binary, "3", "1") + bytes(std::nanf("")) + points.substr(4) + face),
        m("a format that is none", head("ebcdic", "3", "1") + three + "3 0 1 2\n"),
        m("no format",
          changed(head("ascii", "3", "1"), "format ascii 1.0\n", "") + three + "3 0 1 2\n"),
        m("no end of head",
          changed(head("ascii", "3", "1"), "end_header\n", "") + three + "3 0 1 2\n"),
        m("a type that is none",
          changed(head("ascii", "3", "1"), "float x", "quad x") + three + "3 0 1 2\n"),
        m("points without z",
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
          "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0\n1 0\n0 1\n3 0 "
          "1 2\n"),
        m("no faces",
          "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty "
          "float z\nend_header\n" +
              three),
        m("faces of two", head("ascii", "3", "1") + three + "2 0 1\n"),
    };
}

Family stl() {
    const auto binary = [](std::uint32_t reported, int facets, float x) {
        std::string text(80, ' ');
        text += bytes(reported);
        for (int i = 0; i < facets; ++i) {
            for (const float value : {0.f, 0.f, 1.f, x, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f})
                text += bytes(value);
            text += std::string(2, '\0');
        }
        return text;
    };
    const auto m = [](const std::string& name, const std::string& text) {
        return mesh(name, "m.stl", text);
    };
    const std::string ascii =
        "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
        "0\nendloop\nendfacet\nendsolid s\n";
    return {
        m("nothing", ""),
        m("half a head", std::string(50, ' ')),
        m("4 billion facets", binary(0xffffffffu, 1, 0.f)),
        m("a hundred million facets", binary(100000000, 1, 0.f)),
        m("more facets than told", binary(1, 3, 0.f)),
        m("fewer facets than told", binary(3, 1, 0.f)),
        m("no facet", binary(0, 0, 0.f)),
        m("nan", binary(1, 1, std::nanf(""))),
        m("inf", binary(1, 1, INFINITY)),
        m("vertex abc", changed(ascii, "vertex 1 0 0", "vertex abc")),
        m("vertex 7,5", changed(ascii, "vertex 1 0 0", "vertex 7,5 0 0")),
        m("vertex nan", changed(ascii, "vertex 1 0 0", "vertex nan 0 0")),
        m("vertex of two", changed(ascii, "vertex 1 0 0", "vertex 1 0")),
        m("a facet of two", changed(ascii, "vertex 1 0 0\n", "")),
        m("a facet of five",
          changed(ascii, "vertex 1 0 0\n", "vertex 1 0 0\nvertex 1 0 0\nvertex 1 1 0\n")),
        m("no end", "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"),
        m("solid alone", "solid s\n"),
    };
}

std::string base64(const std::string& text) {
    constexpr char letters[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < text.size(); i += 3) {
        unsigned three = 0;
        for (std::size_t k = 0; k < 3; ++k)
            three =
                three << 8 | (i + k < text.size() ? static_cast<unsigned char>(text[i + k]) : 0u);
        for (int k = 3; k >= 0; --k)
            out += std::size_t(3 - k) > text.size() - i ? '=' : letters[three >> (6 * k) & 63];
    }
    return out;
}

std::string triangle_bytes() {
    std::string buffer;
    for (const float x : {0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) buffer += bytes(x);
    for (const std::uint16_t i : {0, 1, 2}) buffer += bytes(i);
    return buffer;
}

/// A glTF of one triangle, its buffer within.
std::string triangle(const std::string& nodes = R"([{"mesh":0}])",
                     const std::string& scene_nodes = "[0]") {
    const std::string buffer = triangle_bytes();
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":)" + scene_nodes +
           R"(}],"nodes":)" + nodes +
           R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],"accessors":[)"
           R"({"bufferView":0,"componentType":5126,"count":3,"type":"VEC3"},)"
           R"({"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}],"bufferViews":[)"
           R"({"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],)"
           R"("buffers":[{"byteLength":42,"uri":"data:application/octet-stream;base64,)" +
           base64(buffer) + R"("}]})";
}

/// - binary: its second piece; "": none
std::string glb(const std::string& json, std::uint32_t version = 2, std::string binary = "") {
    std::string padded = json;
    while (padded.size() % 4) padded += ' ';
    while (binary.size() % 4) binary += '\0';
    std::string pieces = bytes(std::uint32_t(padded.size())) + "JSON" + padded;
    if (!binary.empty()) {
        pieces += bytes(std::uint32_t(binary.size())) + std::string("BIN\0", 4) + binary;
    }
    return "glTF" + bytes(version) + bytes(std::uint32_t(12 + pieces.size())) + pieces;
}

/// The triangle with its buffer in the second piece, where GLB has it.
std::string whole_glb() {
    std::string json = triangle();
    const std::size_t uri = json.find(",\"uri\"");
    json.erase(uri, json.find('"', uri + 9) + 1 - uri);
    return glb(json, 2, triangle_bytes());
}

/// Node k has node k + 1 as its child, so many times.
std::string chain(int count, int times) {
    std::string nodes = "[";
    for (int k = 0; k + 1 < count; ++k) {
        nodes += "{\"children\":[";
        for (int c = 0; c < times; ++c) nodes += fmt::format("{}{}", c ? "," : "", k + 1);
        nodes += "]},";
    }
    return nodes + "{\"mesh\":0}]";
}

Family gltf() {
    const std::string fine = triangle();
    const auto m = [](const std::string& name, const std::string& text) {
        return mesh(name, "m.gltf", text);
    };
    const auto with = [&](const std::string& name, const std::string& from, const std::string& to) {
        return m(name, changed(fine, from, to));
    };
    const auto b = [](const std::string& name, const std::string& text) {
        return mesh(name, "m.glb", text);
    };
    const std::string whole = glb(fine);
    const std::string huge = bytes(0xfffffff0u);
    return {
        m("nothing", ""),
        m("no JSON", "{"),
        m("an empty object", "{}"),
        m("an array", "[]"),
        m("200 000 arrays in one another", std::string(200000, '[')),
        m("200 000 arrays in extras",
          changed(fine, "\"scene\":0",
                  fmt::format("\"extras\":{}{},\"scene\":0", std::string(200000, '['),
                              std::string(200000, ']')))),
        m("15 MB of commas", fmt::format("[{}]", std::string(15000000, ','))),
        m("version 1", changed(fine, "2.0", "1.0")),
        m("a chain of 20 000 nodes", triangle(chain(20000, 1))),
        m("children doubled 27 times", triangle(chain(27, 2))),
        m("children doubled 60 times", triangle(chain(60, 2))),
        m("a node that is its own child", triangle(R"([{"mesh":0,"children":[0]}])")),
        m("two nodes that have each other",
          triangle(R"([{"children":[1]},{"mesh":0,"children":[0]}])")),
        m("a child that is not there", triangle(R"([{"mesh":0,"children":[7]}])")),
        m("a child of -1", triangle(R"([{"mesh":0,"children":[-1]}])")),
        m("a mesh that is not there", triangle(R"([{"mesh":7}])")),
        m("a scene's node that is not there", triangle(R"([{"mesh":0}])", "[9]")),
        m("a node of 3 numbers", triangle(R"([{"mesh":0,"matrix":[1,2,3]}])")),
        m("a scale of 1e38", triangle(R"([{"mesh":0,"scale":[1e38,1e38,1e38]}])")),
        m("a scale of 1e300", triangle(R"([{"mesh":0,"scale":[1e300,1e300,1e300]}])")),
        m("a translation of words", triangle(R"([{"mesh":0,"translation":["a",0,0]}])")),
        with("a scene that is not there", "\"scene\":0", "\"scene\":5"),
        with("an accessor beyond its buffer", "\"count\":3,\"type\":\"VEC3\"",
             "\"count\":3000,\"type\":\"VEC3\""),
        with("an accessor of 4 billion", "\"count\":3,\"type\":\"VEC3\"",
             "\"count\":4294967295,\"type\":\"VEC3\""),
        with("indices beyond their buffer", "\"count\":3,\"type\":\"SCALAR\"",
             "\"count\":300,\"type\":\"SCALAR\""),
        with("an accessor of -3", "\"count\":3,\"type\":\"VEC3\"",
             "\"count\":-3,\"type\":\"VEC3\""),
        with("an accessor that is not there", "\"POSITION\":0", "\"POSITION\":9"),
        with("no positions", "\"POSITION\":0", "\"NORMAL\":0"),
        with("a view that is not there", "\"bufferView\":1", "\"bufferView\":9"),
        with("a view beyond its buffer", "\"byteOffset\":36,\"byteLength\":6",
             "\"byteOffset\":36,\"byteLength\":600"),
        with("a view that begins beyond it", "\"byteOffset\":36,\"byteLength\":6",
             "\"byteOffset\":3600,\"byteLength\":6"),
        with("a view at -36", "\"byteOffset\":36", "\"byteOffset\":-36"),
        with("a buffer that is not there", "\"buffer\":0,\"byteOffset\":0",
             "\"buffer\":3,\"byteOffset\":0"),
        with("a buffer shorter than told", "\"byteLength\":42", "\"byteLength\":4200"),
        with("a buffer of 4 billion", "\"byteLength\":42", "\"byteLength\":4294967295"),
        with("a type that is none", "\"VEC3\"", "\"VEC9\""),
        with("positions as scalars", "\"VEC3\"", "\"SCALAR\""),
        with("positions as matrices", "\"VEC3\"", "\"MAT4\""),
        with("a component that is none", "5126", "9999"),
        with("base64 that is none", "base64,", "base64,!!!!"),
        with("a file that is not there", "data:application/octet-stream;base64,", "nothing.bin?"),
        m("index 7",
          changed(
              fine,
              base64(bytes(std::uint16_t(0)) + bytes(std::uint16_t(1)) + bytes(std::uint16_t(2))),
              base64(bytes(std::uint16_t(0)) + bytes(std::uint16_t(1)) + bytes(std::uint16_t(7))))),
        m("points", changed(fine, "\"indices\":1", "\"indices\":1,\"mode\":0")),
        m("a mode that is none", changed(fine, "\"indices\":1", "\"indices\":1,\"mode\":99")),
        b("nothing", ""),
        b("12 bytes that claim 4 GB", "glTF" + bytes(2u) + huge),
        b("20 bytes that claim 4 GB", "glTF" + bytes(2u) + huge + huge + "JSON"),
        b("a piece longer than the file", "glTF" + bytes(2u) + bytes(40u) + huge + "JSON{}  "),
        b("half of it", whole.substr(0, whole.size() / 2)),
        b("version 7", glb(fine, 7)),
        b("text", "solid"),
        b("no JSON in it", changed(whole, "JSON", "XXXX")),
        b("a chain of 20 000 nodes", glb(triangle(chain(20000, 1)))),
        b("children doubled 27 times", glb(triangle(chain(27, 2)))),
    };
}

/// What the scene says of its meshes.
Family keys() {
    const auto with = [](const std::string& name, const std::string& more) {
        return corpus::scene(name, "mesh = \"crate.obj\"\n", "mesh = \"crate.obj\"\n" + more);
    };
    const auto parts = [](const std::string& name, const std::string& text) {
        return Malformed{.name = name, .files = {{"crate.parts.toml", text}}};
    };
    return {
        corpus::scene("no such mesh", "crate.obj", "nothing.obj"),
        with("metres that are none", "scale = 1e6\n"),
        with("a crate of 40 m in micrometres", "scale = 1e-6\n"),
        with("copies as text", "copies = \"many\"\n"),
        with("copies and a place", "copies = [[1.0, 2.0, 3.0]]\n"),
        corpus::scene("copies far away",
                      "mesh = \"crate.obj\"\nup = \"z\"\nmaterial = \"painted_steel\"\nplace_m = "
                      "[10.0, 5.0]\nheading_deg = 30.0",
                      "mesh = \"crate.obj\"\nup = \"z\"\nmaterial = \"painted_steel\"\ncopies = "
                      "[[0.0, 0.0, 0.0], [1e9, 0.0, 0.0]]"),
        parts("parts that are none", "[[part]]\nname = \"nothing\"\ninside = \"room\"\n"),
        parts("a broken part file", "[[part]\n"),
        parts("a part file of NULs", std::string(100, '\0')),
        parts("a room of -1", "[[enclosure]]\nname = \"room\"\nvolume_m3 = -1.0\n"),
        parts("a lump of nan", "[[lump]]\nname = \"engine\"\nheat_W = nan\n"),
    };
}

Family copies() {
    Family cases;
    for (const auto& [name, text] : std::map<std::string, std::string>{
             {"nothing", ""},
             {"the head alone", "east_m,north_m,heading_deg\n"},
             {"text", "east_m,north_m,heading_deg\na,b,c\n"},
             {"nan", "east_m,north_m,heading_deg\nnan,0,0\n"},
             {"far away", "east_m,north_m,heading_deg\n0,0,0\n1e12,0,0\n"},
             {"a column twice", "east_m,east_m,north_m,heading_deg\n0,1,0,0\n1,2,50,0\n"},
             {"no heading", "east_m,north_m\n0,0\n"},
             {"a short row", "east_m,north_m,heading_deg\n0,0\n"}}) {
        Malformed given =
            corpus::scene("copies: " + name, "place_m = [10.0, 5.0]\nheading_deg = 30.0",
                          "copies_file = \"c.csv\"");
        given.files["c.csv"] = text;
        cases.push_back(given);
    }
    return cases;
}

}  // namespace

TEST_CASE("malformed OBJ files are refused") { corpus::no_fault("obj", obj()); }
TEST_CASE("malformed PLY files are refused") { corpus::no_fault("ply", ply()); }
TEST_CASE("malformed STL files are refused") { corpus::no_fault("stl", stl()); }
TEST_CASE("malformed glTF files are refused") { corpus::no_fault("gltf", gltf()); }
TEST_CASE("objects that cannot be are refused") { corpus::no_fault("objects", keys()); }
TEST_CASE("malformed lists of copies are refused") { corpus::no_fault("copies", copies()); }
TEST_CASE("the glTF that the corpus changes is fine") {
    const ScratchFolder scratch("gltf");
    for (const auto& [name, text] : {std::pair{"m.gltf", triangle()}, {"m.glb", whole_glb()}}) {
        const Malformed given = mesh("fine", name, text);
        corpus::put_files(scratch.path / "yard", given.files);
        const corpus::Ended ended = corpus::run(scratch.path / "yard", given.words);
        INFO(ended.reported);
        CHECK(ended.code == 0);
    }
}
