#include "materials/modtran/tape7.hpp"
#include "tests/fuzz/fuzzed.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    return fuzzed::judge(
        [&] { diurna::read_tape7_text("run.tape7", fuzzed::text_of(data, size)); });
}
