#include "thermal/solve/network_surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <variant>

#include "materials/base/parallel.hpp"
#include "thermal/kernels/mode_kernel.hpp"
#include "thermal/kernels/surface_kernel.hpp"
#include "thermal/solve/heat_record.hpp"
#include "thermal/surface/surface_flux.hpp"

namespace diurna {

namespace {

const ModeKernel& kernel() { return wide_vectors() ? modes_avx512 : modes_avx2; }

/// The air at an instant as high as a target's facets lie in the mean.
AirState air_at(const SolveState& solve, const NetworkObject& object, const Forcing& now) {
    if (solve.tiers.flat()) return now.air;
    double height = 0.0;
    for (const std::uint32_t f : object.facet) height += double(solve.input.height[f]);
    return air_at_height(*solve.input.by_height, now.air, height / double(object.size()));
}

}  // namespace

NetworkSurroundings::NetworkSurroundings(const SolveState& solve, const Level& level,
                                         const NetworkObject& object, std::size_t stride)
    : solve_(solve),
      level_(level),
      object_(object),
      stride_(stride),
      own_(solve, object),
      blown_(object) {
    sort_faces();
    set_airs();
    find_panes();
    find_blown();
    if (stride == 1) find_jumps();
    for (int end = 0; end < 2; ++end) {
        before_[end].assign(object.size(), 0.0);
        after_[end].assign(object.size(), 0.0);
    }
}

void NetworkSurroundings::add(std::size_t face, std::size_t kind, bool inner,
                              std::vector<Group>& groups) {
    const ThermalSurface& surface = level_.kind[kind].column.surface;
    Group like{.kind = kind,
               .inner = inner,
               .wet = surface.evaporation.wetness > 0.0,
               .emissivity = surface.emissivity,
               .absorptance = 0.0,
               .internal = inner ? 0.0 : surface.internal_heat};
    std::uint32_t facet = object_.facet[face];
    if (inner) {
        like.in_air = object_.inner[face] == NetworkObject::Inner::air;
        if (like.in_air) {
            like.emissivity = surface.back->emissivity;
            like.wet = false;
        } else {
            facet = object_.back[face];
            const ThermalSurface& back =
                solve_.input.materials[solve_.input.facets.material[facet]].thermal;
            like.emissivity = back.emissivity;
            like.absorptance = std::max(0.0, 1.0 - back.albedo - back.solar_transmittance);
            like.wet = back.evaporation.wetness > 0.0;
        }
    }
    auto group = std::find_if(groups.begin(), groups.end(), [&](const Group& g) {
        return g.kind == kind && g.inner == inner && g.in_air == like.in_air;
    });
    if (group == groups.end()) group = groups.insert(groups.end(), std::move(like));
    const std::uint32_t front = object_.facet[face];
    const NaturalFilm own = facet_film(surface.convection, solve_.input.facets.normal[front].z(),
                                       solve_.part_of(front));
    group->face.push_back(std::uint32_t(face));
    group->facet.push_back(facet);
    group->natural.push_back(inner ? turned_over(own) : own);
}

void NetworkSurroundings::sort_faces() {
    std::vector<std::size_t> kind_of(solve_.facets, no_step);
    for (const Block& block : solve_.block) {
        for (const std::size_t f : block.facet) kind_of[f] = block.material;
    }
    for (std::size_t n = 0; n < object_.size(); ++n) {
        add(n, kind_of[object_.facet[n]], false, group_);
        if (object_.inner[n] != NetworkObject::Inner::nothing) {
            add(n, kind_of[object_.facet[n]], true, group_);
        }
    }
    for (Group& group : group_) {
        group.natural.resize((group.face.size() + lanes - 1) / lanes * lanes,
                             group.natural.front());
    }
}

void NetworkSurroundings::set_airs() {
    for (const Instant when : solve_.instant) {
        const Forcing now = solve_.series.weather().at(when);
        const AirState air = air_at(solve_, object_, now);
        outdoors_.push_back(air.temperature);
        for (Group& group : group_) {
            const MaterialColumn& column = level_.kind[group.kind].column;
            AirFilm film = air_film(column.surface, column.louis, air, now.wind_speed);
            const bool louis = std::holds_alternative<Louis>(column.surface.convection);
            if (louis && !solve_.input.part.empty()) {
                film.kind = FilmKind::sheltered_ground;  // facet_film reports the share of the wind
            }
            if (group.inner && !group.wet) film.wetness = 0.0;
            group.air.push_back(film);
        }
    }
    // The last instant is as the first.
    const std::size_t count = solve_.steps();
    double sum = 0.0;
    for (std::size_t i = 0; i < count; ++i) sum += outdoors_[i] / double(count);
    outdoors_.push_back(sum);
    for (Group& group : group_) {
        AirFilm mean = group.air.front();
        for (std::size_t i = 1; i < count; ++i) {
            mean = air_between(mean, group.air[i], 1.0 / double(i + 1));
        }
        group.air.push_back(mean);
    }
}

void NetworkSurroundings::find_panes() {
    for (const NetworkObject::Sunlit& sunlit : object_.sunlit) {
        std::vector<double>& watts = panes_.emplace_back();
        double mean = 0.0;
        for (std::size_t i = 0; i < solve_.instant.size(); ++i) {
            double sum = 0.0;
            for (std::size_t k = 0; k < sunlit.pane.size(); ++k) {
                const std::uint32_t n = sunlit.pane[k];
                sum += sunlit.transmittance[k] * object_.network.facet[n].area *
                       double(solve_.sunlight.at(i, object_.facet[n]));
            }
            watts.push_back(sum);
            if (i < solve_.steps()) mean += sum / double(solve_.steps());
        }
        watts.push_back(mean);
    }
}

void NetworkSurroundings::find_blown() {
    if (blown_.none()) return;
    for (std::uint32_t g = 0; g < group_.size(); ++g) {
        for (std::size_t l = 0; l < group_[g].face.size(); ++l) {
            const std::uint32_t at = blown_.of(group_[g].face[l], group_[g].inner);
            if (at == no_number) continue;
            blown_.faces()[at].group = g;
            blown_.faces()[at].own = group_[g].natural[l];
        }
    }
}

/// With a jump of light by J at a share x of a step, its mean is J (½ − x) above that of its ends.
void NetworkSurroundings::find_jumps() {
    std::vector<std::uint32_t> face_of(solve_.facets, no_number);
    for (std::uint32_t n = 0; n < object_.size(); ++n) face_of[object_.facet[n]] = n;
    for (const Block& block : solve_.block) {
        const Kind& kind = level_.kind[block.material];
        for (const bool inner : {false, true}) {
            const Block::Jumps& jumps = inner ? block.back : block.front;
            for (std::size_t i = 0; i + 1 < jumps.of.size(); ++i) {
                for (std::size_t k = jumps.of[i]; k < jumps.of[i + 1]; ++k) {
                    const Block::Jump& jump = jumps.jump[k];
                    const std::uint32_t face = face_of[block.facet[jump.lane]];
                    if (face == no_number ||
                        (inner && object_.inner[face] != NetworkObject::Inner::back)) {
                        continue;
                    }
                    const double absorptance = inner ? back_of(solve_, block).absorptance
                                                     : absorptance_at(solve_, kind, i);
                    jump_.push_back({i, face, inner, absorptance * jump.heat * (0.5 - jump.share)});
                }
            }
        }
    }
    std::stable_sort(jump_.begin(), jump_.end(),
                     [](const Jump& a, const Jump& b) { return a.step < b.step; });
}

double NetworkSurroundings::sun_on(const Group& group, std::size_t l, std::size_t i) const {
    if (group.in_air) return 0.0;
    const double absorptance =
        group.inner ? group.absorptance : absorptance_at(solve_, level_.kind[group.kind], i);
    return absorptance * double(solve_.sunlight.at(i, group.facet[l]));
}

double NetworkSurroundings::longwave_on(const Group& group, std::size_t l, std::size_t i) const {
    if (group.in_air) return absorbed_of_air(group.air[i], group.emissivity);
    const std::size_t f = group.facet[l];
    double longwave = solve_.at_facet(&SkyState::longwave_down, i, f);
    if (!solve_.excess.empty()) longwave += double(solve_.excess.at(i, f));
    if (!solve_.tilt.empty()) {
        longwave += solve_.tilt[f] * solve_.at_facet(&SkyState::tilted_longwave, i, f);
    }
    return group.emissivity * longwave;
}

void NetworkSurroundings::light_at(std::size_t i, std::vector<double> absorbed[2]) const {
    for (const Group& group : group_) {
        std::vector<double>& of = absorbed[group.inner ? 1 : 0];
        for (std::size_t l = 0; l < group.face.size(); ++l) {
            of[group.face[l]] = sun_on(group, l, i) + longwave_on(group, l, i) + group.internal;
        }
    }
}

void NetworkSurroundings::excess(std::size_t i, std::vector<float>& all) const {
    if (solve_.excess.empty()) return;
    const PackedField::Row row = solve_.excess.row(instant(i));
    for (std::size_t n = 0; n < object_.size(); ++n) {
        all.push_back(row(object_.facet[n]) + float(own_.on(n, false)));
        if (object_.back[n] == no_number) continue;
        all.push_back(row(object_.back[n]) + float(own_.on(n, true)));
    }
}

void NetworkSurroundings::begin_step(std::size_t i) {
    first_ = instant(i);
    last_ = instant(i + 1);
    if (step_ != no_step && i == step_ + 1) {
        for (int end = 0; end < 2; ++end) std::swap(before_[end], after_[end]);
    } else {
        light_at(first_, before_);
    }
    light_at(last_, after_);
    step_ = i;
    next_jump_ = std::size_t(
        std::lower_bound(jump_.begin(), jump_.end(), i,
                         [](const Jump& jump, std::size_t step) { return jump.step < step; }) -
        jump_.begin());
}

NetworkForcing NetworkSurroundings::forcing() {
    NetworkForcing forcing{.loads = [this](double share, NetworkLoads& to) { loads(share, to); },
                           .faces = [this](double share, const std::vector<double>& outer,
                                           const std::vector<double>& inner,
                                           FaceFluxes& out) { faces(share, outer, inner, out); }};
    blown_.run(begin_, end_);
    if (blown_.any_runs()) {
        forcing.jets = [this](double share, const std::vector<double>& outer,
                              const std::vector<double>& inner, const std::vector<double>& lump,
                              FaceFluxes& out) { jets(share, outer, inner, lump, out); };
    }
    return forcing;
}

void NetworkSurroundings::jets(double share, const std::vector<double>& outer,
                               const std::vector<double>& inner, const std::vector<double>& lump,
                               FaceFluxes& out) const {
    const double at = std::lerp(from_, to_, share);
    for (const BlownFaces::Face& face : blown_.faces()) {
        const Group& group = group_[face.group];
        const AirFilm air = air_between(group.air[first_], group.air[last_], at);
        const SurfaceFlux more =
            blown_.beyond_air(face, air, lump, (face.back ? inner : outer)[face.facet]);
        (face.back ? out.inner : out.outer)[face.facet] += more.flux;
        (face.back ? out.inner_slope : out.outer_slope)[face.facet] += more.slope;
    }
}

NetworkForcing NetworkSurroundings::of_part(std::size_t i, int s, int parts) {
    if (i != step_) begin_step(i);
    from_ = double(s) / parts;
    to_ = double(s + 1) / parts;
    const double step = solve_.step * double(stride_);
    begin_ = later(solve_.instant[first_], from_ * step);
    end_ = later(solve_.instant[first_], to_ * step);
    return forcing();
}

NetworkForcing NetworkSurroundings::of_mean() {
    own_.begin();
    step_ = no_step;
    next_jump_ = jump_.size();
    first_ = last_ = solve_.instant.size();
    begin_ = solve_.instant.front();
    end_ = solve_.instant.back();
    std::vector<double> sum[2];
    for (std::vector<double>& of : sum) of.assign(object_.size(), 0.0);
    for (std::size_t i = 0; i < steps(); ++i) {
        light_at(instant(i), before_);
        for (int end = 0; end < 2; ++end) {
            for (std::size_t n = 0; n < object_.size(); ++n) {
                sum[end][n] += before_[end][n] / double(steps());
            }
        }
    }
    for (int end = 0; end < 2; ++end) before_[end] = after_[end] = sum[end];
    return forcing();
}

void NetworkSurroundings::own_loads(NetworkLoads& to) const {
    for (const Group& group : group_) {
        if (group.in_air) continue;
        std::vector<double>& of = group.inner ? to.inner : to.outer;
        for (const std::uint32_t n : group.face)
            of[n] += group.emissivity * own_.on(n, group.inner);
    }
}

void NetworkSurroundings::loads(double share, NetworkLoads& to) const {
    const double at = std::lerp(from_, to_, share);
    const HeatNetwork& network = object_.network;
    for (std::size_t n = 0; n < object_.size(); ++n) {
        to.outer[n] = std::lerp(before_[0][n], after_[0][n], at);
        to.inner[n] = std::lerp(before_[1][n], after_[1][n], at);
    }
    own_loads(to);
    for (std::size_t k = next_jump_; k < jump_.size() && jump_[k].step == step_; ++k) {
        (jump_[k].inner ? to.inner : to.outer)[jump_[k].face] += jump_[k].heat;
    }
    const auto spread = [&](const std::vector<std::uint32_t>& faces, double watts) {
        double area = 0.0;
        for (const std::uint32_t n : faces) area += network.facet[n].area;
        for (const std::uint32_t n : faces) to.inner[n] += watts / area;
    };
    for (const NetworkObject::Source& source : object_.source) {
        const double watts = source.watts * source.hours.mean(begin_, end_);
        if (source.lump != no_number) to.lump[source.lump] += watts;
        if (!source.facet.empty()) spread(source.facet, watts);
    }
    for (std::size_t k = 0; k < object_.sunlit.size(); ++k) {
        const double watts = std::lerp(panes_[k][first_], panes_[k][last_], at);
        if (!object_.sunlit[k].behind.empty()) spread(object_.sunlit[k].behind, watts);
    }
    const double air = std::lerp(outdoors_[first_], outdoors_[last_], at);
    for (const NetworkObject::Given& given : object_.given) {
        const double held = std::isnan(given.kelvin) ? 0.0 : given.hours.mean(begin_, end_);
        to.fixed[given.lump] = held == 0.0 ? air : std::lerp(air, given.kelvin, held);
    }
}

void NetworkSurroundings::faces(double share, const std::vector<double>& outer,
                                const std::vector<double>& inner, FaceFluxes& out) const {
    const double at = std::lerp(from_, to_, share);
    for (const Group& group : group_) {
        const AirFilm air = air_between(group.air[first_], group.air[last_], at);
        const std::vector<double>& of = group.inner ? inner : outer;
        std::vector<double>& fluxes = group.inner ? out.inner : out.outer;
        std::vector<double>& slopes = group.inner ? out.inner_slope : out.outer_slope;
        const auto balance = [&](std::size_t vector) {
            alignas(64) double kelvin[lanes], flux[lanes], slope[lanes];
            const std::size_t first = vector * lanes;
            const std::size_t count = std::min(lanes, group.face.size() - first);
            for (std::size_t l = 0; l < lanes; ++l) {
                kelvin[l] = of[group.face[first + std::min(l, count - 1)]];
            }
            kernel().balance(air, group.natural.data() + first, group.emissivity * stefan_boltzmann,
                             kelvin, flux, slope);
            for (std::size_t l = 0; l < count; ++l) {
                fluxes[group.face[first + l]] = flux[l];
                slopes[group.face[first + l]] = slope[l];
            }
        };
        for_each_index(group.natural.size() / lanes, balance, 512 / lanes);
    }
}

void NetworkSurroundings::record(std::size_t i, const std::vector<double>& outer,
                                 const std::vector<double>& inner,
                                 const std::vector<double>& lump) {
    if (!solve_.record || !solve_.record->wants(instant(i))) return;
    const std::size_t now = instant(i);
    // What has blown until now; at the start what begins to.
    const double lately = std::min(solve_.step, 300.0);
    const Instant when = solve_.instant[now];
    blown_.run(i > 0 ? later(when, -lately) : when, i > 0 ? when : later(when, lately));
    for (const Group& group : group_) {
        if (group.in_air) continue;
        for (std::size_t l = 0; l < group.face.size(); ++l) {
            const double kelvin = (group.inner ? inner : outer)[group.face[l]];
            HeatBalance balance = heat_balance(
                group.air[now], group.natural[l], group.emissivity,
                {.absorbed_solar = sun_on(group, l, now), .internal = group.internal}, kelvin);
            balance.longwave_in =
                longwave_on(group, l, now) + group.emissivity * own_.on(group.face[l], group.inner);
            if (blown_.any_runs()) {
                const std::uint32_t at = blown_.of(group.face[l], group.inner);
                if (at != no_number) {
                    balance.sensible +=
                        blown_.beyond_air(blown_.faces()[at], group.air[now], lump, kelvin).flux;
                }
            }
            balance.conducted = -balance.sum();
            // Where a contact covers it, it meets neither light nor air.
            const double open = group.inner ? 1.0 : object_.network.facet[group.face[l]].open;
            solve_.record->put(now, group.facet[l], balance.times(open));
        }
    }
}

}  // namespace diurna
