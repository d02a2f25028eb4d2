#include "scenes/products/export/vtu_file.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/made_by.hpp"
#include "scenes/charts/html.hpp"

namespace diurna {

namespace {

static_assert(std::endian::native == std::endian::little, "arrays are written as in memory");

/// The array with its length in bytes before it, as VTK's header_type UInt64 wants it.
template <class T>
std::string encoded(std::span<const T> values) {
    const std::uint64_t size = values.size_bytes();
    std::vector<std::byte> bytes(sizeof size + values.size_bytes());
    std::memcpy(bytes.data(), &size, sizeof size);
    if (size > 0) std::memcpy(bytes.data() + sizeof size, values.data(), size);
    return base64(bytes);
}

template <class T>
std::string array(const char* type, const std::string& name, const std::vector<T>& values,
                  const std::string& more = "") {
    return fmt::format("<DataArray type=\"{}\" Name=\"{}\"{} format=\"binary\">{}</DataArray>\n",
                       type, name, more, encoded(std::span<const T>(values)));
}

std::string vtu_number(const char* name, double value) {
    return array("Float64", name, std::vector<double>{value}, " NumberOfTuples=\"1\"");
}

/// Words of a comment, in which XML allows no "--".
std::string listed(const std::vector<std::string>& names) {
    std::string text;
    for (std::size_t i = 0; i < names.size(); ++i) {
        text += fmt::format("{}{} {}", i == 0 ? "" : ", ", i, names[i]);
    }
    for (std::size_t i = 1; i < text.size(); ++i) {
        if (text[i - 1] == '-' && text[i] == '-') text[i] = '_';
    }
    return text;
}

template <class Id>
std::vector<std::int32_t> numbers(const std::vector<Id>& ids) {
    std::vector<std::int32_t> all;
    for (const Id id : ids) all.push_back(static_cast<std::int32_t>(id));
    return all;
}

constexpr const char* xml_head = "<?xml version=\"1.0\"?>\n";

}  // namespace

std::string vtu_text(const RunHeat& heat, const HeatAt& at) {
    const FacetSet& facets = heat.mesh.facets;
    const Site& site = heat.mesh.site;
    std::vector<float> points;
    for (const Eigen::Vector3f& v : facets.vertex)
        points.insert(points.end(), v.data(), v.data() + 3);
    std::vector<std::int32_t> corners, ends;
    for (const auto& triangle : facets.corner) {
        for (const std::uint32_t v : triangle) corners.push_back(static_cast<std::int32_t>(v));
        ends.push_back(static_cast<std::int32_t>(corners.size()));
    }
    constexpr std::uint8_t vtk_triangle = 5;
    std::string text = xml_head;
    text += fmt::format(
        "<!-- {}, with {}\n     {}; x, y, z are east, north, up [m] from {:.9f}, {:.9f} (WGS84), "
        "{:.3f} m; heights as in the scene\n     materials: {}\n     objects: {} -->\n",
        made_by(), made_with(), format_instant(at.when), site.latitude_deg, site.longitude_deg,
        site.height, listed(heat.mesh.materials), listed(heat.mesh.objects));
    text +=
        "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n";
    text += vtu_number("TimeValue", seconds_between(Instant{}, at.when));
    text += vtu_number("site_latitude_deg", site.latitude_deg);
    text += vtu_number("site_longitude_deg", site.longitude_deg);
    text += vtu_number("site_height_m", site.height);
    text +=
        fmt::format("</FieldData>\n<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n<Points>\n",
                    facets.vertex.size(), facets.size());
    text += array("Float32", "Points", points, " NumberOfComponents=\"3\"");
    text += "</Points>\n<Cells>\n";
    text += array("Int32", "connectivity", corners);
    text += array("Int32", "offsets", ends);
    text += array("UInt8", "types", std::vector<std::uint8_t>(facets.size(), vtk_triangle));
    text += "</Cells>\n<CellData Scalars=\"temperature_K\">\n";
    text += array("Float32", "temperature_K", at.kelvin);
    text += array("Int32", "material", numbers(facets.material));
    text += array("Int32", "object", numbers(facets.object));
    if (const auto& as = heat.field.solved_as; !as.empty()) {
        text += array("Int32", "solved_as", std::vector<std::int32_t>(as.begin(), as.end()));
    }
    text += "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
    return text;
}

std::string pvd_text(std::span<const Instant> instants, std::span<const std::string> names) {
    std::string text = xml_head;
    text +=
        "<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n<Collection>\n";
    for (std::size_t i = 0; i < names.size(); ++i) {
        text += fmt::format("<DataSet timestep=\"{:.3f}\" part=\"0\" file=\"{}\"/>\n",
                            seconds_between(instants.front(), instants[i]), escaped(names[i]));
    }
    return text + "</Collection>\n</VTKFile>\n";
}

std::size_t write_vtu_day(const std::filesystem::path& pvd, const RunHeat& heat,
                          std::span<const Instant> instants, const std::vector<FileRead>& inputs) {
    if (pvd.extension() != ".pvd") {
        throw InputError(pvd.string(), "expected FILE.pvd; the .vtu files are written beside it");
    }
    std::vector<std::string> names;
    check_output_file(pvd, inputs);
    for (const Instant when : instants) {
        names.push_back(fmt::format("{}_{}.vtu", pvd.stem().string(), format_instant(when, true)));
        check_output_file(pvd.parent_path() / names.back(), inputs);
    }
    for (std::size_t i = 0; i < instants.size(); ++i) {
        write_whole_file(pvd.parent_path() / names[i], vtu_text(heat, heat_at(heat, instants[i])));
    }
    write_whole_file(pvd, pvd_text(instants, names));
    return names.size() + 1;
}

}  // namespace diurna
