#include "materials/air/radiosonde.hpp"
#include "tests/fuzz/fuzzed.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzzed::Folder folder;
    const auto file = folder.put("sonde.csv", fuzzed::text_of(data, size));
    return fuzzed::judge([&] { diurna::read_radiosonde(file); });
}
