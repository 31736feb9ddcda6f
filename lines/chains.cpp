#include "lines/chains.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/interrupt.h"
#include "lines/end_links.h"

namespace burin {
namespace {

/// Links the ends of whole lines that follow each other.
class ChainsOfLines {
  public:
    ChainsOfLines(std::span<const WholeLine> lines, const SurfaceSet& surfaces)
        : lines_(lines), surfaces_(surfaces), links_(lines.size()) {
        std::vector<std::uint32_t> ends;
        for (std::uint32_t end = 0; end < 2 * lines.size(); ++end) {
            if (node(end) != WholeLine::kNoNode) ends.push_back(end);
        }
        std::sort(ends.begin(), ends.end(), [&](std::uint32_t a, std::uint32_t b) {
            throw_if_interrupted();
            return node(a) != node(b) ? node(a) < node(b) : a < b;
        });
        for (auto first = ends.begin(); first != ends.end();) {
            throw_if_interrupted();
            const auto next =
                std::find_if(first, ends.end(), [&](std::uint32_t end) { return node(end) != node(*first); });
            link_node({&*first, static_cast<std::size_t>(next - first)});
            first = next;
        }
    }

    struct Chain {
        std::size_t begin, end;  // of its lines
        bool is_loop;
        double length;  // in its mesh
    };

    /// Calls visit(ends by which each line is entered, whether it is a loop) for all chains, those first that come
    /// first.
    template <typename Visit>
    void for_chains(const Visit& visit) const {
        std::vector<std::uint32_t> all;
        std::vector<Chain> chains;
        links_.for_chains([&](std::vector<std::uint32_t>& chain, bool is_loop) {
            put_in_order(chain, is_loop);
            double length = 0;
            for (const std::uint32_t e : chain) length += length_in_mesh(e);
            chains.push_back({all.size(), all.size() + chain.size(), is_loop, length});
            all.insert(all.end(), chain.begin(), chain.end());
        });
        const auto ends_of = [&](const Chain& c) {
            return std::span<const std::uint32_t>(all).subspan(c.begin, c.end - c.begin);
        };
        const auto before = [this](std::uint32_t a, std::uint32_t b) { return is_before(a, b); };
        std::stable_sort(chains.begin(), chains.end(), [&](const Chain& a, const Chain& b) {
            throw_if_interrupted();
            if (a.length != b.length) return a.length > b.length;
            const auto p = ends_of(a), q = ends_of(b);
            if (std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end(), before)) return true;
            if (std::lexicographical_compare(q.begin(), q.end(), p.begin(), p.end(), before)) return false;
            if (is_before(p.back() ^ 1, q.back() ^ 1)) return true;
            if (is_before(q.back() ^ 1, p.back() ^ 1)) return false;
            return depth_of(p.front()) < depth_of(q.front());  // one lies behind the other
        });
        for (const Chain& c : chains) {
            throw_if_interrupted();
            visit(ends_of(c), c.is_loop);
        }
    }

  private:
    /// The length of the whole edge, however much of it the line is, so that it is the same in all views. It is 0 for
    /// what is no edge.
    double length_in_mesh(std::uint32_t end) const {
        const WholeLine& line = lines_[end / 2];
        if (!line.is_edge()) return 0;
        const Mesh& mesh = *surfaces_.instances[line.id.instance()].mesh;
        const HalfEdge h = line.id.half_edge();
        if (mesh.is_loose(h)) {
            const auto [a, b] = mesh.loose_edge(h);
            return glm::distance(mesh.local_position(a), mesh.local_position(b));
        }
        const auto& corners = mesh.triangles[h / 3];
        return glm::distance(mesh.local_position(corners[h % 3]), mesh.local_position(corners[(h + 1) % 3]));
    }
    /// Tells lines apart that cover each other: by their edge, and by how near they are.
    std::tuple<std::uint64_t, double, double> depth_of(std::uint32_t end) const {
        const WholeLine& line = lines_[end / 2];
        const bool is_forwards = end % 2 == 0;
        return {line.id.bits, is_forwards ? line.nearness_from : line.nearness_to,
                is_forwards ? line.nearness_to : line.nearness_from};
    }
    std::uint64_t node(std::uint32_t end) const { return lines_[end / 2].nodes[end % 2]; }
    /// The class that the line has in every view, if it has one.
    LineClassSet lasting_class(std::uint32_t end) const {
        const auto first = lines_[end / 2].classes.without(kClassesOfAView).first();
        return first ? LineClassSet(*first) : LineClassSet();
    }

    void link_node(std::span<const std::uint32_t> ends) {
        if (ends.size() == 2) return links_.link(ends[0], ends[1]);
        std::vector<std::uint32_t> alone;
        for (const std::uint32_t end : ends) {
            if (!links_.is_free(end)) continue;
            std::vector<std::uint32_t> same;
            for (const std::uint32_t other : ends) {
                if (lasting_class(other) == lasting_class(end)) same.push_back(other);
            }
            if (same.size() == 2) {
                links_.link(same[0], same[1]);
            } else {
                alone.push_back(end);
            }
        }
        if (alone.size() == 2) links_.link(alone[0], alone[1]);
    }

    /// Ends compare by where they are in their mesh; those without a vertex by where they are on the screen, behind the
    /// others.
    bool is_before(std::uint32_t a, std::uint32_t b) const {
        const auto key = [&](std::uint32_t end) {
            const std::uint64_t own = node(end);
            const bool has_vertex = own != WholeLine::kNoNode && lines_[end / 2].is_edge();
            const auto instance = static_cast<std::uint32_t>(own >> 32);
            const glm::dvec3 p = has_vertex ? surfaces_.instances[instance].mesh->local_position(own & 0xFFFFFFFFu)
                                            : glm::dvec3(end % 2 == 0 ? lines_[end / 2].from : lines_[end / 2].to, 0);
            return std::tuple(!has_vertex, has_vertex ? instance : 0, p.x, p.y, p.z);
        };
        return key(a) < key(b);
    }

    void put_in_order(std::vector<std::uint32_t>& chain, bool is_loop) const {
        const auto before = [this](std::uint32_t a, std::uint32_t b) { return is_before(a, b); };
        if (is_loop) std::rotate(chain.begin(), std::min_element(chain.begin(), chain.end(), before), chain.end());
        std::vector<std::uint32_t> backwards(chain.rbegin(), chain.rend());
        for (std::uint32_t& end : backwards) end ^= 1;
        // All vertices on the way are compared, for a chain may end where it began. A loop does, and rounding says
        // which of two intersections begins first.
        const std::ptrdiff_t known = is_loop ? 1 : 0;
        if (std::lexicographical_compare(backwards.begin() + known, backwards.end(), chain.begin() + known, chain.end(),
                                         before)) {
            chain.swap(backwards);
        }
    }

    std::span<const WholeLine> lines_;
    const SurfaceSet& surfaces_;
    EndLinks links_;
};

}  // namespace

LineChains chains_of(std::span<const WholeLine> lines, const SurfaceSet& surfaces, std::optional<double> period_px) {
    LineChains chains;
    chains.positions.resize(lines.size());
    ChainsOfLines(lines, surfaces).for_chains([&](std::span<const std::uint32_t> chain, bool is_loop) {
        double scale = 1;
        if (is_loop && period_px) {
            double total = 0;
            for (const std::uint32_t end : chain) total += lines[end / 2].length_px();
            if (total > 0) scale = *period_px * std::max(1.0, std::round(total / *period_px)) / total;
        }
        double at = 0;
        for (const std::uint32_t end : chain) {
            chains.positions[end / 2][end % 2] = at;
            at += scale * lines[end / 2].length_px();
            chains.positions[end / 2][1 - end % 2] = at;
            chains.lines.push_back(end / 2);
        }
        chains.chain_ends.push_back(chains.lines.size());
        chains.is_loop.push_back(is_loop);
        chains.length_px.push_back(at);
    });
    return chains;
}

}  // namespace burin
