#include "scenes/job/input/scene_file.hpp"
#include "tests/corpus/yard.hpp"
#include "tests/fuzz/fuzzed.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzzed::Folder folder(yard::files());
    const auto file = folder.put("scene.toml", fuzzed::text_of(data, size));
    return fuzzed::judge([&] { diurna::read_scene(file); });
}
