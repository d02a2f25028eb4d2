#include "scenes/job/plan/shard.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "materials/base/error.hpp"

namespace diurna {

Shard read_shard(const std::string& text) {
    Shard shard;
    int used = 0;
    if (std::sscanf(text.c_str(), "%zu/%zu%n", &shard.number, &shard.count, &used) != 2 ||
        std::size_t(used) != text.size() || shard.count < 1 || shard.number > shard.count) {
        throw InputError(
            "--shard",
            fmt::format("found '{}', expected I/N with I from 1 to N, or 0/N for temperatures only",
                        text));
    }
    return shard;
}

ShardRange range_of(const Shard& shard, std::size_t things) {
    if (shard.number == 0) return {0, 0};
    return {things * (shard.number - 1) / shard.count, things * shard.number / shard.count};
}

}  // namespace diurna
