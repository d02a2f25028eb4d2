#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "terrain/objects/mesh_words.hpp"

namespace diurna {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct PlyProperty {
    std::string name;
    PlyType type{};  // of a list: of its elements
    bool list = false;
    PlyType count{};       // of a list
    int axis = -1;         // 0 to 2: x, y or z of a vertex
    bool corners = false;  // the corners of a face
    bool strip = false;    // corners of triangle strips, −1 between them
};

struct PlyElement {
    std::string name;
    std::size_t rows = 0;
    std::vector<PlyProperty> property;
};

/// The header of a PLY file.
struct PlyHead {
    std::vector<PlyElement> element;
    bool text = false, big = false;  // big: big-endian
    long long vertices = 0;
};

/// Reads to the line end_header. Throws InputError for an invalid header, for vertices without x, y
/// and z, for faces without one list of corners (tristrips count as faces).
///
/// - bytes: size of the whole file, an upper limit for the number of rows
PlyHead read_ply_head(const std::string& name, MeshLines& lines, std::size_t bytes);

/// Size of a number [bytes].
std::size_t bytes_of(PlyType type);

}  // namespace diurna
