#include "world/texel_trees.hpp"

#include "image/srgb.hpp"
#include "shared/frame.h"
#include "shared/texel_tree.h"
#include "shared/texture.h"
#include "world/texel_range.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <queue>

namespace argand {

namespace {

// Means are taken of so many lookups along either side of a cell.
constexpr int lookups_of_side = 4;
// A triangle's mean is at least this share of its brightest texels', so that a texel that the
// lookups have missed does not become a firefly.
constexpr double least_share = 1.0 / 16;
constexpr double most_in_vain = 0.01;

using Images = std::vector<std::shared_ptr<const TextureImage>>;

double linear_of(std::uint8_t code) { return srgb_decode(code / 255.0); }

/// The mean of the channels.
double brightness(const glm::u8vec4& texel) {
    return (linear_of(texel.r) + linear_of(texel.g) + linear_of(texel.b)) / 3;
}

/// A triangle with an emissive texture.
struct Shining {
    const TextureImage* image = nullptr;
    const TexelRange* range = nullptr;
    const Texture* texture = nullptr;
    TextureRecord record{};
    std::array<glm::vec2, 3> uvs; ///< of its vertices
    double area = 0;
    std::size_t root = 0; ///< node

    /// The place in the image, in units of its size, of a pair of numbers (sample_triangle).
    glm::vec2 place(const glm::dvec2& numbers) const {
        const glm::vec2 b = sample_triangle(glm::vec2(numbers));
        return transform_uv(record, uvs[0] * (1 - b.x - b.y) + uvs[1] * b.x + uvs[2] * b.y);
    }
    glm::dvec2 texel_at(const glm::dvec2& numbers) const {
        return glm::dvec2(place(numbers)) * glm::dvec2(image->width, image->height);
    }
    /// The linear colour at a place, as kernels filter it.
    glm::dvec3 color(const glm::vec2& place) const {
        const TexelQuad q = texel_quad(record, place);
        const auto of = [&](std::uint32_t index) {
            const auto texel = std::bit_cast<glm::u8vec4>(image->texels[index]);
            return glm::vec4(linear_of(texel.r), linear_of(texel.g), linear_of(texel.b), 1);
        };
        return glm::dvec3(interpolate(q, of(q.t00), of(q.t10), of(q.t01), of(q.t11)));
    }
};

struct Node {
    std::size_t children = 0; ///< the first of two; 0: a leaf
    std::uint32_t axis = 0;
    double weight = 0; ///< its area in numbers times the brightness of its brightest texel
};

struct Cell {
    std::size_t triangle = 0, node = 0;
    glm::dvec2 low{0}, size{1};
    std::uint32_t level = 0;
    std::uint32_t axis = 0; ///< along which it shows more texels
    double vain = 0; ///< of the power of a triangle whose texels are white: the most chosen in vain
    bool operator<(const Cell& other) const { return vain < other.vain; }
};

class TreeBuilder {
public:
    TreeBuilder(const Scene& scene, const Images& images, const std::vector<TextureRecord>& records)
        : scene_(scene), images_(images), records_(records) {}

    TexelTrees build(std::vector<std::uint32_t>& words);

private:
    void add_triangle(std::uint32_t index, const Material& material);
    void add_cell(Cell cell);
    void halve(const Cell& cell);
    void halve_all();
    glm::dvec3 mean_color(const Cell& leaf) const;
    std::vector<TexelMean> means() const;

    const Scene& scene_;
    const Images& images_;
    const std::vector<TextureRecord>& records_;
    std::map<const TextureImage*, TexelRange> ranges_;
    std::vector<Shining> shining_;
    std::vector<std::uint32_t> triangles_;
    std::vector<Node> nodes_;
    std::priority_queue<Cell> cells_;
    std::vector<Cell> leaves_; ///< that cannot be halved
    double power_ = 0, vain_ = 0;
};

void TreeBuilder::add_triangle(std::uint32_t index, const Material& material) {
    const std::size_t in_list =
        material.first_texture + static_cast<std::size_t>(std::popcount(
                                     material.texture_bits & (material_emissive_texture - 1)));
    Shining shining;
    shining.texture = &scene_.textures[in_list];
    shining.image = images_[shining.texture->image].get();
    shining.range = &ranges_.try_emplace(shining.image, *shining.image).first->second;
    shining.record = records_[in_list];
    for (int corner = 0; corner < 3; ++corner) {
        const std::size_t vertex = scene_.triangles[index][corner];
        shining.uvs[std::size_t(corner)] =
            scene_.uvs[vertex * scene_.uv_sets + shining.texture->uv_set];
    }
    shining.area = area(scene_, index);
    shining.root = nodes_.size();
    nodes_.emplace_back();
    triangles_.push_back(index);
    shining_.push_back(shining);
    add_cell({.triangle = shining_.size() - 1, .node = shining.root});
}

/// Finds how bright a cell is, and adds it to those that may be halved.
void TreeBuilder::add_cell(Cell cell) {
    const Shining& of = shining_[cell.triangle];
    // It shows a quadrilateral of the image, with these corners.
    const glm::dvec2 high = cell.low + cell.size;
    const std::array<glm::dvec2, 4> corners{of.texel_at(cell.low),
                                            of.texel_at({high.x, cell.low.y}),
                                            of.texel_at({cell.low.x, high.y}), of.texel_at(high)};
    glm::dvec2 from = corners[0];
    glm::dvec2 to = corners[0];
    for (const glm::dvec2& corner : corners) {
        from = glm::min(from, corner);
        to = glm::max(to, corner);
    }
    const TexelRange::Range range = of.range->within(from, to, *of.texture);
    const double share = cell.size.x * cell.size.y;
    const double bright = brightness(range.high);
    nodes_[cell.node].weight = share * bright;
    cell.vain = of.area * share * (bright - brightness(range.low));
    power_ += of.area * share * bright;
    vain_ += cell.vain;
    const double along_x =
        std::max(glm::distance(corners[0], corners[1]), glm::distance(corners[2], corners[3]));
    const double along_y =
        std::max(glm::distance(corners[0], corners[2]), glm::distance(corners[1], corners[3]));
    cell.axis = along_x >= along_y ? 0 : 1;
    const bool fine = !(std::max(along_x, along_y) > 0.25) || cell.level + 1 >= most_texel_levels;
    if (fine) {
        leaves_.push_back(cell);
    } else {
        cells_.push(cell);
    }
}

void TreeBuilder::halve(const Cell& cell) {
    const std::size_t children = nodes_.size();
    nodes_.resize(children + 2);
    nodes_[cell.node].children = children;
    nodes_[cell.node].axis = cell.axis;
    power_ -= shining_[cell.triangle].area * nodes_[cell.node].weight;
    vain_ -= cell.vain;
    for (std::size_t upper = 0; upper < 2; ++upper) {
        Cell half = cell;
        half.node = children + upper;
        ++half.level;
        const int axis = static_cast<int>(cell.axis);
        half.size[axis] /= 2;
        half.low[axis] += upper == 1 ? half.size[axis] : 0;
        add_cell(half);
    }
}

void TreeBuilder::halve_all() {
    // All triangles whose tree is one leaf share it.
    constexpr std::size_t most_nodes = most_texel_tree_words / words_of_texel_node - 1;
    std::size_t used = 0; // nodes, each root among them
    while (!cells_.empty() && used + 3 <= most_nodes && vain_ > most_in_vain * power_ &&
           cells_.top().vain > 0) {
        const Cell cell = cells_.top();
        cells_.pop();
        used += cell.level == 0 ? 3 : 2;
        halve(cell);
    }
    for (; !cells_.empty(); cells_.pop()) {
        leaves_.push_back(cells_.top());
    }
    // Children come behind their parents.
    for (std::size_t i = nodes_.size(); i-- > 0;) {
        Node& node = nodes_[i];
        if (node.children != 0) {
            node.weight = nodes_[node.children].weight + nodes_[node.children + 1].weight;
        }
    }
}

glm::dvec3 TreeBuilder::mean_color(const Cell& leaf) const {
    const Shining& of = shining_[leaf.triangle];
    const int side = leaf.vain > 0 || of.image->texels.size() > 1 ? lookups_of_side : 1;
    glm::dvec3 sum(0);
    for (int i = 0; i < side * side; ++i) {
        const int column = i % side, row = i / side;
        const glm::dvec2 inside((column + 0.5) / side, (row + 0.5) / side);
        sum += of.color(of.place(leaf.low + leaf.size * inside));
    }
    return sum / double(side * side);
}

std::vector<TexelMean> TreeBuilder::means() const {
    std::vector<glm::dvec3> colors(shining_.size(), glm::dvec3(0));
    for (const Cell& leaf : leaves_) {
        if (nodes_[leaf.node].weight > 0) {
            colors[leaf.triangle] += leaf.size.x * leaf.size.y * mean_color(leaf);
        }
    }
    std::vector<TexelMean> result;
    result.reserve(shining_.size());
    for (std::size_t i = 0; i < shining_.size(); ++i) {
        const double least = least_share * nodes_[shining_[i].root].weight;
        const double mean = (colors[i].r + colors[i].g + colors[i].b) / 3;
        const glm::vec3 color(mean >= least ? colors[i]
                              : mean > 0    ? colors[i] * (least / mean)
                                            : glm::dvec3(least));
        result.push_back({color.r, color.g, color.b, 0});
    }
    return result;
}

TexelTrees TreeBuilder::build(std::vector<std::uint32_t>& words) {
    for (std::uint32_t i = 0; i < scene_.triangles.size(); ++i) {
        const Material& material = scene_.materials[scene_.triangle_material[i]];
        if ((material.texture_bits & material_emissive_texture) != 0) {
            add_triangle(i, material);
        }
    }
    halve_all();
    const auto first = static_cast<std::uint32_t>(words.size());
    words.insert(words.end(), words_of_texel_node, 0u); // the leaf that triangles share
    std::vector<std::uint32_t> place(nodes_.size(), first);
    const auto give_place = [&](std::size_t node) {
        place[node] = static_cast<std::uint32_t>(words.size());
        words.insert(words.end(), words_of_texel_node, 0u);
    };
    for (const Shining& shining : shining_) {
        if (nodes_[shining.root].children != 0) {
            give_place(shining.root);
        }
    }
    for (const Node& node : nodes_) {
        if (node.children != 0) {
            give_place(node.children);
            give_place(node.children + 1);
        }
    }
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
        const Node& node = nodes_[i];
        if (node.children != 0) {
            const double share = node.weight > 0 ? nodes_[node.children].weight / node.weight : 0.5;
            words[place[i]] = 2 * place[node.children] + node.axis;
            words[place[i] + 1] = std::bit_cast<std::uint32_t>(static_cast<float>(share));
        }
    }
    TexelTrees trees{std::move(triangles_), means()};
    for (std::size_t i = 0; i < shining_.size(); ++i) {
        trees.means[i].root = place[shining_[i].root];
    }
    return trees;
}

} // namespace

TexelMean mean_of(const TexelTrees& trees, std::uint32_t triangle) {
    const auto found = std::lower_bound(trees.triangles.begin(), trees.triangles.end(), triangle);
    if (found == trees.triangles.end() || *found != triangle) {
        return {1, 1, 1, 0};
    }
    return trees.means[static_cast<std::size_t>(found - trees.triangles.begin())];
}

TexelTrees make_texel_trees(const Scene& scene, const Images& images,
                            const std::vector<TextureRecord>& records,
                            std::vector<std::uint32_t>& words) {
    return TreeBuilder(scene, images, records).build(words);
}

} // namespace argand
