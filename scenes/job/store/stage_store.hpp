#pragma once

#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace diurna {

/// Bytes to be stored, in pieces that refer to a result, which is to outlive them: a result of
/// gigabytes is not held twice.
struct StageContent {
    std::vector<std::string_view> piece;
    std::deque<std::string> small;  // pieces that no result holds

    StageContent() = default;
    StageContent(std::string_view whole) : piece{whole} {}
    StageContent(StageContent&&) = default;  // a copy would refer to another's `small`
    std::uintmax_t size() const;
};

/// Cache of stages' results, each with a key from all its inputs: a folder shared by runs of
/// any scene. A file counts only if it contains its key and the digest of its content is
/// correct; other files are ignored. If the folder exceeds its size limit, the least recently
/// used files are removed first, and also files left by killed runs. Safe with many threads and
/// processes.
class StageStore {
 public:
    struct Limits {
        double least_seconds = 0.5;  // faster results are not stored
        std::uintmax_t most_bytes = 8'000'000'000;
    };
    explicit StageStore(std::filesystem::path folder);
    /// For one process: scenes of a study share stages by content, and nothing is written.
    static std::shared_ptr<const StageStore> in_memory();
    StageStore(std::filesystem::path folder, Limits limits);

    /// The user's cache: DIURNA_STAGES, if set ("off": none), else "diurna" in XDG_CACHE_HOME or
    /// ~/.cache. Null: none.
    static std::shared_ptr<const StageStore> of_user();

    /// The content stored for a key; nothing: it must be computed.
    ///
    /// - stage: in a word, "sky"
    std::optional<std::string> find(std::string_view stage, const std::string& key) const;
    /// Whether a result that took this long should be stored.
    bool keeps(double seconds) const { return seconds >= limits_.least_seconds; }
    /// Stores it. Never throws: a result that cannot be stored is recomputed next time.
    void keep(std::string_view stage, const std::string& key, const StageContent& content) const;

    /// Records that a result of find() was used, unless it was stored by this run itself.
    void note_taken(std::string_view stage, const std::string& key) const;
    /// The stages recorded, in that order, each once.
    std::vector<std::string> taken() const;
    const std::filesystem::path& folder() const { return folder_; }

 private:
    std::filesystem::path file(std::string_view stage, const std::string& key) const;
    void make_room() const;

    std::filesystem::path folder_;  // empty: in memory
    Limits limits_;
    mutable std::map<std::string, std::string> held_;  // in memory, by stage and key
    mutable std::mutex telling_;
    mutable std::vector<std::string> taken_, own_;  // stages; names of files stored by this run
};

/// Stages taken from the cache, in one line; "" if none, or without a cache.
std::string taken_reported(const StageStore* store);

}  // namespace diurna
