#include "thermal/netcdf/netcdf_reader.hpp"

#include <fmt/format.h>
#include <netcdf.h>
#include <netcdf_mem.h>

#include <utility>

#include "materials/base/files_read.hpp"
#include "materials/base/hdf5_file.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

int get(int file, int variable, const std::size_t* first, const std::size_t* count, float* to) {
    return nc_get_vara_float(file, variable, first, count, to);
}
int get(int file, int variable, const std::size_t* first, const std::size_t* count, double* to) {
    return nc_get_vara_double(file, variable, first, count, to);
}
int get(int file, int variable, const std::size_t* first, const std::size_t* count, int* to) {
    return nc_get_vara_int(file, variable, first, count, to);
}
int get(int file, int variable, const std::size_t* first, const std::size_t* count, long long* to) {
    return nc_get_vara_longlong(file, variable, first, count, to);
}

}  // namespace

NetcdfReader::NetcdfReader(const fs::path& file, std::string kind)
    : path_(file), kind_(std::move(kind)) {
    if (!fs::is_regular_file(file)) throw refused("no such file");
    note_file_read(file);
    check_values_are_its_own(file);
    bytes_ = double(fs::file_size(file));
    check(nc_open(file.c_str(), NC_NOWRITE, &id_), "is not a netCDF file");
}

NetcdfReader::NetcdfReader(const fs::path& file, std::span<const std::byte> bytes, std::string kind)
    : path_(file), kind_(std::move(kind)), bytes_(double(bytes.size())) {
    check_values_are_its_own(bytes, file.string());
    // The library only reads what it takes for writable.
    check(nc_open_mem(file.c_str(), NC_NOWRITE, bytes.size(), const_cast<std::byte*>(bytes.data()),
                      &id_),
          "is not a netCDF file");
}

NetcdfReader::~NetcdfReader() {
    if (id_ >= 0) nc_close(id_);
}

InputError NetcdfReader::refused(const std::string& problem) const {
    return InputError(path_.string(), problem);
}

InputError NetcdfReader::without(const std::string& what) const {
    return refused(fmt::format("is not {}: it has no {}", kind_, what));
}

void NetcdfReader::check(int status, const std::string& what) const {
    if (status != NC_NOERR) throw refused(fmt::format("{} ({})", what, nc_strerror(status)));
}

int NetcdfReader::find(const std::string& variable) const {
    int id = -1;
    if (nc_inq_varid(id_, variable.c_str(), &id) != NC_NOERR) {
        throw without(fmt::format("variable '{}'", variable));
    }
    return id;
}

std::size_t NetcdfReader::length(const std::string& dimension) const {
    int id = -1;
    std::size_t length = 0;
    if (nc_inq_dimid(id_, dimension.c_str(), &id) != NC_NOERR) {
        throw without(fmt::format("dimension '{}'", dimension));
    }
    check(nc_inq_dimlen(id_, id, &length), "cannot be read");
    return length;
}

std::vector<std::string> NetcdfReader::variables() const {
    int count = 0;
    check(nc_inq_nvars(id_, &count), "cannot be read");
    std::vector<std::string> names;
    for (int id = 0; id < count; ++id) {
        char name[NC_MAX_NAME + 1] = {};
        check(nc_inq_varname(id_, id, name), "cannot be read");
        names.emplace_back(name);
    }
    return names;
}

bool NetcdfReader::has(const std::string& variable) const {
    int id = -1;
    return nc_inq_varid(id_, variable.c_str(), &id) == NC_NOERR;
}

std::vector<NetcdfReader::Dimension> NetcdfReader::dimensions(const std::string& variable) const {
    const int found = find(variable);
    int count = 0;
    check(nc_inq_varndims(id_, found, &count), "cannot be read");
    std::vector<int> ids(std::size_t(count), 0);
    check(nc_inq_vardimid(id_, found, ids.data()), "cannot be read");
    std::vector<Dimension> dimensions;
    for (const int id : ids) {
        char name[NC_MAX_NAME + 1] = {};
        std::size_t length = 0;
        check(nc_inq_dim(id_, id, name, &length), "cannot be read");
        dimensions.push_back({name, length});
    }
    return dimensions;
}

std::size_t NetcdfReader::size(const std::string& variable) const {
    std::size_t size = 1;
    for (const Dimension& dimension : dimensions(variable)) size *= dimension.length;
    return size;
}

void NetcdfReader::check_dimensions(const std::string& variable,
                                    const std::vector<std::string>& names) const {
    const std::vector<Dimension> found = dimensions(variable);
    bool same = found.size() == names.size();
    for (std::size_t k = 0; same && k < names.size(); ++k) same = found[k].name == names[k];
    if (same) return;
    throw refused(
        fmt::format("{} does not have the dimensions ({})", variable, fmt::join(names, ", ")));
}

template <class T>
std::vector<T> NetcdfReader::values(const std::string& variable) const {
    std::vector<std::size_t> count;
    for (const Dimension& dimension : dimensions(variable)) count.push_back(dimension.length);
    return values<T>(variable, std::vector<std::size_t>(count.size(), 0), count);
}

template <class T>
std::vector<T> NetcdfReader::values(const std::string& variable,
                                    const std::vector<std::size_t>& first,
                                    const std::vector<std::size_t>& count) const {
    double size = 1.0;
    for (const std::size_t n : count) size *= double(n);
    if (size * sizeof(T) > 2e3 * bytes_) {
        throw refused(fmt::format("declares more values of {} than a file of this size can contain",
                                  variable));
    }
    std::vector<T> values(std::size_t(size), T{});
    if (values.empty()) return values;
    check(get(id_, find(variable), first.data(), count.data(), values.data()),
          variable + " cannot be read");
    return values;
}

std::vector<std::string> NetcdfReader::strings(const std::string& variable) const {
    std::vector<char*> text(size(variable), nullptr);
    std::vector<std::string> all;
    if (text.empty()) return all;
    check(nc_get_var_string(id_, find(variable), text.data()), variable + " cannot be read");
    for (const char* one : text) all.emplace_back(one == nullptr ? "" : one);
    nc_free_string(text.size(), text.data());
    return all;
}

std::optional<std::string> NetcdfReader::text(const std::string& variable,
                                              const std::string& name) const {
    const int of = variable.empty() ? NC_GLOBAL : find(variable);
    std::size_t length = 0;
    nc_type type = NC_NAT;
    if (nc_inq_att(id_, of, name.c_str(), &type, &length) != NC_NOERR || type != NC_CHAR ||
        double(length) > 2e3 * bytes_) {
        return std::nullopt;
    }
    std::string text(length, '\0');
    check(nc_get_att_text(id_, of, name.c_str(), text.data()), name + " cannot be read");
    return text;
}

std::optional<double> NetcdfReader::number(const std::string& variable,
                                           const std::string& name) const {
    const int of = variable.empty() ? NC_GLOBAL : find(variable);
    std::size_t length = 0;
    double value = 0.0;
    const bool single = nc_inq_attlen(id_, of, name.c_str(), &length) == NC_NOERR && length == 1;
    if (!single || nc_get_att_double(id_, of, name.c_str(), &value) != NC_NOERR) {
        return std::nullopt;
    }
    return value;
}

template std::vector<float> NetcdfReader::values(const std::string&) const;
template std::vector<double> NetcdfReader::values(const std::string&) const;
template std::vector<int> NetcdfReader::values(const std::string&) const;
template std::vector<long long> NetcdfReader::values(const std::string&) const;
template std::vector<double> NetcdfReader::values(const std::string&,
                                                  const std::vector<std::size_t>&,
                                                  const std::vector<std::size_t>&) const;

}  // namespace diurna
