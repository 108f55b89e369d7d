#include "world/aim_tree.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <queue>
#include <utility>

namespace argand {

namespace {

// Boxes are cut at multiples of this part of their size.
constexpr std::size_t bins = 32;
constexpr std::size_t most_leaves = (most_aim_nodes + 1) / 2;
// A box with fewer samples is not divided.
constexpr std::size_t least_samples = 8;
// Samples that are taken to be spread evenly over each box, besides those found in it.
constexpr double unseen_samples = 2;
// A box is divided if that reduces the spread of all boxes by this part.
constexpr double least_gain = 0.002;
// Smaller boxes are not divided: photons' flux, which is in proportion, is kept in fixed point.
constexpr double least_volume = 1e-6;
// Of a node's photons, spread evenly over the node.
constexpr double even_share_of_node = 0.2;

struct Box {
    std::uint32_t node = 0;
    std::span<AimSample> samples; ///< in coordinates of the box
    double volume = 1, weight = 0;
    std::uint32_t level = 0;
};

/// Where a box may be divided.
struct Cut {
    double gain = 0;
    int axis = 0;
    std::size_t bin = 0;
};

struct Candidate {
    Box box;
    Cut cut;

    bool operator<(const Candidate& other) const { return cut.gain < other.cut.gain; }
};

/// How far light is spread over a box: the standard deviation of an estimate of it, if the density
/// of samples were even here and best elsewhere.
double spread(double volume, double weight) { return std::sqrt(volume * weight); }

double weight_of(std::span<const AimSample> samples) {
    double sum = 0;
    for (const AimSample& s : samples) {
        sum += s.weight;
    }
    return sum;
}

Cut best_cut(const Box& box, int first_axis) {
    Cut best;
    if (box.samples.size() < least_samples || box.volume < least_volume ||
        box.level == most_aim_levels) {
        return best;
    }
    const double unseen = unseen_samples * box.weight / static_cast<double>(box.samples.size());
    const double whole = spread(box.volume, box.weight + unseen);
    for (int axis = first_axis; axis < 4; ++axis) {
        std::array<double, bins> weights{};
        for (const AimSample& s : box.samples) {
            const auto bin = static_cast<std::size_t>(std::max(s.u[axis], 0.0) * bins);
            weights[std::min(bin, bins - 1)] += s.weight;
        }
        double lower = 0;
        for (std::size_t bin = 1; bin < bins; ++bin) {
            lower += weights[bin - 1];
            const double part = static_cast<double>(bin) / bins;
            const double upper = std::max(box.weight - lower, 0.0);
            const double gain = whole - spread(box.volume * part, lower + unseen * part) -
                                spread(box.volume * (1 - part), upper + unseen * (1 - part));
            if (gain > best.gain) {
                best = {.gain = gain, .axis = axis, .bin = bin};
            }
        }
    }
    return best;
}

/// Divides the box, and its samples, into its node's children.
std::pair<Box, Box> divide(const Box& box, const Cut& cut, std::vector<AimNode>& nodes) {
    const double at = static_cast<double>(cut.bin) / bins;
    const auto upper_begin = std::partition(box.samples.begin(), box.samples.end(),
                                            [&](const AimSample& s) { return s.u[cut.axis] < at; });
    for (AimSample& s : box.samples) {
        double& u = s.u[cut.axis];
        u = u < at ? u / at : (u - at) / (1 - at);
    }
    const auto child = static_cast<std::uint32_t>(nodes.size());
    nodes[box.node] = {static_cast<std::uint32_t>(cut.axis), child, static_cast<float>(at), 0};
    nodes.resize(nodes.size() + 2, {aim_leaf, 0, 0, 0});
    Box lower = box;
    Box upper = box;
    lower.level = upper.level = box.level + 1;
    lower.node = child;
    upper.node = child + 1;
    lower.samples = std::span(box.samples.begin(), upper_begin);
    upper.samples = std::span(upper_begin, box.samples.end());
    lower.volume = box.volume * at;
    upper.volume = box.volume * (1 - at);
    lower.weight = weight_of(lower.samples);
    upper.weight = weight_of(upper.samples);
    return {lower, upper};
}

/// Sets the nodes' shares. weights: of the nodes, which for leaves are known.
void set_shares(std::vector<AimNode>& nodes, std::vector<double> weights) {
    for (std::size_t i = nodes.size(); i-- > 0;) {
        if (nodes[i].axis != aim_leaf) {
            weights[i] = weights[nodes[i].child] + weights[nodes[i].child + 1];
        }
    }
    struct Part {
        double volume, learnt;
        double share() const { return aim_even_share * volume + (1 - aim_even_share) * learnt; }
    };
    std::vector<Part> parts(nodes.size(), {1, 1});
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        AimNode& node = nodes[i];
        if (node.axis == aim_leaf) {
            continue;
        }
        const double even = node.cut;
        const double found = weights[i] > 0 ? weights[node.child] / weights[i] : even;
        const double learnt = even_share_of_node * even + (1 - even_share_of_node) * found;
        Part& lower = parts[node.child];
        lower = {parts[i].volume * even, parts[i].learnt * learnt};
        parts[node.child + 1] = {parts[i].volume * (1 - even), parts[i].learnt * (1 - learnt)};
        node.share = static_cast<float>(lower.share() / parts[i].share());
    }
}

} // namespace

std::vector<AimNode> make_aim_tree(std::span<const AimSample> samples, int first_axis) {
    std::vector<AimSample> sorted(samples.begin(), samples.end());
    std::vector<AimNode> nodes(1, {aim_leaf, 0, 0, 0});
    nodes.reserve(2 * most_leaves);
    Box all;
    all.samples = sorted;
    all.weight = weight_of(sorted);
    double left = spread(1, all.weight);
    std::priority_queue<Candidate> queue;
    queue.push({all, best_cut(all, first_axis)});
    std::vector<double> weights(2 * most_leaves, 0.0);
    while (!queue.empty()) {
        const auto [box, cut] = queue.top();
        queue.pop();
        weights[box.node] = box.weight;
        if (!(cut.gain > least_gain * left) || nodes.size() + 2 > 2 * most_leaves) {
            continue;
        }
        left -= cut.gain;
        const auto [lower, upper] = divide(box, cut, nodes);
        queue.push({lower, best_cut(lower, first_axis)});
        queue.push({upper, best_cut(upper, first_axis)});
    }
    set_shares(nodes, std::move(weights));
    return nodes;
}

bool is_aim_tree(std::span<const AimNode> nodes) {
    std::vector<std::uint32_t> levels(nodes.size(), 0);
    const auto inside = [](float part) { return part > 0 && part < 1; };
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        const AimNode& node = nodes[i];
        if (node.axis == aim_leaf) {
            continue;
        }
        if (node.axis > aim_leaf || node.child <= i || node.child >= nodes.size() - 1 ||
            levels[i] >= most_aim_levels || !inside(node.cut) || !inside(node.share)) {
            return false;
        }
        levels[node.child] = levels[node.child + 1] = levels[i] + 1;
    }
    return !nodes.empty();
}

} // namespace argand
