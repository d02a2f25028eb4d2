#pragma once

#include <map>

#include "materials/matter/library.hpp"
#include "terrain/facets.hpp"
#include "terrain/objects/object_mesh.hpp"

/// Open meshes: sheets, whose two sides both face the scene.
namespace diurna {

/// The two sides of a sheet of some material.
struct SheetMaterials {
    MaterialId front;
    MaterialId back;  // only optics, no layers: its heat is the front's
    bool two_sided;   // else a room behind it was given
};

/// Creates the materials of sheets when needed, and adds them to the library: "NAME
/// (sheet)" and "NAME (back)", both of NAME's kind. A material without `back` has two equal
/// sides; the two faces of a pane are always equal, and transmitted light continues. If a
/// room was given behind it, its back has the room's temperature and gives the sheet no
/// heat.
class Sheets {
 public:
    explicit Sheets(MaterialLibrary& materials) : materials_(materials) {}

    const SheetMaterials& of(MaterialId material);

    /// Appends a mesh to the facets; its open pieces (open_pieces.hpp) and transparent facets get a
    /// second side (two_sides.hpp), appended after all others.
    void append(FacetSet& facets, const ObjectMesh& mesh, ObjectId object);

 private:
    MaterialLibrary& materials_;
    std::map<MaterialId, SheetMaterials> known_;
};

}  // namespace diurna
