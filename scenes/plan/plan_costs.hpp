#pragma once

namespace diurna {

/// What the work of a job costs, for the estimate of a plan only: seconds of the processor for each
/// thing that is counted before anything is computed (scenes/plan/plan.cpp), and bytes. `bench/
/// plan_costs.py` measures each on a small scene in which it is most of a stage, and writes this
/// file again; the numbers are those of the machine class that bench/results names.
struct PlanCosts {
    // [s] The world, which is there before the plan is: of the program, and of a facet.
    double start = 0.30;
    double world_per_facet = 5e-6;
    double light_per_hour = 0.045;  // of daylight: how the air spreads its light (air_spread.hpp)
    // [s] What surfaces see.
    double sky_per_facet = 40e-6;        // of the ground, of buildings
    double sky_per_ray = 1.6e-6;         // of an object that is one body of heat
    double shadow_per_ground = 0.25e-6;  // and sunlit step
    double shadow_per_object = 0.5e-6;   // more of them have edges to be found
    // [s] The heat balance.
    double heat_per_step = 0.55e-6;         // of a facet, all passes and the exchange
    double heat_per_coupled_step = 1.8e-6;  // of one that sees objects or other ground
    double lane = 0.86e-3;                  // a day of a facet with dew or rain, eight side by side
    double freezing_lane = 2.9e-3;   // likewise of one whose water freezes; even slopes half of it
    double point = 5e-3;             // of one by itself (thermal/solve/point_facets.hpp)
    double lane_by_steps = 1.7e-3;   // more of these for each step of a day
    double lane_day_more = 0.15;     // a day after the first, over the first, which is repeated
    double network_day = 1.05e-3;    // of a facet of a body of heat (thermal/solve/network_facets)
    double network_step = 2.2e-6;    // and step of it
    double network_day_more = 0.73;  // a day after the first, over the first, which is repeated
    double flux_passes = 1.3;        // where the terms of the heat balance are written
    double write_per_value = 0.08e-6;
    // [s] Pictures.
    double cast_per_ray = 0.046e-6;     // and what it meets
    double render_per_pixel = 0.83e-6;  // and band
    double air_per_band = 0.024;        // and frame: tables of paths and backgrounds
    double light_per_facet = 0.1e-6;    // and frame: its sun and temperature
    double secondary_per_ray =
        15e-6;                     // that goes on off water or a mirror, through a pane or a net
    double samples_by_need = 3.0;  // of such a pixel, over those asked for (follow_rays.hpp)
    double secondary_per_root =
        3.2e-3;  // and band, frame: root of the pixels that send rays on; what
                 // they meet and its air are shared, the more the more there are
    double air_per_channel = 0.027;  // of a cube, and frame
    double render_per_channel = 0.12e-6;
    double blur_per_sample = 0.7e-6;  // of an instrument's radiance and frame
    double detect_per_pixel = 1.0e-6;
    double annotate_per_pixel = 0.33e-6;
    double seen_through = 2.5;  // of casting and rendering, where rays pass smoke
    // [bytes]
    double program = 75e6;             // and its libraries
    double facet = 600.0;              // what it has once
    double network_facet = 1800.0;     // of a body of heat, and its rays to others
    double network_facet_step = 24.0;  // and step, of no more than a day
    double freezing_facet = 8000.0;    // whose water freezes, side by side with others
    double view_pixel = 160.0;
    double plane_value = 8.0;     // of a plane, and of the file that is made of it
    double channel_value = 32.0;  // of a value of a cube: seen, put in two files
};

inline constexpr PlanCosts plan_costs{};

}  // namespace diurna
