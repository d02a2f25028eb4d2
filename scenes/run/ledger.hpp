#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "scenes/cache/messages.hpp"

namespace diurna {

/// Which files of a folder are whole, and what they are: "ledger.jsonl". A line is added as soon as
/// files that belong together are in place, so that of a run that was ended anywhere those are kept
/// whose bytes are what they were, and no other: not one of an older run, of another hour, cut
/// short or edited. Its first line has the key of what they were made of.
class Ledger {
 public:
    /// Takes from the folder's ledger what one of the same key says of files whose content has that
    /// digest. Writes nothing.
    ///
    /// - keep: false: nothing of an earlier one counts
    Ledger(std::filesystem::path folder, const std::string& key, bool keep);

    /// Whether all of these are there as they were made. Of none: true.
    bool has(const std::vector<std::string>& files) const;
    /// Files that belong together and stand whole in the folder. Safe from many threads.
    void add(const std::vector<std::string>& files, Messages reported);
    /// Enters what another has whose files stand in this folder, too; of those that both have what
    /// was reported of either.
    void take(const Ledger& other);
    /// Of the files that were added with this one.
    Messages reported(const std::string& file) const;
    /// Of all files, by their names relative to the folder.
    std::map<std::string, std::string> digests() const;
    /// Files that an earlier one of the same key has and that are not what it says, or gone.
    const std::vector<std::string>& changed() const { return changed_; }
    /// Writes it whole, in the order of the names: before the first file is added, and at the end
    /// for the same bytes, whichever was made first.
    ///
    /// - expected: files to come, so that one left by a killed run is known for one of its own
    void write(const std::vector<std::string>& expected = {}) const;

 private:
    struct Entry {
        std::map<std::string, std::string> digest;  // SHA-256 by name
        Messages reported;
    };
    std::string line(const Entry& entry) const;

    std::filesystem::path folder_;
    std::string key_;
    std::vector<std::string> changed_;
    mutable std::mutex adding_;
    std::map<std::string, Entry> entry_;           // by the first of its names
    std::map<std::string, std::string> entry_of_;  // name -> the first of its entry
};

inline constexpr const char* ledger_file = "ledger.jsonl";

/// Names of a folder's ledger, those expected too, whatever its key; none where there is none.
std::vector<std::string> ledger_names(const std::filesystem::path& folder);
/// The key in its first line; "" where there is none.
std::string ledger_key(const std::filesystem::path& folder);
/// SHA-256 of the files in a folder's ledger, by name, whatever its key and whatever became of
/// them; empty where there is none.
std::map<std::string, std::string> ledger_digests(const std::filesystem::path& folder);

}  // namespace diurna
