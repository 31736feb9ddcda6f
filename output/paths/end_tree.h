#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <vector>

namespace burin {

/// EndTree finds the nearest of places, of which one after the other is taken away: a k-d tree whose nodes know how
/// many are left below them. It takes logarithmic time wherever places are dense.
class EndTree {
  public:
    explicit EndTree(std::vector<glm::dvec2> places);

    void remove(std::size_t place);
    /// The number of a nearest place that is left. There is one. Equal trees give equal answers.
    std::size_t nearest(glm::dvec2 at) const;

  private:
    static constexpr std::size_t kLeafSize = 8;

    struct Node {
        glm::dvec2 low, high;
        std::size_t begin, end;  ///< in order_
        std::size_t parent;
        std::size_t child = 0;  ///< the first of two; 0: a leaf
        std::size_t left;       ///< how many places are left
    };
    void split(std::size_t node);
    double square_distance(const Node& node, glm::dvec2 at) const;
    void search(std::size_t node, glm::dvec2 at, double& least, std::size_t& best) const;

    std::vector<glm::dvec2> places_;
    std::vector<std::size_t> order_, leaf_of_;
    std::vector<bool> is_removed_;
    std::vector<Node> nodes_;
};

}  // namespace burin
