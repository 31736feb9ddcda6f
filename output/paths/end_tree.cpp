#include "output/paths/end_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace burin {

EndTree::EndTree(std::vector<glm::dvec2> places)
    : places_(std::move(places)), order_(places_.size()), leaf_of_(places_.size()), is_removed_(places_.size()) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    nodes_.push_back({{}, {}, 0, places_.size(), 0, 0, places_.size()});
    for (std::size_t node = 0; node < nodes_.size(); ++node) split(node);
}

/// Finds the box of a node, and gives it children if it has many places.
void EndTree::split(std::size_t number) {
    Node node = nodes_[number];
    const auto begin = order_.begin() + static_cast<std::ptrdiff_t>(node.begin);
    const auto end = order_.begin() + static_cast<std::ptrdiff_t>(node.end);
    node.low = glm::dvec2(std::numeric_limits<double>::infinity());
    node.high = -node.low;
    for (auto i = begin; i != end; ++i) {
        node.low = glm::min(node.low, places_[*i]);
        node.high = glm::max(node.high, places_[*i]);
    }
    if (node.left > kLeafSize) {
        const int axis = node.high.x - node.low.x >= node.high.y - node.low.y ? 0 : 1;
        const std::size_t middle = (node.begin + node.end) / 2;
        std::nth_element(begin, order_.begin() + static_cast<std::ptrdiff_t>(middle), end,
                         [&](std::size_t a, std::size_t b) {
                             return std::pair(places_[a][axis], a) < std::pair(places_[b][axis], b);
                         });
        node.child = nodes_.size();
        nodes_.push_back({{}, {}, node.begin, middle, number, 0, middle - node.begin});
        nodes_.push_back({{}, {}, middle, node.end, number, 0, node.end - middle});
    } else {
        for (auto i = begin; i != end; ++i) leaf_of_[*i] = number;
    }
    nodes_[number] = node;
}

void EndTree::remove(std::size_t place) {
    if (is_removed_[place]) return;
    is_removed_[place] = true;
    for (std::size_t node = leaf_of_[place];; node = nodes_[node].parent) {
        --nodes_[node].left;
        if (node == 0) return;
    }
}

double EndTree::square_distance(const Node& node, glm::dvec2 at) const {
    const glm::dvec2 beyond = glm::max(glm::max(node.low - at, at - node.high), glm::dvec2(0.0));
    return glm::dot(beyond, beyond);
}

void EndTree::search(std::size_t number, glm::dvec2 at, double& least, std::size_t& best) const {
    const Node& node = nodes_[number];
    if (node.left == 0 || square_distance(node, at) >= least) return;
    if (node.child == 0) {
        for (std::size_t i = node.begin; i < node.end; ++i) {
            const std::size_t place = order_[i];
            const glm::dvec2 way = places_[place] - at;
            if (is_removed_[place] || glm::dot(way, way) >= least) continue;
            least = glm::dot(way, way);
            best = place;
        }
        return;
    }
    const bool is_second_nearer = square_distance(nodes_[node.child + 1], at) < square_distance(nodes_[node.child], at);
    search(node.child + (is_second_nearer ? 1 : 0), at, least, best);
    search(node.child + (is_second_nearer ? 0 : 1), at, least, best);
}

std::size_t EndTree::nearest(glm::dvec2 at) const {
    double least = std::numeric_limits<double>::infinity();
    std::size_t best = 0;
    search(0, at, least, best);
    return best;
}

}  // namespace burin
