#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace diurna {

/// What stages of earlier runs have found, each by a key of all that it was made of: a folder that
/// runs of any scene share. A file in it counts only if it says that it is of that key, and its
/// content is, by its digest, what was written; whatever else stands there is passed over. Files
/// that nobody has asked for longest go first where all take more room than they may; what killed
/// runs have left, too. Safe from many threads and processes.
class StageStore {
 public:
    struct Limits {
        double least_seconds = 0.5;  // what took less to find is not kept
        std::uintmax_t most_bytes = 8'000'000'000;
    };
    explicit StageStore(std::filesystem::path folder);
    StageStore(std::filesystem::path folder, Limits limits);

    /// The user's: DIURNA_STAGES, where that is set ("off": none), else "diurna" in XDG_CACHE_HOME
    /// or ~/.cache. Null: none.
    static std::shared_ptr<const StageStore> of_user();

    /// The content kept for a key; none: it is to be recomputed.
    ///
    /// - stage: in a word, "sky"
    std::optional<std::string> find(std::string_view stage, const std::string& key) const;
    /// Whether it is worth keeping what took so many seconds to find.
    bool keeps(double seconds) const { return seconds >= limits_.least_seconds; }
    /// Keeps it. Never throws: what cannot be kept is recomputed.
    void keep(std::string_view stage, const std::string& key, std::string_view content) const;

    /// Of what find() has given: it serves.
    void note_taken(std::string_view stage) const;
    /// The stages so noted, in that order, each once.
    std::vector<std::string> taken() const;
    const std::filesystem::path& folder() const { return folder_; }

 private:
    std::filesystem::path file(std::string_view stage, const std::string& key) const;
    void make_room() const;

    std::filesystem::path folder_;
    Limits limits_;
    mutable std::mutex telling_;
    mutable std::vector<std::string> taken_;
};

/// Which stages were taken from a store, in a line; "" where none, or there is none.
std::string taken_reported(const StageStore* store);

}  // namespace diurna
