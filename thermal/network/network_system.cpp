#include "thermal/network/network_system.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace diurna {

namespace {

/// By eight sums side by side, so that none waits for the one before.
double dot(const std::vector<double>& a, const std::vector<double>& b) {
    constexpr std::size_t sums = 8;
    double part[sums]{};
    std::size_t k = 0;
    for (; k + sums <= a.size(); k += sums) {
        for (std::size_t j = 0; j < sums; ++j) part[j] += a[k + j] * b[k + j];
    }
    for (; k < a.size(); ++k) part[0] += a[k] * b[k];
    return ((part[0] + part[1]) + (part[2] + part[3])) +
           ((part[4] + part[5]) + (part[6] + part[7]));
}
/// Whether a factor for steps of one length serves steps of another.
bool alike(double factored_tau, double tau) {
    constexpr double most = 1.2;
    return factored_tau >= tau / most && factored_tau <= tau * most;
}
double norm(const std::vector<double>& a) { return std::sqrt(dot(a, a)); }

/// y += scale · (B x − β (β·x) less), B a facet's sideways flow.
struct Sideways {
    const SidewaysFlow& b;
    std::array<double, 3> sums() const {
        return {b[0] + b[1] + b[2], b[1] + b[3] + b[4], b[2] + b[4] + b[5]};
    }
    std::array<double, 3> times(const std::array<double, 3>& x) const {
        return {b[0] * x[0] + b[1] * x[1] + b[2] * x[2], b[1] * x[0] + b[3] * x[1] + b[4] * x[2],
                b[2] * x[0] + b[4] * x[1] + b[5] * x[2]};
    }
    std::array<double, 3> own() const { return {b[0], b[3], b[5]}; }
};

}  // namespace

NetworkSystem::NetworkSystem(const HeatNetwork& network)
    : network_(network),
      facet_(network.facet.size()),
      lump_own_(network.lump.size()),
      given_(*this) {
    first_.push_back(0);
    for (std::size_t f = 0; f < network.facet.size(); ++f) {
        first_.push_back(first_.back() + network.grid_of(f).size());
        touch_.push_back(network.first_touch(f));
    }
    touch_.push_back(network.touch.size());
    pivot_.resize(nodes());
    follows_.resize(nodes());
    find_places();
}

void NetworkSystem::find_places() {
    const auto each = [&](const auto& call) {
        for (std::size_t f = 0; f < facet_.size(); ++f) {
            for (std::size_t s = 0; s < 6; ++s) {
                const std::uint32_t edge = network_.facet[f].edge[s / 3][s % 3];
                if (edge != no_number) call(edge, std::uint32_t(6 * f + s));
            }
        }
        for (std::size_t t = 0; t < network_.touch.size(); ++t) {
            call(network_.touch[t].edge, std::uint32_t(6 * facet_.size() + t));
        }
    };
    first_place_.assign(network_.edges + 1, 0);
    each([&](std::uint32_t edge, std::uint32_t) { ++first_place_[edge + 1]; });
    std::partial_sum(first_place_.begin(), first_place_.end(), first_place_.begin());
    std::vector<std::uint32_t> next(first_place_.begin(), first_place_.end());
    place_.resize(first_place_.back());
    each([&](std::uint32_t edge, std::uint32_t place) { place_[next[edge]++] = place; });
}

NetworkSystem::Given::Given(const NetworkSystem& system)
    : system_(system),
      lumps_(system.network_.lump.size()),
      edge_(6 * system.network_.facet.size() + system.network_.touch.size(), 0.0),
      lump_(blocks() * lumps_, 0.0) {}

void NetworkSystem::Given::add_to(double* edge, double* lump) const {
    const std::vector<std::uint32_t>&first = system_.first_place_, &place = system_.place_;
    constexpr std::size_t edges_at_once = 4096;
    for_each_block(first.size() - 1, edges_at_once, [&](std::size_t begin, std::size_t end) {
        for (std::size_t e = begin; e < end; ++e) {
            double sum = edge[e];
            for (std::uint32_t k = first[e]; k < first[e + 1]; ++k) sum += edge_[place[k]];
            edge[e] = sum;
        }
    });
    for (std::size_t k = 0; k < lump_.size(); ++k) lump[k % lumps_] += lump_[k];
}

/// A facet's nodes, eliminated.
void NetworkSystem::condense(std::size_t f, double tau, const Ends& ends) {
    const NetworkFacet& facet = network_.facet[f];
    const NetworkColumn& column = network_.column[facet.column];
    const ColumnGrid& grid = column.grid;
    const std::size_t n = grid.size(), at = first_[f];
    Condensed& c = facet_[f];
    const std::array<double, behinds> films{facet.film, ends.to_star[f], facet.contact};
    double to_lumps = 0.0;
    for (std::size_t b = 0; b < behinds; ++b) {
        c.to[b] = facet.lump[b] == no_number ? 0.0 : films[b] * facet.area;
        to_lumps += c.to[b];
    }
    double touched = 0.0;
    for (const HeatTouch& touch : touches_of(f)) touched += touch.conductance;
    const std::array<double, 3> sums = Sideways{facet.sideways}.sums();
    const double all = sums[0] + sums[1] + sums[2];
    for (int end = 0; end < 2; ++end) {
        c.spread[end] = facet.edge[end][0] == no_number ? 0.0 : column.spread[end];
    }
    // From the inner end outward: d_j = own_j + k_j + k_{j−1} − k_j² / d_{j+1}.
    for (std::size_t j = n; j-- > 0;) {
        double own = grid.capacity[j] / tau;
        if (j == 0) own -= facet.open * ends.outer_slope[f];
        if (j + 1 == n) own += grid.conductance[j] - ends.inner_slope[f];
        double d = facet.area * own;
        if (j == 0) d += c.spread[0] * all + touched;
        if (j + 1 == n) d += c.spread[1] * all + to_lumps;
        if (j > 0) d += facet.area * grid.conductance[j - 1];
        if (j + 1 < n) {
            const double k = facet.area * grid.conductance[j];
            d += k - k * k / pivot_[at + j + 1];
        }
        pivot_[at + j] = d;
        if (j > 0) follows_[at + j] = facet.area * grid.conductance[j - 1] / d;
    }
    // Row and column of the inverse between the ends: of the outer one 1 / d_0, downward by
    // what follows; of the inner one by the sweep from there.
    c.outer = 1.0 / pivot_[at];
    double down = c.outer;
    for (std::size_t j = 1; j < n; ++j) down *= follows_[at + j];
    c.across = down;
    double inner = 1.0 / pivot_[at + n - 1], path = 1.0;
    if (n > 1) {
        // (K⁻¹)_ll = Σ over j of path² / d_j, path the product of what follows from l up to j.
        inner = 0.0;
        for (std::size_t j = n; j-- > 0;) {
            inner += path * path / pivot_[at + j];
            if (j > 0) path *= follows_[at + j];
        }
    }
    c.inner = inner;
}

void NetworkSystem::factorise(double tau, const Ends& ends) {
    tau_ = tau;
    for_each_index(
        facet_.size(), [&](std::size_t f) { condense(f, tau, ends); }, 512);
    for (std::size_t k = 0; k < lump_own_.size(); ++k) {
        lump_own_[k] = network_.lump[k].capacity / tau;
    }
    now_ = factor_for(tau);
    if (!alike(factor_[now_].tau, tau)) prepare();
}

std::size_t NetworkSystem::factor_for(double tau) const {
    if (alike(factor_[now_].tau, tau) || factor_[now_].tau == 0.0) return now_;
    return 1 - now_;
}

void NetworkSystem::prepare() {
    const std::size_t lumps = network_.edges;
    struct Join {
        std::size_t at;
        double way;
        int end;
    };
    std::vector<Join> joins;
    std::vector<Eigen::Triplet<float>> entry;
    const auto add = [&](std::size_t row, std::size_t column, double value) {
        if (row >= column) entry.emplace_back(int(row), int(column), float(value));
    };
    for (std::size_t f = 0; f < facet_.size(); ++f) {
        const NetworkFacet& facet = network_.facet[f];
        const Condensed& c = facet_[f];
        const Sideways flow{facet.sideways};
        const auto sums = flow.sums();
        // All that the facet joins: its way to an end, and which end.
        joins.clear();
        for (int end = 0; end < 2; ++end) {
            if (c.spread[end] == 0.0) continue;
            for (std::size_t a = 0; a < 3; ++a) {
                std::array<double, 3> unit{};
                unit[a] = 1.0;
                const auto column = flow.times(unit);
                for (std::size_t b = 0; b < 3; ++b) {
                    add(facet.edge[end][b], facet.edge[end][a], c.spread[end] * column[b]);
                }
                joins.push_back({facet.edge[end][a], c.spread[end] * sums[a], end});
            }
        }
        for (std::size_t k = 0; k < behinds; ++k) {
            if (c.to[k] == 0.0 || network_.lump[facet.lump[k]].fixed) continue;
            joins.push_back({lumps + facet.lump[k], c.to[k], 1});
            add(lumps + facet.lump[k], lumps + facet.lump[k], c.to[k]);
        }
        for (const HeatTouch& touch : touches_of(f)) {
            joins.push_back({touch.edge, touch.conductance, 0});
            add(touch.edge, touch.edge, touch.conductance);
        }
        for (const Join& a : joins) {
            for (const Join& b : joins) {
                const double inverse = a.end != b.end ? c.across : a.end == 0 ? c.outer : c.inner;
                add(b.at, a.at, -a.way * b.way * inverse);
            }
        }
    }
    for (const HeatLink& link : network_.link) {
        for (const std::uint32_t end : {link.a, link.b}) {
            if (!network_.lump[end].fixed) add(lumps + end, lumps + end, link.conductance);
        }
        if (network_.lump[link.a].fixed || network_.lump[link.b].fixed) continue;
        add(lumps + std::max(link.a, link.b), lumps + std::min(link.a, link.b), -link.conductance);
    }
    for (const HeatStream& stream : network_.stream) {
        if (!network_.lump[stream.to].fixed) {
            add(lumps + stream.to, lumps + stream.to, stream.conductance);
        }
    }
    for (std::size_t k = 0; k < lump_own_.size(); ++k) {
        // One that nothing joins would have a row of zeros.
        add(lumps + k, lumps + k, network_.lump[k].fixed ? 1.0 : lump_own_[k] + 1e-12);
    }
    const auto size = Eigen::Index(unknowns());
    Eigen::SparseMatrix<float> left(size, size);
    left.setFromTriplets(entry.begin(), entry.end());
    factor_[now_].of.compute(left);
    factor_[now_].tau = tau_;
}

void NetworkSystem::apply(const std::vector<double>& x, std::vector<double>& y) {
    const std::size_t lumps = network_.edges;
    std::fill(y.begin(), y.end(), 0.0);
    const auto lump = [&](std::uint32_t k) { return network_.lump[k].fixed ? 0.0 : x[lumps + k]; };
    given_.of_facets([&](std::size_t block, std::size_t begin, std::size_t last) {
        for (std::size_t f = begin; f < last; ++f) {
            const NetworkFacet& facet = network_.facet[f];
            const Condensed& c = facet_[f];
            const Sideways flow{facet.sideways};
            const auto sums = flow.sums();
            std::array<double, 3> at[2]{};
            double into[2]{};
            for (int end = 0; end < 2; ++end) {
                if (c.spread[end] == 0.0) continue;
                for (int s = 0; s < 3; ++s) {
                    at[end][s] = x[facet.edge[end][s]];
                    into[end] += c.spread[end] * sums[s] * at[end][s];
                }
            }
            for (std::size_t b = 0; b < behinds; ++b) {
                if (c.to[b] != 0.0) into[1] += c.to[b] * lump(facet.lump[b]);
            }
            const auto touches = touches_of(f);
            for (const HeatTouch& touch : touches) into[0] += touch.conductance * x[touch.edge];
            const double moved[2]{c.outer * into[0] + c.across * into[1],
                                  c.across * into[0] + c.inner * into[1]};
            for (int end = 0; end < 2; ++end) {
                if (c.spread[end] == 0.0) continue;
                const auto flux = flow.times(at[end]);
                for (int s = 0; s < 3; ++s) {
                    given_.to_edge(f, end, s) = c.spread[end] * (flux[s] - sums[s] * moved[end]);
                }
            }
            for (std::size_t t = 0; t < touches.size(); ++t) {
                given_.to_touched(touch_[f] + t) =
                    touches[t].conductance * (x[touches[t].edge] - moved[0]);
            }
            for (std::size_t b = 0; b < behinds; ++b) {
                if (c.to[b] == 0.0) continue;
                given_.to_lump(block, facet.lump[b]) += c.to[b] * (lump(facet.lump[b]) - moved[1]);
            }
        }
    });
    given_.add_to(y.data(), y.data() + lumps);
    for (const HeatLink& link : network_.link) {
        const double flux = link.conductance * (lump(link.a) - lump(link.b));
        y[lumps + link.a] += flux;
        y[lumps + link.b] -= flux;
    }
    for (const HeatStream& stream : network_.stream) {
        y[lumps + stream.to] += stream.conductance * (lump(stream.to) - lump(stream.from));
    }
    for (std::size_t k = 0; k < lump_own_.size(); ++k) {
        double& out = y[lumps + k];
        out += lump_own_[k] * x[lumps + k];
        if (network_.lump[k].fixed) out = x[lumps + k];
    }
}

int NetworkSystem::conjugate_gradients(const std::vector<double>& b, std::vector<double>& x,
                                       double error) {
    const std::size_t n = b.size();
    std::vector<double> r = b, z(n), p(n), q(n);
    const double enough = error * norm(b);
    double rz = 0.0;
    const int most = 2000;
    int i = 0;
    for (; i < most && norm(r) > enough; ++i) {
        factor_[now_].of.solve(r, z);
        const double next = dot(r, z), onward = i == 0 ? 0.0 : next / rz;
        rz = next;
        for (std::size_t k = 0; k < n; ++k) p[k] = z[k] + onward * p[k];
        apply(p, q);
        const double length = rz / dot(p, q);
        for (std::size_t k = 0; k < n; ++k) {
            x[k] += length * p[k];
            r[k] -= length * q[k];
        }
    }
    return i;
}

/// van der Vorst 1992 (BiCGSTAB).
int NetworkSystem::stabilised(const std::vector<double>& b, std::vector<double>& x, double error) {
    const std::size_t n = b.size();
    std::vector<double> r = b, shadow = b, p(n), v(n), s(n), t(n), y(n), z(n);
    const double enough = error * norm(b);
    double rho = 1.0, alpha = 1.0, omega = 1.0;
    const int most = 2000;
    int i = 0;
    for (; i < most && norm(r) > enough; ++i) {
        const double next = dot(shadow, r);
        const double beta = next / rho * (alpha / omega);
        rho = next;
        for (std::size_t k = 0; k < n; ++k) {
            p[k] = r[k] + beta * (p[k] - omega * v[k]);
        }
        factor_[now_].of.solve(p, y);
        apply(y, v);
        alpha = rho / dot(shadow, v);
        for (std::size_t k = 0; k < n; ++k) {
            s[k] = r[k] - alpha * v[k];
        }
        factor_[now_].of.solve(s, z);
        apply(z, t);
        const double tt = dot(t, t);
        omega = tt > 0.0 ? dot(t, s) / tt : 0.0;
        for (std::size_t k = 0; k < n; ++k) {
            x[k] += alpha * y[k] + omega * z[k];
            r[k] = s[k] - omega * t[k];
        }
        if (omega == 0.0 || rho == 0.0) break;
    }
    return i;
}

int NetworkSystem::solve(Residual& residual, double relative_error) {
    const std::size_t lumps = network_.edges;
    std::vector<double> b(unknowns()), x(unknowns(), 0.0);
    std::copy(residual.edge.begin(), residual.edge.end(), b.begin());
    for (std::size_t k = 0; k < network_.lump.size(); ++k) {
        b[lumps + k] = network_.lump[k].fixed ? 0.0 : residual.lump[k];
    }
    given_.of_facets([&](std::size_t block, std::size_t begin, std::size_t last) {
        for (std::size_t f = begin; f < last; ++f) eliminate_column(block, f, residual.node);
    });
    given_.add_to(b.data(), b.data() + lumps);
    const int iterations = network_.stream.empty() ? conjugate_gradients(b, x, relative_error)
                                                   : stabilised(b, x, relative_error);
    constexpr int outworn = 10;
    if (iterations > outworn) factor_[now_].tau = 0.0;
    for_each_index(
        facet_.size(), [&](std::size_t f) { follow_column(f, x, residual.node); }, 512);
    std::copy(x.begin(), x.begin() + std::ptrdiff_t(lumps), residual.edge.begin());
    for (std::size_t k = 0; k < network_.lump.size(); ++k) {
        residual.lump[k] = network_.lump[k].fixed ? 0.0 : x[lumps + k];
    }
    return iterations;
}

void NetworkSystem::eliminate_column(std::size_t block, std::size_t f, std::vector<double>& node) {
    const std::size_t at = first_[f], n = first_[f + 1] - at;
    for (std::size_t j = n - 1; j > 0; --j) {
        node[at + j - 1] += follows_[at + j] * node[at + j];
    }
    const NetworkFacet& facet = network_.facet[f];
    const Condensed& c = facet_[f];
    double before = node[at] / pivot_[at];
    const double outer = before;
    for (std::size_t j = 1; j < n; ++j) {
        before = node[at + j] / pivot_[at + j] + follows_[at + j] * before;
    }
    const double ends[2]{outer, before};
    const auto sums = Sideways{facet.sideways}.sums();
    for (int end = 0; end < 2; ++end) {
        for (int s = 0; s < 3; ++s) {
            given_.to_edge(f, end, s) = c.spread[end] * sums[s] * ends[end];
        }
    }
    for (std::size_t k = 0; k < behinds; ++k) {
        if (c.to[k] == 0.0 || network_.lump[facet.lump[k]].fixed) continue;
        given_.to_lump(block, facet.lump[k]) += c.to[k] * ends[1];
    }
    const auto touches = touches_of(f);
    for (std::size_t t = 0; t < touches.size(); ++t) {
        given_.to_touched(touch_[f] + t) = touches[t].conductance * ends[0];
    }
}

void NetworkSystem::follow_column(std::size_t f, const std::vector<double>& x,
                                  std::vector<double>& node) const {
    const std::size_t at = first_[f], n = first_[f + 1] - at;
    const NetworkFacet& facet = network_.facet[f];
    const Condensed& c = facet_[f];
    const auto sums = Sideways{facet.sideways}.sums();
    double into[2]{};
    for (int end = 0; end < 2; ++end) {
        if (c.spread[end] == 0.0) continue;
        for (int s = 0; s < 3; ++s) {
            into[end] += c.spread[end] * sums[s] * x[facet.edge[end][s]];
        }
    }
    const auto lump = [&](std::uint32_t k) {
        return network_.lump[k].fixed ? 0.0 : x[network_.edges + k];
    };
    for (std::size_t k = 0; k < behinds; ++k) {
        if (c.to[k] != 0.0) into[1] += c.to[k] * lump(facet.lump[k]);
    }
    for (const HeatTouch& touch : touches_of(f)) into[0] += touch.conductance * x[touch.edge];
    double up = into[1];
    node[at + n - 1] += up;
    for (std::size_t j = n - 1; j > 0; --j) {
        up *= follows_[at + j];
        node[at + j - 1] += up;
    }
    node[at] += into[0];
    double before = 0.0;
    for (std::size_t j = 0; j < n; ++j) {
        node[at + j] = node[at + j] / pivot_[at + j] + (j > 0 ? follows_[at + j] * before : 0.0);
        before = node[at + j];
    }
}

}  // namespace diurna
