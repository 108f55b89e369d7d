#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace argand {

/// Sets of the numbers below `size` that grow together (union-find). At first each is alone.
class DisjointSets {
public:
    explicit DisjointSets(std::size_t size) : parent_(size) {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }

    /// The number that stands for the set of `i`, until sets are joined.
    std::uint32_t root(std::uint32_t i) {
        while (parent_[i] != i) {
            parent_[i] = parent_[parent_[i]];
            i = parent_[i];
        }
        return i;
    }

    /// Joins the sets of two numbers.
    void join(std::uint32_t a, std::uint32_t b) { parent_[root(b)] = root(a); }

private:
    std::vector<std::uint32_t> parent_;
};

} // namespace argand
