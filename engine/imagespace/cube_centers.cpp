#include "imagespace/cube_centers.hpp"

#include "kernels/cube_areas.hpp"
#include "kernels/cube_cover.hpp"
#include "kernels/cube_points.hpp"
#include "shared/cube_map.h"
#include "shared/image_space_records.h"
#include "shared/random.h"

#include <algorithm>
#include <optional>

namespace argand {

namespace {

// Rounds of adding one and dropping one. They end where one adds hardly more than the one that it
// would replace: else two candidates may take turns.
constexpr std::uint32_t most_rounds = 16;
constexpr double least_progress = 1e-3;

/// The candidates, and what the chosen ones of them see.
class Candidates {
public:
    Candidates(Device& device, const DeviceScene& scene, const CubeMaps& maps,
               std::span<const glm::vec4> points)
        : device_(device), scene_(scene), maps_(maps),
          points_(
              upload(device, "points for cube maps", std::vector(points.begin(), points.end()))),
          point_count_(points.size()),
          masks_(device.allocate("masks of cube maps", seen_count() * sizeof(std::uint32_t))),
          records_(
              device.allocate("candidates for cube maps", maps_.count * sizeof(CubeCandidate))),
          inverse_unit_(units / std::max(1e-30, double(scene.record.radius) * scene.record.radius)),
          bits_(maps_.count, 0) {
        device.fill(masks_, 0);
        if (point_count_ > 0) {
            device.fill(BufferView(masks_, texel_count() * sizeof(std::uint32_t),
                                   point_count_ * sizeof(std::uint32_t)),
                        unseen_by_any);
        }
        measure();
        const auto faces_front = [](const CubeCandidate& c) { return 2 * c.back <= c.seen; };
        const bool some = std::any_of(measured_.begin(), measured_.end(), faces_front);
        for (const CubeCandidate& c : measured_) {
            usable_.push_back(c.seen > 0 && (!some || faces_front(c)));
        }
    }

    /// The candidate that is not chosen and shows the most.
    std::optional<std::size_t> best() const {
        std::optional<std::size_t> best;
        for (std::size_t i = 0; i < usable_.size(); ++i) {
            if (usable_[i] && bits_[i] == 0 && gain(i) > (best ? gain(*best) : 0)) {
                best = i;
            }
        }
        return best;
    }

    /// What a candidate shows and no chosen one but itself does: the mean of its share of the area
    /// and of its share of the points.
    double gain(std::size_t candidate) const {
        const CubeCandidate& c = measured_[candidate];
        const double points = point_count_ > 0 ? c.points / static_cast<double>(point_count_) : 0;
        return (gain_of_area(candidate) + points) / 2;
    }

    /// The area that a candidate shows and no chosen one but itself does, over that which the
    /// chosen ones and this one show.
    double gain_of_area(std::size_t candidate) const {
        const double area = area_of(measured_[candidate]);
        return area > 0 ? area / (shown_area_ + (bits_[candidate] != 0 ? 0 : area)) : 0;
    }

    /// Of each point the bits of the chosen candidates that see it, or unseen_by_any.
    std::vector<std::uint32_t> point_masks() const {
        return download<std::uint32_t>(device_, masks_, point_count_, texel_count());
    }

    /// Share of the points that some candidate sees and no chosen one does.
    double missing() const { return missing_of(point_masks()); }

    static double missing_of(const std::vector<std::uint32_t>& masks) {
        const auto missed = std::count(masks.begin(), masks.end(), 0u);
        const auto seen = std::count_if(masks.begin(), masks.end(), [](std::uint32_t mask) {
            return (mask & unseen_by_any) == 0;
        });
        return seen > 0 ? static_cast<double>(missed) / static_cast<double>(seen) : 0;
    }

    void choose(std::size_t candidate) {
        shown_area_ += area_of(measured_[candidate]);
        std::uint32_t used = 0;
        for (const std::uint32_t bit : bits_) {
            used |= bit;
        }
        bits_[candidate] = ~used & (used + 1); // the lowest that is free
        cover(static_cast<std::uint32_t>(candidate), bits_[candidate]);
        measure();
    }

    void drop(std::size_t candidate) {
        shown_area_ -= area_of(measured_[candidate]);
        cover(maps_.count, bits_[candidate]);
        bits_[candidate] = 0;
        measure();
    }

private:
    // Of areas, in the square of the scene's radius.
    static constexpr double units = 1 << 20;

    static double area_of(const CubeCandidate& c) {
        return c.area_low + 4294967296.0 * c.area_high;
    }

    std::uint64_t texel_count() const {
        return std::uint64_t(maps_.count) * cube_texels(maps_.size);
    }
    std::uint64_t seen_count() const { return texel_count() + point_count_; }

    CubeCoverage params() const {
        return {.maps = maps_.count,
                .size = maps_.size,
                .map = 0,
                .bit = 0,
                .inverse_unit = static_cast<float>(inverse_unit_),
                .points = static_cast<std::uint32_t>(point_count_),
                .pad0 = 0,
                .pad1 = 0};
    }

    /// Gives the bit to the places that the map sees; none for no map.
    void cover(std::uint32_t map, std::uint32_t bit) {
        CubeCoverage p = params();
        p.map = map;
        p.bit = bit;
        dispatch(device_,
                 kernels::cube_cover{.cube = cube_bindings(scene_, maps_),
                                     .masks = masks_,
                                     .points = points_,
                                     .params = p},
                 seen_count());
    }

    void measure() {
        std::vector<CubeCandidate> records(maps_.count, CubeCandidate{});
        for (std::size_t i = 0; i < records.size(); ++i) {
            records[i].ignored = bits_[i];
        }
        device_.upload(records_, 0, std::as_bytes(std::span(records)));
        dispatch(device_,
                 kernels::cube_areas{.cube = cube_bindings(scene_, maps_),
                                     .masks = masks_,
                                     .candidates = records_,
                                     .params = params()},
                 texel_count() / texels_per_area);
        dispatch(device_,
                 kernels::cube_points{.cube = cube_bindings(scene_, maps_),
                                      .masks = masks_,
                                      .points = points_,
                                      .candidates = records_,
                                      .params = params()},
                 maps_.count * point_count_);
        measured_ = download<CubeCandidate>(device_, records_, maps_.count);
    }

    Device& device_;
    const DeviceScene& scene_;
    const CubeMaps& maps_;
    Buffer points_;
    std::size_t point_count_;
    Buffer masks_, records_;
    double inverse_unit_;
    double shown_area_ = 0;           ///< by the chosen ones
    std::vector<std::uint32_t> bits_; ///< of each candidate; 0: it is not chosen
    std::vector<CubeCandidate> measured_;
    std::vector<bool> usable_;
};

/// The points that no candidate sees.
std::vector<std::size_t> unseen_of(const std::vector<std::uint32_t>& masks) {
    std::vector<std::size_t> unseen;
    for (std::size_t i = 0; i < masks.size(); ++i) {
        if ((masks[i] & unseen_by_any) != 0) {
            unseen.push_back(i);
        }
    }
    return unseen;
}

/// Chooses greedily. Returns the candidates.
std::vector<std::size_t> choose_greedily(Candidates& all, std::size_t fixed,
                                         const CenterSettings& settings) {
    std::vector<std::size_t> chosen;
    const auto choose = [&](std::size_t candidate) {
        chosen.push_back(candidate);
        all.choose(candidate);
    };
    for (std::size_t i = 0; i < fixed; ++i) {
        choose(i);
    }
    for (std::optional<std::size_t> best = all.best();
         best && chosen.size() < settings.most &&
         (chosen.size() < settings.least || all.missing() > 1 - settings.coverage ||
          all.gain_of_area(*best) > 1 - settings.coverage);
         best = all.best()) {
        choose(*best);
    }
    return chosen;
}

/// Adds the best candidate and drops the least useful of all, once. Returns whether that has
/// changed the choice.
bool update(Candidates& all, std::size_t fixed, std::vector<std::size_t>& chosen) {
    const std::optional<std::size_t> best = all.best();
    if (!best || chosen.size() == fixed) {
        return false;
    }
    const double gained = all.gain(*best);
    all.choose(*best);
    chosen.push_back(*best);
    auto least =
        std::min_element(chosen.begin() + static_cast<std::ptrdiff_t>(fixed), chosen.end(),
                         [&](std::size_t a, std::size_t b) { return all.gain(a) < all.gain(b); });
    if (gained - all.gain(*least) <= least_progress) {
        least = chosen.end() - 1;
    }
    const std::size_t dropped = *least;
    all.drop(dropped);
    chosen.erase(least);
    return dropped != *best;
}

} // namespace

ChosenCenters choose_centers(Device& device, const DeviceScene& scene, const CubeMaps& candidates,
                             std::size_t fixed, std::span<const glm::vec4> points,
                             const CenterSettings& settings) {
    const StageScope stage(device, "choose cube maps");
    Candidates all(device, scene, candidates, points);
    ChosenCenters result;
    result.candidates = choose_greedily(all, fixed, settings);
    while (result.rounds < most_rounds && update(all, fixed, result.candidates)) {
        ++result.rounds;
    }
    const std::vector<std::uint32_t> masks = all.point_masks();
    result.missing = Candidates::missing_of(masks);
    result.unseen = unseen_of(masks);
    return result;
}

std::vector<std::size_t> unseen_points(Device& device, const DeviceScene& scene,
                                       const CubeMaps& maps, std::span<const glm::vec4> points) {
    return unseen_of(Candidates(device, scene, maps, points).point_masks());
}

std::vector<glm::vec3> random_centers(const Bounds& box, std::uint32_t count, std::uint32_t seed) {
    std::vector<glm::vec3> centers;
    for (std::uint32_t i = 0; i < count; ++i) {
        const glm::vec4 u = random4(seed, i, 0, 0xce97e5u);
        centers.push_back(box.low + (box.high - box.low) * glm::vec3(u));
    }
    return centers;
}

} // namespace argand
