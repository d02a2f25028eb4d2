#pragma once

#include <cstddef>
#include <string>

namespace diurna {

/// One of the parts into which a job is divided for several processes.
struct Shard {
    std::size_t number = 1, count = 1;  // 1 to count; 0: empty
    bool all() const { return count == 1 && number == 1; }
};

/// Parses "2/4". Throws InputError for --shard.
Shard read_shard(const std::string& text);

/// The range of a shard in an ordered list, [first, last): neighbours stay together, and the sizes
/// of the shards differ by at most one.
struct ShardRange {
    std::size_t first, last;
};
ShardRange range_of(const Shard& shard, std::size_t things);

}  // namespace diurna
