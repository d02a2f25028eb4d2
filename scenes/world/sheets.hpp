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
    MaterialId back;  // optics alone, no layers: its heat is the front's
    bool two_sided;   // else heat was said to come from behind
};

/// Makes the materials of sheets as they are asked for, and adds them to the library: "NAME
/// (sheet)" and "NAME (back)", both of NAME's kind. A material without `back` has both sides alike;
/// the two faces of a pane are alike whatever its `back` says, and what it lets through goes on.
/// Where a room was said to be behind, its back is seen as warm as the room and gives the sheet
/// nothing.
class Sheets {
 public:
    explicit Sheets(MaterialLibrary& materials) : materials_(materials) {}

    const SheetMaterials& of(MaterialId material);

    /// Appends a mesh to the facets, its open pieces (open_pieces.hpp) and what lets light through
    /// with a second side (two_sides.hpp) behind all others.
    void append(FacetSet& facets, const ObjectMesh& mesh, ObjectId object);

 private:
    MaterialLibrary& materials_;
    std::map<MaterialId, SheetMaterials> known_;
};

}  // namespace diurna
