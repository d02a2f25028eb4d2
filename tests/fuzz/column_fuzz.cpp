#include "tests/corpus/yard.hpp"
#include "tests/fuzz/fuzzed.hpp"
#include "thermal/point/point_job.hpp"
#include "thermal/point/point_job_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzzed::Folder folder(yard::files());
    const auto file = folder.put("column.toml", fuzzed::text_of(data, size));
    return fuzzed::judge([&] { diurna::read_column_job(file); });
}
