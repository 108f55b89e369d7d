#pragma once

#include <cstdint>

namespace argand {

/// References to photons that a level must have room for, so that a search always finishes.
inline constexpr std::uint64_t least_frontier_references = 2048;
/// Memory that a reference takes in all buffers of a search together [bytes].
inline constexpr std::uint64_t bytes_a_frontier_reference = 64;
inline constexpr std::uint64_t least_frontier_memory =
    least_frontier_references * bytes_a_frontier_reference;

/// How queries are answered together (frontier.hpp).
struct FrontierSettings {
    std::uint32_t query_leaf = 8; ///< most queries of a leaf, at least 1
    /// What it costs to sort a photon into the parts of a node, over comparing it with a query. The
    /// larger it is, the larger leaves are. 0: all nodes of more than query_leaf queries have
    /// parts.
    float partition_cost = 8;
    std::uint32_t partitions = 3;        ///< of queries for each division of photons, from 1 to 3
    std::uint64_t memory = 256ull << 20; ///< for references to photons [bytes]
};

} // namespace argand
