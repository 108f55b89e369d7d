#pragma once

#include "photon/frontier.hpp"

#include <array>
#include <vector>

/// The state of a simultaneous search, and what its sources share. frontier.cpp divides levels,
/// frontier_waiting.cpp keeps parts of levels that have to wait, frontier_counting.cpp counts.
namespace argand::frontier {

/// Nodes of a level, or parts of them.
struct Nodes {
    Buffer ranges;    ///< SegmentRange: their queries
    Buffer boxes;     ///< BoxRecord: of their queries
    Buffer nodes;     ///< FrontierNode
    Buffer ancestors; ///< uint: the node of the level before
};

/// Queries in the order of nodes.
struct Places {
    Buffer places;   ///< uvec4 per query: its position and slot
    Buffer segments; ///< uint per query: its node, or no_segment
};

/// Nodes of a level that lie side by side, as their queries and references do.
struct Part {
    std::uint32_t side = 0; ///< where the queries are
    std::uint32_t first_node = 0, end_node = 0;
    std::uint32_t first_query = 0, end_query = 0;
    std::uint32_t first_photon = 0, end_photon = 0; ///< references
    std::uint32_t active = 0;                       ///< nodes with children
    std::uint32_t chunks = 0;                       ///< of their references
};

/// A part that waits for room. Its queries stay where they are: no other part moves them.
struct Waiting {
    Part part;
    Nodes nodes;
    std::uint32_t place = 0; ///< of its references among those that wait
};

/// One search: its buffers, and what becomes of them from level to level.
class Search {
public:
    Search(Device& device, const PhotonMap& map, const PhotonQueries& queries,
           std::uint32_t query_count, double reach, const FrontierSettings& settings,
           const std::function<void(const FrontierLeaves&)>& add, FrontierStatistics* statistics);

    void run();

private:
    void make_room(std::uint64_t references, std::uint32_t kept);
    void search_among(std::uint32_t first, std::uint32_t end);
    void take_levels(Part part);
    std::uint32_t divide_queries(Part& part);
    std::uint32_t partition_queries(Part& part, std::uint32_t level_side, std::uint32_t nodes,
                                    std::uint32_t parts, bool again);
    void divide_photons(const Part& part, std::uint32_t children);
    Part split(const Part& part, std::uint32_t children);
    void wait_or_finish(const Part& part);
    Part resume();
    void add_leaves(const Part& part, std::uint32_t most_photons);
    void count_leaves(const Part& part);
    void count_photons(const Part& part, std::uint32_t children);
    std::vector<std::uint32_t> read_counters();
    FrontierParams params(std::uint32_t first, std::uint32_t end) const;

    Device& device_;
    const PhotonMap& map_;
    const PhotonQueries& queries_;
    FrontierSettings settings_;
    const std::function<void(const FrontierLeaves&)>& add_;
    FrontierStatistics* statistics_;
    float reach_;
    bool of_footprints_;
    std::uint32_t chunk_;
    std::uint32_t query_count_;
    std::uint32_t photon_count_;
    std::uint64_t most_nodes_ = 0;      ///< of a level
    std::uint32_t most_references_ = 0; ///< of a level, for which there is room now
    std::uint32_t limit_ = 0;           ///< of most_references_
    /// Photons taken together. The two parts of a single node have room, even if each photon goes
    /// to both.
    std::uint32_t batch_ = 0;
    std::uint32_t first_photon_ = 0; ///< of those taken together
    bool careful_ = false;           ///< children are made by a single partition

    Nodes now_;                           ///< of the level
    Nodes parts_, other_parts_;           ///< of the nodes' queries
    std::array<Places, 3> places_;        ///< of the level, and of parts
    Buffer references_, next_references_; ///< uvec4: position and index of a photon
    Buffer copies_, first_copies_, chunks_, first_chunks_, families_; ///< per node
    Buffer sources_, query_lefts_;                                    ///< uint per part
    Buffer chunk_sources_;                                            ///< uint per chunk
    Buffer counts_, sums_;                                            ///< uint per chunk and child
    Buffer flags_, flag_sums_, to_;                                   ///< uint per query
    Buffer photon_flags_, photon_sums_; ///< uint per photon of a batch
    Buffer extents_;                    ///< vec4 per photon: half sizes of footprints
    Buffer counters_;
    Buffer waiting_references_;
    std::vector<Waiting> waiting_;
};

} // namespace argand::frontier
