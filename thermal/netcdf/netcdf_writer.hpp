#pragma once

#include <fmt/format.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "materials/base/files.hpp"
#include "materials/base/hdf5_file.hpp"
#include "materials/base/unfinished.hpp"

namespace diurna {

/// An open netCDF file; a file being written gets its name when it is complete.
class NetcdfWriter {
 public:
    NetcdfWriter(std::filesystem::path path, int id) : path_(std::move(path)), id_(id) {}
    NetcdfWriter(const NetcdfWriter&) = delete;
    NetcdfWriter& operator=(const NetcdfWriter&) = delete;
    ~NetcdfWriter() {
        if (id_ >= 0) nc_close(id_);
    }
    /// Created in memory, as the library ends the program when a disk is full; begun with
    /// an empty file, as nc_create_mem tracks no order and cannot open it again for
    /// changes.
    static NetcdfWriter create(const std::filesystem::path& target) {
        check_output_file(target);
        remove_left_over(target);
        const std::vector<std::byte> nothing = hdf5_with_nothing_in_it();
        NC_memio memory{nothing.size(), std::malloc(nothing.size()), 0};
        if (memory.memory == nullptr) throw std::bad_alloc();
        std::memcpy(memory.memory, nothing.data(), nothing.size());
        int id = -1;
        const int status = nc_open_memio(target.c_str(), NC_WRITE | NC_NETCDF4, &memory, &id);
        NetcdfWriter file(target, status == NC_NOERR ? id : -1);
        file.must(status);
        file.must(nc_redef(id));
        return file;
    }
    NetcdfWriter(NetcdfWriter&& other) noexcept
        : path_(std::move(other.path_)), id_(std::exchange(other.id_, -1)) {}

    /// Removes unfinished copies of the file by killed runs (processes that have
    /// ended).
    static void remove_left_over(const std::filesystem::path& target) {
        const std::string begin = fmt::format(".{}.", target.filename().string());
        const auto folder = target.has_parent_path() ? target.parent_path() : ".";
        std::error_code ignored;
        for (const auto& entry : std::filesystem::directory_iterator(folder, ignored)) {
            const bool own = entry.path().filename().string().starts_with(begin);
            if (own && is_left_over(entry.path())) std::filesystem::remove(entry.path(), ignored);
        }
    }

    void must(int status) const {
        if (status != NC_NOERR) {
            throw std::runtime_error(
                fmt::format("{}: cannot be written: {}", path_.string(), nc_strerror(status)));
        }
    }
    int id() const { return id_; }
    int dimension(const char* name, std::size_t length) const {
        int dim;
        must(nc_def_dim(id_, name, length, &dim));
        return dim;
    }
    int variable(const char* name, nc_type type, const std::vector<int>& dims) const {
        int variable;
        must(nc_def_var(id_, name, type, int(dims.size()), dims.data(), &variable));
        if (dims.size() == 2) must(nc_def_var_deflate(id_, variable, 1, 1, 1));
        return variable;
    }
    void text(int variable, const char* name, const std::string& value) const {
        must(nc_put_att_text(id_, variable, name, value.size(), value.c_str()));
    }
    void finish() {
        NC_memio made{};
        must(nc_close_memio(std::exchange(id_, -1), &made));
        const std::unique_ptr<void, decltype(&std::free)> memory(made.memory, &std::free);
        write_whole_file(path_, std::span(static_cast<const std::byte*>(made.memory), made.size));
    }

 private:
    std::filesystem::path path_;
    int id_;
};

}  // namespace diurna
