#pragma once

#include <filesystem>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "scenes/job/store/messages.hpp"

namespace diurna {

/// List of a folder's complete files with their digests: "ledger.jsonl". A line is added as soon as
/// files that belong together are in place, so that after an interrupted run only files with
/// unchanged bytes are reused, and none of an older run, of another hour, truncated or edited. Its
/// first line has the key of their inputs.
class Ledger {
 public:
    /// Reads the entries of a ledger of the same key in the folder whose files still have their
    /// digest. Writes nothing.
    ///
    /// - keep: false: ignores earlier entries
    Ledger(std::filesystem::path folder, const std::string& key, bool keep);

    /// Whether all of these exist unchanged. True for an empty list.
    bool has(const std::vector<std::string>& files) const;
    /// Adds files that belong together and are complete in the folder. Thread-safe.
    void add(const std::vector<std::string>& files, Messages reported);
    /// Adds the entries of another ledger whose files are also in this folder; for files in both,
    /// messages of both are combined.
    void take(const Ledger& other);
    /// Messages of the files that were added with this one.
    Messages reported(const std::string& file) const;
    /// Digests of all files, by their names relative to the folder.
    std::map<std::string, std::string> digests() const;
    /// Files in an earlier ledger of the same key that were changed or removed.
    const std::vector<std::string>& changed() const { return changed_; }
    /// Writes it, in the order of the names: before the first file is added, and at the end, so
    /// that the bytes do not depend on the order of completion.
    ///
    /// - expected: files to come, so that one left by a killed run is recognised
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

/// Names in a folder's ledger, with expected ones, for any key; empty without a ledger.
std::vector<std::string> ledger_names(const std::filesystem::path& folder);
/// The key in its first line; "" without a ledger.
std::string ledger_key(const std::filesystem::path& folder);
/// SHA-256 of the files in a folder's ledger, by name, for any key, even if the files have changed;
/// empty without a ledger.
std::map<std::string, std::string> ledger_digests(const std::filesystem::path& folder);

}  // namespace diurna
