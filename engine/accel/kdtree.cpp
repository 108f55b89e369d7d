#include "accel/kdtree.hpp"

#include "base/error.hpp"
#include "device/copy_elements.hpp"
#include "kernels/kd_count.hpp"
#include "kernels/kd_decide.hpp"
#include "kernels/kd_elements.hpp"
#include "kernels/kd_masks.hpp"
#include "kernels/kd_move.hpp"
#include "kernels/kd_places.hpp"
#include "kernels/kd_plan.hpp"
#include "kernels/kd_root.hpp"
#include "kernels/kd_sides.hpp"
#include "kernels/kd_small_plan.hpp"
#include "kernels/kd_small_roots.hpp"
#include "kernels/kd_small_split.hpp"
#include "kernels/kd_split.hpp"
#include "kernels/kd_sums.hpp"
#include "kernels/kd_write.hpp"
#include "kernels/kd_write_large.hpp"
#include "parallel/compact.hpp"
#include "parallel/scan.hpp"
#include "parallel/segments.hpp"
#include "shared/kdtree_build.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace argand {

namespace {

/// Nodes that were made at once.
struct NodeRange {
    std::uint32_t first = 0, end = 0;
    std::uint32_t size() const { return end - first; }
};

/// State of a build on a device.
class KdBuild {
public:
    KdBuild(Device& device, std::uint32_t count, const KdTreeSettings& settings)
        : device_(device), count_(count), settings_(settings), rules_(kd_rules(settings, count)),
          lanes_(settings.points ? Lanes::point : Lanes::box) {
        tree_.references = count;
    }

    KdTree build(const Buffer& boxes);

private:
    static constexpr const char* memory_name = "kd-tree: build";

    Buffer allocate(std::uint64_t elements, std::uint64_t bytes) {
        return device_.allocate(memory_name, std::max<std::uint64_t>(elements, 1) * bytes);
    }
    std::uint32_t lanes() const { return static_cast<std::uint32_t>(lanes_); }

    KdBuildParams params(std::uint32_t first, std::uint32_t end) const {
        return {.first = first,
                .end = end,
                .nodes = nodes_end_,
                .finished = finished_end_,
                .rules = rules_,
                .stop = 0,
                .leaf_count = tree_.leaf_count,
                .pad0 = 0,
                .pad1 = 0};
    }

    /// Makes room in a buffer for so many elements, of which it has `kept` already.
    void make_room(Buffer& buffer, std::uint64_t kept, std::uint64_t wanted, std::uint64_t bytes) {
        if (buffer.size() < wanted * bytes) {
            // More than now, as levels grow, if one kernel can address it.
            const std::uint64_t most = device_.info().limits.storage_range / bytes;
            const Buffer larger = allocate(std::max(wanted, std::min(2 * wanted, most)), bytes);
            copy_elements(device_, buffer, 0, larger, 0, kept, bytes);
            buffer = larger;
        }
    }

    void make_room_for_nodes(std::uint64_t children) {
        make_room(nodes_, nodes_end_, nodes_end_ + children, sizeof(KdNode));
        make_room(cells_, nodes_end_, nodes_end_ + children, sizeof(BoxRecord));
    }

    /// Whether kernels can address a tree that has grown so much.
    bool is_addressable(std::uint64_t leaves, std::uint64_t references) const {
        // Large nodes need a box for each reference, small ones a word for each candidate.
        const std::uint64_t most = std::max<std::uint64_t>(
            {4 * kd_tree_words(leaves, references), 2 * leaves * sizeof(BoxRecord),
             references * std::max<std::uint64_t>(16ull * lanes(), 4ull * kd_candidates(rules_))});
        return most <= device_.info().limits.storage_range;
    }

    /// Reads the counters of a level. Whether the tree may grow by them.
    bool may_grow() {
        counters_now_ = download<std::uint32_t>(device_, counters_, kd_counters);
        const std::uint64_t leaves = tree_.leaf_count + std::uint64_t(counters_now_[kd_splits]);
        const std::uint64_t references = tree_.references + counters_now_[kd_growth];
        return counters_now_[kd_splits] == 0 ||
               (kd_tree_fits(leaves, references, settings_) && is_addressable(leaves, references));
    }
    void grow() {
        tree_.leaf_count += counters_now_[kd_splits];
        tree_.references += counters_now_[kd_growth];
    }

    void start(const Buffer& boxes);
    void divide_large();
    void plan_large(const NodeRange& level);
    void split_large(const NodeRange& level);
    void move_references(const NodeRange& level);
    void decide(const NodeRange& level, const Buffer& counts, bool stop);
    void divide_small();
    void write();

    Device& device_;
    std::uint32_t count_;
    KdTreeSettings settings_;
    KdRules rules_;
    Lanes lanes_;
    KdTree tree_;
    Buffer elements_; ///< the boxes or points by the rules
    Buffer counters_;
    std::vector<std::uint32_t> counters_now_;
    Buffer nodes_; ///< KdNode
    Buffer cells_; ///< BoxRecord per node
    std::uint32_t nodes_end_ = 1;
    std::vector<NodeRange> levels_{{0, 1}}; ///< children come in a later level than their parents
    // References to elements of nodes that are not large any more, and of large leaves, which
    // finished_nodes_ names.
    Buffer finished_, finished_nodes_;
    std::uint32_t finished_end_ = 0;
    // References of the level of large nodes: elements, and the node of each, counted from the
    // level's first.
    Buffer references_, segments_;
    std::uint32_t references_end_ = 0;
    // Of each node of a level:
    Buffer plans_, choices_, starts_;
    Buffer split_counts_, next_counts_, finished_counts_;
};

KdTree KdBuild::build(const Buffer& boxes) {
    if (!kd_tree_fits(1, count_, settings_)) {
        fail_for_one_leaf(settings_, count_);
    }
    start(boxes);
    if (count_ > kd_small) {
        divide_large();
    }
    divide_small();
    write();
    return std::move(tree_);
}

/// Makes the root, and the references to all elements.
void KdBuild::start(const Buffer& boxes) {
    elements_ = allocate(count_, 16ull * lanes());
    segments_ = allocate(count_, 4);
    finished_ = allocate(count_, 4);
    finished_nodes_ = allocate(count_, 4);
    counters_ = allocate(kd_counters, 4);
    nodes_ = allocate(1 + count_ / 4, sizeof(KdNode));
    cells_ = allocate(1 + count_ / 4, sizeof(BoxRecord));
    const Buffer box = allocate(1, sizeof(BoxRecord));
    if (count_ > 0) {
        dispatch(device_,
                 kernels::kd_elements{.boxes = boxes,
                                      .elements = elements_,
                                      .segments = segments_,
                                      .finished = finished_,
                                      .finished_nodes = finished_nodes_,
                                      .params = params(0, count_),
                                      .constants = {.lanes = lanes()}},
                 count_);
        segment_boxes(device_, elements_, lanes_, {.of_elements = segments_, .end = count_}, 1,
                      box);
    }
    dispatch(device_,
             kernels::kd_root{
                 .boxes = box, .nodes = nodes_, .cells = cells_, .params = params(0, count_)},
             1);
    references_ = elements_;
    references_end_ = count_;
    if (count_ <= kd_small) {
        finished_end_ = count_;
    }
}

/// Decides on the large nodes of a level, and counts what comes of that.
void KdBuild::decide(const NodeRange& level, const Buffer& counts, bool stop) {
    KdBuildParams p = params(level.first, level.end);
    p.stop = stop ? 1 : 0;
    device_.fill(counters_, 0);
    dispatch(device_,
             kernels::kd_decide{.nodes = nodes_,
                                .plans = plans_,
                                .counts = counts,
                                .choices = choices_,
                                .split_counts = split_counts_,
                                .next_counts = next_counts_,
                                .finished_counts = finished_counts_,
                                .counters = counters_,
                                .starts = starts_,
                                .cells = cells_,
                                .params = p},
             level.size());
}

/// Decides on the large nodes of a level; none of them is split where the tree would become too
/// large.
void KdBuild::plan_large(const NodeRange& level) {
    const std::uint32_t n = level.size();
    const Buffer tight = allocate(n, sizeof(BoxRecord));
    const Buffer counts = allocate(n, 6 * 4);
    plans_ = allocate(n, sizeof(KdPlanes));
    choices_ = allocate(n, sizeof(KdChoice));
    starts_ = allocate(n, 4);
    split_counts_ = allocate(n, 4);
    next_counts_ = allocate(n, 4);
    finished_counts_ = allocate(n, 4);
    segment_boxes(device_, references_, lanes_, {.of_elements = segments_, .end = references_end_},
                  n, tight);
    dispatch(device_,
             kernels::kd_plan{.nodes = nodes_,
                              .tight = tight,
                              .plans = plans_,
                              .counts = counts,
                              .cells = cells_,
                              .params = params(level.first, level.end)},
             n);
    dispatch(device_,
             kernels::kd_count{.references = references_,
                               .segments = segments_,
                               .plans = plans_,
                               .counts = counts,
                               .params = params(0, references_end_),
                               .constants = {.lanes = lanes()}},
             (references_end_ + segment_run - 1) / segment_run);
    decide(level, counts, false);
    if (!may_grow()) {
        tree_.stopped = true;
        decide(level, counts, true);
        may_grow();
    }
    grow();
}

/// Makes the children of a level's nodes.
void KdBuild::split_large(const NodeRange& level) {
    const std::uint64_t finished = std::uint64_t(finished_end_) + counters_now_[kd_finished];
    make_room_for_nodes(2 * std::uint64_t(counters_now_[kd_splits]));
    make_room(finished_, finished_end_, finished, 4);
    make_room(finished_nodes_, finished_end_, finished, 4);
    exclusive_scan(device_, split_counts_, split_counts_, level.size());
    exclusive_scan(device_, next_counts_, next_counts_, level.size());
    exclusive_scan(device_, finished_counts_, finished_counts_, level.size());
    dispatch(device_,
             kernels::kd_split{.nodes = nodes_,
                               .choices = choices_,
                               .split_sums = split_counts_,
                               .next_sums = next_counts_,
                               .finished_sums = finished_counts_,
                               .cells = cells_,
                               .params = params(level.first, level.end)},
             level.size());
}

/// Moves the references of a level to the children of its nodes.
void KdBuild::move_references(const NodeRange& level) {
    const std::uint32_t next_end = counters_now_[kd_next];
    const Buffer lefts = allocate(references_end_, 4);
    const Buffer rights = allocate(references_end_, 4);
    const Buffer left_sums = allocate(references_end_, 4);
    const Buffer right_sums = allocate(references_end_, 4);
    const Buffer next_references = allocate(next_end, 16ull * lanes());
    const Buffer next_segments = allocate(next_end, 4);
    dispatch(device_,
             kernels::kd_sides{.references = references_,
                               .segments = segments_,
                               .choices = choices_,
                               .lefts = lefts,
                               .rights = rights,
                               .params = params(0, references_end_),
                               .constants = {.lanes = lanes()}},
             references_end_);
    exclusive_scan(device_, lefts, left_sums, references_end_);
    exclusive_scan(device_, rights, right_sums, references_end_);
    dispatch(device_,
             kernels::kd_move{.nodes = nodes_,
                              .references = references_,
                              .segments = segments_,
                              .starts = starts_,
                              .lefts = lefts,
                              .rights = rights,
                              .left_sums = left_sums,
                              .right_sums = right_sums,
                              .next_references = next_references,
                              .next_segments = next_segments,
                              .finished = finished_,
                              .finished_nodes = finished_nodes_,
                              .params = params(level.first, references_end_),
                              .constants = {.lanes = lanes()}},
             references_end_);
    references_ = next_references;
    segments_ = next_segments;
    references_end_ = next_end;
    finished_end_ += counters_now_[kd_finished];
}

/// Divides large nodes, level by level: one invocation for each reference or node.
void KdBuild::divide_large() {
    NodeRange level = levels_[0];
    while (references_end_ > 0) {
        plan_large(level);
        split_large(level);
        move_references(level);
        level = {nodes_end_, nodes_end_ + 2 * counters_now_[kd_splits]};
        if (level.size() > 0) {
            nodes_end_ = level.end;
            levels_.push_back(level);
        }
    }
}

/// Divides small nodes, level by level: one invocation for each node.
void KdBuild::divide_small() {
    const Buffer flags = allocate(nodes_end_, 4);
    const Buffer values = allocate(nodes_end_, 4);
    Buffer active = allocate(nodes_end_, 4);
    dispatch(
        device_,
        kernels::kd_small_roots{
            .nodes = nodes_, .flags = flags, .values = values, .params = params(0, nodes_end_)},
        nodes_end_);
    compact(device_, flags, values, active, {counters_, 0}, nodes_end_);
    std::uint32_t n = download_word(device_, counters_);
    const std::uint32_t candidates = kd_candidates(rules_);
    const Buffer left_masks = allocate(std::uint64_t(finished_end_) * candidates, 4);
    const Buffer right_masks = allocate(std::uint64_t(finished_end_) * candidates, 4);
    if (n > 0) {
        dispatch(device_,
                 kernels::kd_masks{.nodes = nodes_,
                                   .active_nodes = active,
                                   .finished = finished_,
                                   .elements = elements_,
                                   .left_masks = left_masks,
                                   .right_masks = right_masks,
                                   .params = params(0, n),
                                   .constants = {.lanes = lanes()}},
                 std::uint64_t(n) * kd_small);
    }
    while (n > 0) {
        choices_ = allocate(n, sizeof(KdChoice));
        split_counts_ = allocate(n, 4);
        device_.fill(counters_, 0);
        dispatch(device_,
                 kernels::kd_small_plan{.nodes = nodes_,
                                        .active_nodes = active,
                                        .finished = finished_,
                                        .elements = elements_,
                                        .choices = choices_,
                                        .split_counts = split_counts_,
                                        .counters = counters_,
                                        .cells = cells_,
                                        .left_masks = left_masks,
                                        .right_masks = right_masks,
                                        .params = params(0, n),
                                        .constants = {.lanes = lanes()}},
                 n);
        if (!may_grow()) {
            tree_.stopped = true;
            return;
        }
        grow();
        const std::uint32_t children = 2 * counters_now_[kd_splits];
        if (children == 0) {
            return;
        }
        make_room_for_nodes(children);
        exclusive_scan(device_, split_counts_, split_counts_, n);
        const Buffer next = allocate(children, 4);
        dispatch(device_,
                 kernels::kd_small_split{.nodes = nodes_,
                                         .active_nodes = active,
                                         .choices = choices_,
                                         .split_sums = split_counts_,
                                         .next_nodes = next,
                                         .cells = cells_,
                                         .params = params(0, n)},
                 n);
        levels_.push_back({nodes_end_, nodes_end_ + children});
        nodes_end_ += children;
        active = next;
        n = children;
    }
}

/// Sizes from the leaves up, places from the root down, and then all nodes at once.
void KdBuild::write() {
    for (std::size_t i = levels_.size(); i-- > 0;) {
        dispatch(
            device_,
            kernels::kd_sums{.nodes = nodes_, .params = params(levels_[i].first, levels_[i].end)},
            levels_[i].size());
    }
    const Buffer places = allocate(nodes_end_, sizeof(KdPlace));
    for (const NodeRange& level : levels_) {
        dispatch(device_,
                 kernels::kd_places{
                     .nodes = nodes_, .places = places, .params = params(level.first, level.end)},
                 level.size());
    }
    const std::uint64_t words = kd_tree_words(tree_.leaf_count, tree_.references);
    tree_.words = device_.allocate("kd-tree words", 4 * words);
    tree_.addresses = device_.allocate("kd-tree addresses", 4ull * nodes_end_);
    tree_.boxes = device_.allocate("kd-tree boxes", sizeof(BoxRecord) * nodes_end_);
    dispatch(device_,
             kernels::kd_write{.nodes = nodes_,
                               .places = places,
                               .finished = finished_,
                               .words = tree_.words,
                               .addresses = tree_.addresses,
                               .cells = cells_,
                               .boxes = tree_.boxes,
                               .params = params(0, nodes_end_)},
             nodes_end_);
    if (finished_end_ > kd_small) {
        dispatch(device_,
                 kernels::kd_write_large{.nodes = nodes_,
                                         .places = places,
                                         .finished = finished_,
                                         .finished_nodes = finished_nodes_,
                                         .words = tree_.words,
                                         .params = params(0, finished_end_)},
                 finished_end_);
    }
}

} // namespace

KdTree build_kdtree(Device& device, const Buffer& boxes, std::uint32_t count,
                    const KdTreeSettings& settings) {
    return KdBuild(device, count, settings).build(boxes);
}

HostKdTree download_kdtree(Device& device, const KdTree& tree) {
    const std::size_t nodes = 2 * std::size_t(tree.leaf_count) - 1;
    return {.words = download<std::uint32_t>(device, tree.words,
                                             kd_tree_words(tree.leaf_count, tree.references)),
            .addresses = download<std::uint32_t>(device, tree.addresses, nodes),
            .boxes = download<BoxRecord>(device, tree.boxes, nodes),
            .leaf_count = tree.leaf_count,
            .stopped = tree.stopped};
}

} // namespace argand
