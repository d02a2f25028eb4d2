#include "tests/fuzz/fuzzed.hpp"
#include "thermal/weather_file/read_weather.hpp"

/// The first byte chooses the file's extension, and with it what format is expected.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzzed::Folder folder;
    if (size == 0) return 0;
    const char* const names[] = {"w.csv", "w.epw", "w.dat", "w.tab", "w.nc", "w.txt"};
    const auto file = folder.put(names[data[0] % 6], fuzzed::text_of(data + 1, size - 1));
    return fuzzed::judge([&] { diurna::read_weather(file); });
}
