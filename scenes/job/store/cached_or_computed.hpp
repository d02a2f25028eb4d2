#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>

#include "scenes/job/store/stage_bytes.hpp"
#include "scenes/job/store/stage_store.hpp"

namespace diurna {

/// Result of a stage: from the cache, or computed and stored.
///
/// - store: null: no cache
/// - key: () of all inputs; called if there is a store
/// - read: (bytes) inverse of content_of()
template <class T, class Key, class Read, class Find>
T cached_or_computed(const StageStore* store, std::string_view stage, const Key& key,
                     const Read& read, const Find& find) {
    if (store == nullptr) return find();
    const std::string name = key();
    if (const std::optional<std::string> kept = store->find(stage, name)) {
        store->note_taken(stage, name);
        return read(*kept);
    }
    const auto begun = std::chrono::steady_clock::now();
    T found = find();
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
    if (store->keeps(took.count())) store->keep(stage, name, content_of(found));
    return found;
}

}  // namespace diurna
