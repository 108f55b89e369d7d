#include "methods/persist_queue.hpp"

#include "base/error.hpp"

#include <algorithm>

namespace argand {

namespace {

void check(bool holds) {
    if (!holds) {
        fail("loading a saved state: it is not one of a photons queue");
    }
}

/// Saves or loads elements of a buffer. Returns them.
template <class T>
std::vector<T> persist_elements(Archive& archive, Device& device, const Buffer& buffer,
                                std::uint64_t count) {
    std::vector<T> elements;
    if (!archive.loads() && count > 0) {
        elements = download<T>(device, buffer, count);
    }
    archive.values(elements);
    check(elements.size() == count);
    if (archive.loads() && count > 0) {
        device.upload(buffer, 0, std::as_bytes(std::span(elements)));
    }
    return elements;
}

/// Whether each node's children are nodes behind it, and its cells are those of the tree.
bool is_tree(const CellTree& tree) {
    std::uint32_t cells = 0;
    for (std::size_t i = 0; i < tree.nodes.size(); ++i) {
        const std::uint32_t link = tree.nodes[i].link & cell_link_mask;
        const bool leaf = tree.nodes[i].link >> cell_axis_shift == cell_is_leaf;
        if (leaf ? link != cells++ : link <= i + 1 || link >= tree.nodes.size()) {
            return false;
        }
    }
    return cells > 0 && cells == tree.cells && tree.levels.size() + 1 == cells &&
           std::all_of(tree.levels.begin(), tree.levels.end(),
                       [](std::uint32_t level) { return level < most_cell_levels; });
}

/// Saves or loads the paths of the queue's photons.
void persist_paths(Archive& archive, Device& device, PhotonQueue& q,
                   std::span<const std::uint32_t> of_entry) {
    if (archive.loads()) {
        q.vertices = device.allocate("queue: vertices of paths",
                                     q.window * q.vertex_room * sizeof(PathVertex));
    }
    const auto ends = persist_elements<QueuePathEnd>(archive, device, q.path_ends,
                                                     q.window * q.block_room + q.area_room);
    const auto vertices =
        persist_elements<PathVertex>(archive, device, q.vertices, q.window * q.vertex_room);
    // A vertex lies behind the one before, so that each path ends.
    const auto is_path = [&](std::uint32_t entry) {
        const std::uint32_t block = entry >> queue_block_shift;
        std::uint32_t vertex = ends[q.blocks[block].first + (entry & queue_record_mask)].vertex;
        while (block < q.window && vertex < q.vertex_room) {
            const std::uint32_t before = vertices[block * q.vertex_room + vertex].previous;
            if (before == no_vertex) {
                return true;
            }
            vertex = before < vertex ? before : no_vertex;
        }
        return block == q.window;
    };
    check(std::all_of(of_entry.begin(), of_entry.end(), is_path));
}

} // namespace

void persist_queue(Archive& archive, Device& device, PhotonQueue& q) {
    CellTree tree = q.tree;
    std::vector<QueueBlock> blocks = q.blocks;
    bool parts_caustics = q.caustic > 0;
    std::uint64_t entries = q.entries;
    archive.values(tree.nodes);
    archive.value(tree.cells);
    archive.values(tree.levels);
    archive.flag(parts_caustics);
    archive.values(blocks);
    archive.value(q.block_room);
    archive.value(q.area_room);
    archive.value(entries);
    archive.value(q.crowded);
    archive.value(q.crowded_when_divided);
    archive.value(q.divided_for);
    archive.value(q.area_scale);
    const bool may_keep_paths = q.keeps_paths;
    archive.flag(q.keeps_paths);
    archive.value(q.vertex_room);
    if (archive.loads()) {
        const std::uint64_t most = max_stored_photons(device);
        check(is_tree(tree) && (!parts_caustics || tree.cells > 1) &&
              blocks.size() == q.window + 1ull && q.block_room <= most && q.area_room <= most &&
              (may_keep_paths || !q.keeps_paths) &&
              q.window * q.vertex_room * sizeof(PathVertex) <= device.info().limits.storage_range &&
              entries <= q.window * q.block_room + q.area_room);
        set_queue_cells(device, q, std::move(tree), parts_caustics);
        for (std::uint32_t b = 0; b < blocks.size(); ++b) {
            const std::uint64_t room = b < q.window ? q.block_room : q.area_room;
            // A block that was never traced lies nowhere.
            check(blocks[b].records <= room &&
                  (blocks[b].records == 0 || blocks[b].first == b * q.block_room));
        }
        allocate_queue(device, q, q.blocks);
        q.blocks = blocks;
        q.entries = entries;
    }
    persist_elements<std::uint32_t>(archive, device, q.boxes, 6ull * q.cells);
    persist_elements<std::uint32_t>(archive, device, q.emptied, q.cells);
    const auto starts = persist_elements<std::uint32_t>(archive, device, q.starts, q.cells + 1ull);
    const auto of_entry = persist_elements<std::uint32_t>(archive, device, q.of_entry, q.entries);
    const auto cells = persist_elements<std::uint32_t>(archive, device, q.cell_of_entry, q.entries);
    persist_elements<PhotonRecord>(archive, device, q.stored,
                                   q.window * q.block_room + q.area_room);
    persist_elements<glm::uvec4>(archive, device, q.offsets,
                                 q.footprints ? q.window * q.block_room + q.area_room : 0);
    const auto lights = persist_elements<std::uint32_t>(
        archive, device, q.light_indices, q.lights > 1 ? q.window * q.block_room + q.area_room : 0);
    check(std::is_sorted(starts.begin(), starts.end()) && starts.back() == q.entries &&
          std::all_of(cells.begin(), cells.end(),
                      [&](std::uint32_t cell) { return cell < q.cells; }) &&
          std::all_of(of_entry.begin(), of_entry.end(), [&](std::uint32_t entry) {
              const std::uint32_t block = entry >> queue_block_shift;
              return block <= q.window && (entry & queue_record_mask) < q.blocks[block].records;
          }));
    if (q.keeps_paths) {
        persist_paths(archive, device, q, of_entry);
    }
}

} // namespace argand
