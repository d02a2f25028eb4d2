#include "terrain/objects/mesh_file.hpp"
#include "tests/fuzz/fuzzed.hpp"

/// The first byte chooses the kind.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzzed::Folder folder;
    if (size == 0) return 0;
    const char* const kinds[] = {".obj", ".ply", ".stl", ".gltf", ".glb"};
    const std::string kind = kinds[data[0] % 5];
    const auto file = folder.put("mesh" + kind, fuzzed::text_of(data + 1, size - 1));
    return fuzzed::judge([&] { diurna::read_mesh_file(file); });
}
