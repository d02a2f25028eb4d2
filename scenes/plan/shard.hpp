#pragma once

#include <cstddef>
#include <string>

namespace diurna {

/// One of the parts in which a job is shared out among processes.
struct Shard {
    std::size_t number = 1, count = 1;  // 1 to count; 0: nothing of it
    bool all() const { return count == 1 && number == 1; }
};

/// "2/4". Throws InputError of --shard.
Shard read_shard(const std::string& text);

/// What of so many things in order is a shard's, [first, last): neighbours stay together, no part
/// has two more than another.
struct ShardRange {
    std::size_t first, last;
};
ShardRange range_of(const Shard& shard, std::size_t things);

}  // namespace diurna
