#pragma once

namespace diurna {

/// Costs for the time estimate of a plan: seconds of the processor for each item counted before
/// anything is computed (scenes/job/plan/plan.cpp), and bytes. `bench/plan_costs.py` measures each
/// on a small scene in which it dominates a stage, and rewrites this file; the numbers are for the
/// machine class named in bench/results. Those of solved days, stages of motion, rays near objects
/// and the surface check were fitted by hand to the runs of 45 scenes; those of smoke, textures and
/// uncertain values to ten.
struct PlanCosts {
    // [s] The world, built before the plan: of the program, and of a facet.
    double start = 0.23;
    double world_per_facet = 5e-6;
    double light_per_hour = 0.012;  // of daylight: distribution of sky light (air_spread.hpp)
    // [s] View factors, once for each stage of moving objects.
    double sky_per_facet = 10e-6;        // of the ground
    double ground_ray = 0.028e-6;        // of ground near objects, and
    double ground_hit = 0.25e-6;         // more of one that meets something
    double wall_ray = 0.5e-6;            // of buildings, and of objects without a network
    double sky_per_ray = 1.3e-6;         // of an object with a thermal network
    double shadow_per_ground = 0.25e-6;  // and sunlit step
    double shadow_per_object = 0.5e-6;   // more of them have edges
    // The heat balance: facets that are solved for each that pictures show, if not all are,
    double solved_per_seen = 1.3;
    double solved_per_close = 0.6;  // and of ground that objects stand close to
    // [s] and all passes and the exchange
    double heat_per_day = 45e-6;             // of a facet, and
    double heat_per_step = 0.4e-6;           // each step
    double heat_per_coupled_step = 0.95e-6;  // of one that sees objects or other ground
    double heat_day_more = 0.4;              // a further day, relative to the first, repeated one
    double heat_per_stage = 8e-6;            // of a facet: a further stage of moving objects
    double lane = 0.86e-3;                   // a day of a facet with dew or rain, in lanes of eight
    double freezing_lane = 2.9e-3;           // the same with freezing; half of it on uniform slopes
    double point = 5e-3;             // of one solved individually (thermal/solve/point_facets.hpp)
    double lane_by_steps = 1.7e-3;   // number of these per step of a day
    double lane_day_more = 0.35;     // a further day, relative to the first, repeated one
    double network_day = 0.8e-3;     // of a facet of a network (thermal/solve/network_facets)
    double network_step = 1.7e-6;    // and step of it
    double network_lead_in = 0.4;    // a repeated day before the span, relative to one of it
    double network_day_more = 0.73;  // a further day, relative to the first, repeated one
    double flux_passes = 1.3;        // if the terms of the heat balance are written
    double write_per_value = 0.08e-6;
    // [s] The surface check: places solved separately, each as two patches.
    double patch_ray = 0.073e-6;     // of their sky and surroundings, at each stage
    double patch_sun_ray = 0.03e-6;  // to the sun's disc
    double patch_day = 0.33e-3;      // of its heat balance, and
    double patch_step = 1e-6;        // each step
    // [s] Pictures.
    double cast_per_ray = 0.046e-6;       // including its hit
    double render_per_pixel = 0.83e-6;    // and band
    double render_per_surface = 0.55e-6;  // of a pixel with planes of its own, and band
    double air_per_band = 0.024;          // and frame: tables of paths and backgrounds
    double light_per_facet = 0.1e-6;      // and frame: its sun and temperature
    double secondary_per_ray = 1.3e-6;    // off water or a mirror, through a pane or a net
    double secondary_per_hit = 0.7e-6;    // of those, and band and frame
    double lobes_per_root = 2.2e-3;  // and band, frame: root of the pixels of rough mirrors and
                                     // water; what their lobes meet is shared, the more the more
                                     // there are
    double air_per_channel = 0.027;  // of a cube, and frame
    double render_per_channel = 0.12e-6;
    double blur_per_sample = 0.7e-6;  // of an instrument's radiance and frame
    double detect_per_pixel = 1.0e-6;
    double annotate_per_pixel = 0.33e-6;
    double smoke_ray = 4.8e-6;      // of a view, more through smoke
    double smoke_pixel = 3.3e-6;    // with smoke, and band and frame
    double textured_ray = 0.55e-6;  // of a view, more of textured facets
    // [bytes]
    double program = 75e6;          // and its libraries
    double other_scene = 3e6;       // a scene with an uncertain value changed, and
    double other_facet = 1200.0;    // each of its facets
    double other_pixel = 60.0;      // and of its view
    double facet = 500.0;           // geometry, rays, views
    double solved_facet = 450.0;    // more of those that are solved: their columns,
    double solved_step = 7.0;       // each step of a day: temperature, longwave, its exchange,
    double sunlit_step = 6.0;       // and more of steps with the sun up
    double pictured_facet = 700.0;  // light and radiosity, in pictures
    double network_facet = 8000.0;  // of a network: rows, factors, stages; and
    double row_entry = 8.0;         // of a facet's row of view factors, and
    double sampled_entry = 32.0;    // while these are made reciprocal
    double stage_facet = 390.0;     // of a further stage of moving objects: geometry, rays, sun
    double stage_network_facet = 1000.0;  // more of those of a network
    double part_facet = 190.0;            // of a copy with the check's patches, at each stage
    double network_facet_step = 24.0;     // and step, of no more than a day
    double wet_facet = 4000.0;            // of one with dew, rain or snow, and
    double freezing_facet = 4000.0;       // more of one whose water freezes, in lanes
    double surface_value = 180.0;  // of a surface of a pixel with planes of its own, and band
    double view_pixel = 160.0;
    double most_views = 134e6;         // kept from casting to rendering (scenes/job/run/stages)
    double smoke_sample = 60.0;        // of a pixel with smoke
    double secondary_bytes = 110.0;    // of a hit of rays that go on
    double instrument_sample = 100.0;  // of radiance
    double plane_value = 8.0;          // of a plane, and of the file written from it
    double channel_value = 32.0;       // of a value of a cube: rendered, written to two files
};

inline constexpr PlanCosts plan_costs{};

}  // namespace diurna
