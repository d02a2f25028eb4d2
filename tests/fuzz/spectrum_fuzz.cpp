#include "materials/radiation/spectrum.hpp"
#include "tests/fuzz/fuzzed.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzzed::Folder folder;
    const auto file = folder.put("spectrum.csv", fuzzed::text_of(data, size));
    return fuzzed::judge([&] { diurna::read_spectrum(file, 0.0, 1.0); });
}
