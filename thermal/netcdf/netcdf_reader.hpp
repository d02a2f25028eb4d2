#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "materials/base/error.hpp"

namespace diurna {

/// A netCDF file open for reading. What is missing or has another shape is refused as an InputError
/// that names the file and what it should be: "x.nc: is not a state file of a run: it has no mesh".
class NetcdfReader {
 public:
    /// Notes the file as read (materials/base/files_read.hpp).
    ///
    /// - kind: what the file should be: "a state file of a run"
    NetcdfReader(const std::filesystem::path& file, std::string kind);
    /// One in memory.
    ///
    /// - file: names it in messages
    /// - bytes: must outlive it
    NetcdfReader(const std::filesystem::path& file, std::span<const std::byte> bytes,
                 std::string kind);
    ~NetcdfReader();
    NetcdfReader(const NetcdfReader&) = delete;
    NetcdfReader& operator=(const NetcdfReader&) = delete;

    const std::filesystem::path& path() const { return path_; }
    /// An error of this file, to be thrown.
    InputError refused(const std::string& problem) const;
    /// The same for a part that is missing: "its times".
    InputError without(const std::string& what) const;

    struct Dimension {
        std::string name;
        std::size_t length;
    };
    /// Length of a dimension; refused if there is none.
    std::size_t length(const std::string& dimension) const;
    std::vector<std::string> variables() const;
    bool has(const std::string& variable) const;
    std::vector<Dimension> dimensions(const std::string& variable) const;
    /// Number of a variable's values.
    std::size_t size(const std::string& variable) const;
    /// Refuses a variable that is missing or has other dimensions.
    void check_dimensions(const std::string& variable, const std::vector<std::string>& names) const;

    /// Values of a variable in the order of the file, converted to T: float, double, int, long
    /// long. Refused if the file declares more values than it can contain; deflate stores at least
    /// a thousandth.
    template <class T>
    std::vector<T> values(const std::string& variable) const;
    /// A part: from `first` on, `count` of each dimension.
    template <class T>
    std::vector<T> values(const std::string& variable, const std::vector<std::size_t>& first,
                          const std::vector<std::size_t>& count) const;
    std::vector<std::string> strings(const std::string& variable) const;

    /// Attributes of a variable, of the file if `variable` is ""; none if missing or of another
    /// type.
    std::optional<std::string> text(const std::string& variable, const std::string& name) const;
    std::optional<double> number(const std::string& variable, const std::string& name) const;

 private:
    void check(int status, const std::string& what) const;
    int find(const std::string& variable) const;

    std::filesystem::path path_;
    std::string kind_;
    double bytes_ = 0.0;  // of the file
    int id_ = -1;
};

}  // namespace diurna
