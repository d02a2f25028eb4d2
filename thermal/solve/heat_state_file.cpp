#include "thermal/solve/heat_state_file.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

#include "materials/base/error.hpp"
#include "thermal/netcdf/netcdf_reader.hpp"
#include "thermal/netcdf/netcdf_writer.hpp"

namespace diurna {

namespace {

namespace fs = std::filesystem;

constexpr const char* kind = "diurna heat state 2";

/// Numbers of many lists one behind the other, and how many each has.
struct Lists {
    std::vector<long long> length;
    std::vector<double> value;

    void add(const std::vector<double>& list) {
        length.push_back(static_cast<long long>(list.size()));
        value.insert(value.end(), list.begin(), list.end());
    }
};

std::string joined(const std::vector<std::string>& lines) {
    std::string all;
    for (const std::string& line : lines) all += line + "\n";
    return all;
}

std::vector<std::string> lines_of(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t from = 0, to; (to = text.find('\n', from)) != std::string::npos;
         from = to + 1) {
        lines.push_back(text.substr(from, to - from));
    }
    return lines;
}

/// One variable (name) of its own dimension (name_n), written at once.
class Writer {
 public:
    explicit Writer(const NetcdfWriter& file) : file_(file) {}

    void doubles(const char* name, const std::vector<double>& values) {
        const int id = begin(name, NC_DOUBLE, values.size());
        if (!values.empty()) file_.must(nc_put_var_double(file_.id(), id, values.data()));
    }
    void floats(const char* name, const std::vector<float>& values) {
        const int id = begin(name, NC_FLOAT, values.size());
        if (!values.empty()) file_.must(nc_put_var_float(file_.id(), id, values.data()));
    }
    void integers(const char* name, const std::vector<long long>& values) {
        const int id = begin(name, NC_INT64, values.size());
        if (!values.empty()) file_.must(nc_put_var_longlong(file_.id(), id, values.data()));
    }

 private:
    int begin(const char* name, nc_type type, std::size_t length) {
        const int dim = file_.dimension((std::string(name) + "_n").c_str(), length);
        return file_.variable(name, type, {dim});
    }
    const NetcdfWriter& file_;
};

std::string text_of(const NetcdfReader& file, const char* name) {
    std::optional<std::string> text = file.text("", name);
    if (!text) throw file.without(name);
    return std::move(*text);
}

/// A short header may claim any size; these are not compressed.
void check_list(const NetcdfReader& file, const char* name, const fs::path& path) {
    file.check_dimensions(name, {std::string(name) + "_n"});
    if (double(file.size(name)) * 4.0 > double(fs::file_size(path))) {
        throw file.refused("is truncated");
    }
}

/// The lists of a state file; whatever is not there, or not finite, is refused.
class Reader {
 public:
    Reader(const NetcdfReader& file, const fs::path& path) : file_(file), path_(path) {}

    std::vector<double> doubles(const char* name) const {
        check_list(file_, name, path_);
        std::vector<double> values = file_.values<double>(name);
        if (!std::all_of(values.begin(), values.end(), [](double x) { return std::isfinite(x); })) {
            throw file_.refused(std::string("has numbers that are not finite in ") + name);
        }
        return values;
    }
    std::vector<long long> integers(const char* name) const {
        check_list(file_, name, path_);
        return file_.values<long long>(name);
    }
    /// What Lists holds, list by list.
    std::vector<std::vector<double>> lists(const char* lengths, const char* values) const {
        const std::vector<long long> length = integers(lengths);
        const std::vector<double> value = doubles(values);
        std::vector<std::vector<double>> lists;
        std::size_t at = 0;
        for (const long long n : length) {
            if (n < 0 || std::size_t(n) > value.size() - at) throw file_.refused("is truncated");
            const auto from = value.begin() + std::ptrdiff_t(at);
            lists.emplace_back(from, from + std::ptrdiff_t(n));
            at += std::size_t(n);
        }
        if (at != value.size()) throw file_.refused("is truncated");
        return lists;
    }

 private:
    const NetcdfReader& file_;
    const fs::path& path_;
};

/// Throws where a state belongs to somebody else.
void check_owner(const NetcdfReader& file, const StateOwner& owner) {
    if (text_of(file, "mesh") != owner.mesh) {
        throw file.refused("belongs to another mesh: other facets, or other materials of facets");
    }
    const std::vector<std::string> columns = lines_of(text_of(file, "columns"));
    for (std::size_t i = 0; i < owner.columns.size(); ++i) {
        const std::string& ours = owner.columns[i];
        if (i < columns.size() && columns[i] == ours) continue;
        throw file.refused(fmt::format("belongs to other materials: '{}' there is '{}' here",
                                       i < columns.size() ? columns[i] : "", ours));
    }
}

}  // namespace

void save_heat_state(const fs::path& path, const TimedState& timed, const StateOwner& owner) {
    const HeatState& state = timed.state;
    Lists blocks, points, networks;
    for (const std::vector<double>& block : state.block) blocks.add(block);
    for (const std::vector<double>& network : state.network) networks.add(network);
    std::vector<long long> facet;
    std::vector<double> water, frost, albedo;
    for (const HeatState::Point& point : state.point) {
        points.add(point.u);
        facet.push_back(static_cast<long long>(point.facet));
        water.push_back(point.standing.water);
        frost.push_back(point.standing.frost);
        albedo.push_back(point.snow_albedo);
    }
    NetcdfWriter file = NetcdfWriter::create(path);
    file.text(NC_GLOBAL, "title", kind);
    file.text(NC_GLOBAL, "instant", format_instant(timed.instant));
    file.text(NC_GLOBAL, "mesh", owner.mesh);
    file.text(NC_GLOBAL, "columns", joined(owner.columns));
    Writer write(file);
    write.doubles("reference_K", {state.reference});
    write.floats("surface_temperature", state.kelvin);
    write.integers("block_length", blocks.length);
    write.doubles("block_state", blocks.value);
    write.integers("point_facet", facet);
    write.integers("point_length", points.length);
    write.doubles("point_state", points.value);
    write.doubles("point_water_mm", water);
    write.doubles("point_frost_mm", frost);
    write.doubles("point_snow_albedo", albedo);
    write.integers("network_length", networks.length);
    write.doubles("network_state", networks.value);
    file.finish();
}

TimedState load_heat_state(const fs::path& path, const StateOwner& owner) {
    const NetcdfReader file(path, "a state file of a run");
    if (file.text("", "title") != kind) throw file.refused("is not a state file of a run");
    check_owner(file, owner);
    const Reader read(file, path);
    TimedState timed{.instant = parse_instant(text_of(file, "instant"), path.string())};
    HeatState& state = timed.state;
    const std::vector<double> reference = read.doubles("reference_K");
    if (reference.size() != 1) throw file.refused("is truncated");
    state.reference = reference[0];
    const std::vector<double> kelvin = read.doubles("surface_temperature");
    state.kelvin.assign(kelvin.begin(), kelvin.end());
    const auto cannot_be = [](double k) { return !(k >= 1.0 && k <= 5000.0); };
    if (cannot_be(state.reference) || std::any_of(kelvin.begin(), kelvin.end(), cannot_be)) {
        throw file.refused("has temperatures outside 1 to 5000 K");
    }
    state.block = read.lists("block_length", "block_state");
    const std::vector<long long> facet = read.integers("point_facet");
    const std::vector<std::vector<double>> u = read.lists("point_length", "point_state");
    const std::vector<double> water = read.doubles("point_water_mm"),
                              frost = read.doubles("point_frost_mm"),
                              albedo = read.doubles("point_snow_albedo");
    for (const std::size_t n : {u.size(), water.size(), frost.size(), albedo.size()}) {
        if (n != facet.size()) throw file.refused("is truncated");
    }
    for (std::size_t i = 0; i < facet.size(); ++i) {
        if (facet[i] < 0 || std::size_t(facet[i]) >= state.kelvin.size()) {
            throw file.refused("is truncated");
        }
        state.point.push_back({std::size_t(facet[i]), u[i], {water[i], frost[i]}, albedo[i]});
    }
    state.network = read.lists("network_length", "network_state");
    return timed;
}

}  // namespace diurna
