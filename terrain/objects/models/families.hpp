#pragma once

#include "terrain/objects/models/workpiece.hpp"

/// The makers of objects, a file for each family; sizes are generic. All are on z = 0, centred in x
/// and y apart from protruding parts. Parts are those of materials/models.
namespace diurna {

// model_truck.cpp
void make_truck(Workpiece& work);
// model_tractor.cpp
void make_tractor_and_trailer(Workpiece& work);
// model_tracked.cpp
void make_tracked_vehicle(Workpiece& work);
// model_plant.cpp
void make_fuel_tank(Workpiece& work);
void make_generator(Workpiece& work);
void make_mast(Workpiece& work);
// model_buildings.cpp
void make_house(Workpiece& work);
void make_hangar(Workpiece& work);
// model_sheet_steel.cpp
void make_steel_shed(Workpiece& work);
void make_container(Workpiece& work);
// model_aircraft.cpp
void make_aircraft(Workpiece& work);

}  // namespace diurna
