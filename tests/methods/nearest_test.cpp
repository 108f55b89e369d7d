// Density estimation over the k nearest photons: the photons found, against nanoflann, and the sum
// over them, against double precision.
#include "rendering.hpp"

#include "photon/map_queries.hpp"
#include "photon/nearest.hpp"
#include "shared/nearest_records.h"
#include "shared/photon.h"
#include "world/world.hpp"

#include <algorithm>
#include <cmath>
#include <nanoflann.hpp>
#include <random>

namespace argand::testing {
namespace {

constexpr float floor_albedo = 0.5f;
constexpr std::uint32_t ks[] = {1, 2, 3, 150, 499, 500};
// Of queries of the caustic part alone.
constexpr std::uint32_t caustic_k = 20;
constexpr float caustic_radius = 0.3f;

/// The bits of a photon's squared distance, and its index in the map.
struct Neighbour {
    std::uint32_t bits, index;
    auto operator<=>(const Neighbour&) const = default;
};

struct Answer {
    Gathered sums;
    NearestRecord state;
};

struct Answers {
    std::vector<PhotonRecord> photons; // in the order of the map
    std::vector<Answer> of;
    bool finished = true;
};

struct Points {
    const std::vector<PhotonRecord>& photons;
    std::size_t kdtree_get_point_count() const { return photons.size(); }
    float kdtree_get_pt(std::size_t i, std::size_t axis) const {
        return axis == 0 ? photons[i].x : axis == 1 ? photons[i].y : photons[i].z;
    }
    template <class Box> bool kdtree_get_bbox(Box&) const { return false; }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<float, Points>,
                                                 Points, 3, std::uint32_t>;

/// A result set for nanoflann: the first k photons on the query's surface, ordered by distance in
/// its flattened ball, then by index. That distance is never less than the Euclidean one, by which
/// nanoflann prunes.
class OnSurface {
public:
    OnSurface(const std::vector<PhotonRecord>& photons, const Query& query, std::size_t k,
              float radius)
        : photons_(photons), query_(query), normal_(unpack_unit(pack_unit(query.normal))),
          own_(pack_photon_normal(normal_, false)), k_(k), limit_(float_bits(radius * radius)) {}

    bool addPoint(float, std::uint32_t index) {
        const PhotonRecord& p = photons_[index];
        const glm::vec3 d = glm::vec3(p.x, p.y, p.z) - query_.position;
        const float height = dot3(d, normal_);
        const std::uint32_t bits = float_bits(dot3(d, d) + nearest_stretch * (height * height));
        const vec3 normal = unpack_photon_normal(p.normal);
        const bool flat = (p.normal & photon_normal_mask) == own_;
        const float along_sum = height + (flat ? height : dot3(d, normal));
        const vec3 turned = flat ? vec3(0) : normal - normal_;
        const float tolerance2 = std::min(flat_tolerance * flat_tolerance + dot3(turned, turned),
                                          chord_tolerance * chord_tolerance);
        const float rounding = max_component(abs(query_.position)) * position_rounding;
        const float excess = std::max(std::abs(along_sum) - rounding, 0.0f);
        const bool same_side = (flat || dot3(normal, normal_) >= same_surface_cosine) &&
                               excess * excess <= tolerance2 * dot3(d, d);
        if ((p.normal & area_sample_bit) == 0 && bits < limit_ && same_side) {
            found_.push_back({bits, index});
            std::push_heap(found_.begin(), found_.end());
            if (found_.size() > k_) {
                std::pop_heap(found_.begin(), found_.end());
                found_.pop_back();
            }
        }
        return true;
    }
    float worstDist() const {
        const std::uint32_t bits = found_.size() == k_ ? found_.front().bits : limit_;
        return bits_float(bits) * 1.0001f + 1e-37f; // those as far as the k-th, too
    }
    bool full() const { return found_.size() == k_; }
    std::size_t size() const { return found_.size(); }
    std::vector<Neighbour> sorted() {
        std::sort_heap(found_.begin(), found_.end());
        return found_;
    }

private:
    const std::vector<PhotonRecord>& photons_;
    const Query& query_;
    glm::vec3 normal_;
    std::uint32_t own_;
    std::size_t k_;
    std::uint32_t limit_;
    std::vector<Neighbour> found_;
};

class GatherNearest : public RenderTest {
protected:
    GatherNearest() : random_(7) {}

    float uniform(float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random_);
    }

    PhotonRecord photon(glm::vec3 position, bool caustic = false, glm::vec3 normal = {0, 1, 0}) {
        return {position.x,       position.y,
                position.z,       pack_photon_normal(normal, caustic),
                uniform(0.1f, 1), uniform(0.1f, 1),
                uniform(0.1f, 1), pack_unit({0, 1, 0})};
    }

    std::vector<PhotonRecord> floor_photons(std::size_t count) {
        std::vector<PhotonRecord> photons;
        for (std::size_t i = 0; i < count; ++i) {
            photons.push_back(photon({uniform(-1, 1), 0, uniform(-1, 1)}, i % 3 == 0));
        }
        return photons;
    }

    std::vector<Query> floor_queries(std::size_t count) {
        std::vector<Query> queries;
        for (std::size_t i = 0; i < count; ++i) {
            queries.push_back({{uniform(-1, 1), 0, uniform(-1, 1)}});
        }
        return queries;
    }

    Answers gather(Device& on, const std::vector<PhotonRecord>& photons,
                   const std::vector<Query>& queries, std::uint32_t k, float radius,
                   std::uint32_t budget = gather_budget, bool careful = true,
                   std::uint64_t area_samples = 0, std::uint32_t part = map_whole) {
        const DeviceScene scene =
            upload_scene(on, floor_scene(lambertian(glm::vec3(floor_albedo)), 1),
                         make_plan({}, {.everything = true}));
        PhotonWorkspace workspace = make_photon_workspace(on, photons.size() + area_samples);
        const PhotonMap map = build_photon_map(on, scene, workspace, store(on, workspace, photons),
                                               {.area_samples = area_samples});
        Answers answers;
        NearestEstimator estimator(on, scene.plan,
                                   {.neighbours = k,
                                    .radius = radius,
                                    .samples_per_area = map.area_samples / scene.surface_area,
                                    .caustic_neighbours = caustic_k,
                                    .caustic_radius = caustic_radius},
                                   budget);
        const std::vector<Gathered> sums =
            testing::answers(on, estimator, map, queries, {.until_complete = careful, .part = part},
                             answers.finished);
        std::vector<NearestRecord> states(queries.size());
        if (careful) {
            states = download<NearestRecord>(on, estimator.states(), queries.size());
        }
        for (std::size_t i = 0; i < queries.size(); ++i) {
            answers.of.push_back({sums[i], states[i]});
        }
        answers.photons = download<PhotonRecord>(
            on, map.photons, download<std::uint32_t>(on, map.counters, 1, counter_stored)[0]);
        return answers;
    }

    /// Expects nanoflann's k neighbours, the distance of the k-th equal to the bit, and an estimate
    /// equal to the kernel's sum over them.
    void expect_nearest(const Answers& answers, const std::vector<Query>& queries, std::uint32_t k,
                        float radius) {
        const Points points{answers.photons};
        const Tree tree(3, points, nanoflann::KDTreeSingleIndexAdaptorParams(10));
        for (std::size_t i = 0; i < queries.size(); ++i) {
            OnSurface found(answers.photons, queries[i], k, radius);
            if (!answers.photons.empty()) {
                tree.findNeighbors(found, &queries[i].position.x, nanoflann::SearchParams());
            }
            const std::vector<Neighbour> expected = found.sorted();
            const NearestRecord& state = answers.of[i].state;
            ASSERT_EQ(state.phase, nearest_done);
            if (expected.size() == k) {
                EXPECT_EQ(state.low, expected.back().bits) << i;
                EXPECT_EQ(state.last, expected.back().index) << i;
            } else {
                EXPECT_EQ(state.low, float_bits(radius * radius)) << i;
                EXPECT_EQ(state.last, nearest_none) << i;
            }
            const double least = std::max(double(nearest_least) * nearest_least * radius * radius,
                                          double(nearest_least_square));
            const double r2 = std::max<double>(bits_float(state.low), least);
            glm::dvec3 indirect(0);
            glm::dvec3 caustic(0);
            glm::dvec3 without_kernel(0);
            for (const Neighbour& neighbour : expected) {
                const PhotonRecord& p = answers.photons[neighbour.index];
                const glm::dvec3 term = 2 / (double(pi) * r2) * floor_albedo / double(pi) *
                                        glm::dvec3(p.flux_r, p.flux_g, p.flux_b);
                (photon_is_caustic(p.normal) ? caustic : indirect) +=
                    term * (1 - bits_float(neighbour.bits) / r2);
                without_kernel += term;
            }
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(answers.of[i].sums.indirect[c], indirect[c], 2e-6 * without_kernel[c])
                    << i;
                EXPECT_NEAR(answers.of[i].sums.caustic[c], caustic[c], 2e-6 * without_kernel[c])
                    << i;
            }
        }
    }

    std::mt19937 random_;
};

TEST_F(GatherNearest, AreNanoflannsAtEverySize) {
    for (const std::size_t count : {0u, 1u, 2u, 7u, 65u, 999u, 30'001u}) {
        const std::vector<PhotonRecord> photons = floor_photons(count);
        const std::vector<Query> queries = floor_queries(count > 10'000 ? 200 : 33);
        for (const std::uint32_t k : ks) {
            for (const float radius : {0.05f, 0.4f, 5.0f}) {
                SCOPED_TRACE(::testing::Message() << k << " of " << count << " within " << radius);
                expect_nearest(gather(device(), photons, queries, k, radius), queries, k, radius);
            }
        }
    }
}

TEST_F(GatherNearest, OnCurvedSurfacesAndInCorners) {
    std::vector<PhotonRecord> photons;
    std::vector<Query> queries;
    for (int i = 0; i < 20'000; ++i) {
        const glm::vec3 n =
            glm::normalize(glm::vec3(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)) + 1e-3f);
        photons.push_back(photon(0.5f * n, i % 4 == 0, n));
        photons.push_back(photon({uniform(-1, 1), -0.5f, uniform(-1, 1)}));
        if (i % 100 == 0) {
            queries.push_back({0.5f * n, n});
            queries.push_back({{n.x, -0.5f, n.z}});
        }
    }
    for (const std::uint32_t k : ks) {
        SCOPED_TRACE(k);
        expect_nearest(gather(device(), photons, queries, k, 0.6f), queries, k, 0.6f);
    }
}

TEST_F(GatherNearest, EqualDistancesGoByTheOrderOfTheMap) {
    std::vector<PhotonRecord> photons;
    for (int i = 0; i < 64 * 64; ++i) {
        for (int copy = 0; copy < 3; ++copy) {
            photons.push_back(
                photon({float(i % 64 - 32) / 32, 0, float(i / 64 - 32) / 32}, copy == 0));
        }
    }
    const std::vector<Query> queries{
        {{0, 0, 0}}, {{1.0f / 64, 0, 0}}, {{1.0f / 64, 0, 1.0f / 64}}, {{-1, 0, -1}}};
    for (const std::uint32_t k : {1u, 2u, 3u, 4u, 7u, 12u, 13u, 100u, 500u}) {
        SCOPED_TRACE(k);
        expect_nearest(gather(device(), photons, queries, k, 0.8f), queries, k, 0.8f);
    }
}

TEST_F(GatherNearest, OneAndTwoInOnePoint) {
    const std::vector<Query> queries{{{0.25f, 0, -0.5f}}, {{0.2f, 0, -0.5f}}, {{-0.9f, 0, 0.9f}}};
    for (const int n : {1, 2}) {
        const std::vector<PhotonRecord> photons(static_cast<std::size_t>(n),
                                                photon({0.25f, 0, -0.5f}));
        for (const std::uint32_t k : {1u, 2u, 500u}) {
            SCOPED_TRACE(std::to_string(n) + ", " + std::to_string(k));
            const Answers answers = gather(device(), photons, queries, k, 0.1f);
            expect_nearest(answers, queries, k, 0.1f);
            // A disc needs a radius: k photons at the query's own point have none.
            for (const Answer& answer : answers.of) {
                EXPECT_TRUE(std::isfinite(answer.sums.indirect.g));
            }
        }
    }
}

// The sums that tell it have equal weights.
TEST_F(GatherNearest, TellsHowUnevenLightIs) {
    std::vector<PhotonRecord> even, half;
    for (int i = 0; i < 20'000; ++i) {
        PhotonRecord p = photon({uniform(-1, 1), 0, uniform(-1, 1)});
        p.flux_r = p.flux_g = p.flux_b = 1;
        even.push_back(p);
        if (p.x > 0) {
            half.push_back(p);
        }
    }
    const auto uneven = [&](const std::vector<PhotonRecord>& photons, glm::vec3 at,
                            std::uint64_t area_samples) {
        return gather(device(), photons, {{at}}, 1000, 0.5f, gather_budget, true, area_samples)
            .of[0]
            .sums.uneven;
    };
    EXPECT_NEAR(uneven(even, {0, 0, 0}, 20'000), 0, 0.01);
    EXPECT_NEAR(uneven(even, {1, 0, 0}, 20'000), 0, 0.01);
    EXPECT_NEAR(uneven(half, {0, 0, 0}, 20'000), std::pow(4 / (3 * double(pi)), 2) * 2, 0.03);
    EXPECT_EQ(uneven(half, {0, 0, 0}, 0), 0);
}

TEST_F(GatherNearest, SlowMillionInOnePoint) {
    std::vector<PhotonRecord> photons;
    for (int i = 0; i < 1'000'000; ++i) {
        photons.push_back(photon({0.25f, 0, -0.5f}, i % 5 == 0));
    }
    photons.push_back(photon({0.2f, 0, -0.5f}));
    // At the point, and beside it, where all but one are equally far.
    const std::vector<Query> queries{{{0.25f, 0, -0.5f}}, {{0.2f, 0, -0.5f}}, {{-0.9f, 0, 0.9f}}};
    for (const std::uint32_t k : {1u, 2u, 500u, 2'000'000u}) {
        SCOPED_TRACE(k);
        const Answers answers = gather(device(), photons, queries, k, 0.1f);
        expect_nearest(answers, queries, k, 0.1f);
        EXPECT_TRUE(std::isfinite(answers.of[0].sums.indirect.g));
    }
    // One dispatch cannot finish the query: it is counted as unfinished, and adds nothing.
    const Answers hurried =
        gather(device(), photons, {queries[0]}, 500, 0.1f, gather_budget, false);
    EXPECT_FALSE(hurried.finished);
    EXPECT_EQ(hurried.of[0].sums.indirect, glm::dvec3(0));
}

TEST_F(GatherNearest, DenseAndSparseTogether) {
    // Distances from photon to photon span twelve orders of magnitude: all depths of the
    // histograms are used.
    std::vector<PhotonRecord> photons;
    for (int i = 0; i < 20'000; ++i) {
        const float r = std::pow(10.0f, uniform(-12, 0));
        const float angle = uniform(0, 6.2831853f);
        photons.push_back(photon({r * std::cos(angle), 0, r * std::sin(angle)}, i % 2 == 0));
    }
    const std::vector<Query> queries{{{0, 0, 0}}, {{1e-6f, 0, 0}}, {{0.1f, 0, 0}}, {{-1, 0, 0}}};
    for (const std::uint32_t k : ks) {
        SCOPED_TRACE(k);
        expect_nearest(gather(device(), photons, queries, k, 1.5f), queries, k, 1.5f);
    }
}

TEST_F(GatherNearest, InterruptedQueriesAndVariantsGiveTheSameBits) {
    const std::vector<PhotonRecord> photons = floor_photons(10'000);
    const std::vector<Query> queries = floor_queries(100);
    const Answers whole = gather(device(), photons, queries, 150, 0.7f, 60'000, false, 5000);
    const auto expect_same = [&](const Answers& other) {
        EXPECT_TRUE(other.finished);
        for (std::size_t i = 0; i < queries.size(); ++i) {
            EXPECT_EQ(other.of[i].sums.indirect, whole.of[i].sums.indirect) << i;
            EXPECT_EQ(other.of[i].sums.caustic, whole.of[i].sums.caustic) << i;
        }
    };
    for (const std::uint32_t budget : {100u, 1000u, 1001u, 60'000u}) {
        SCOPED_TRACE(budget);
        expect_same(gather(device(), photons, queries, 150, 0.7f, budget, true, 5000));
    }
    for (const DeviceSetting& setting : variant_settings()) {
        SCOPED_TRACE(setting.name);
        expect_same(gather(open(setting), photons, queries, 150, 0.7f, 60'000, true, 5000));
    }
}

TEST_F(GatherNearest, CausticPartHasItsOwnNeighbours) {
    const std::vector<PhotonRecord> photons = floor_photons(10'000);
    std::vector<PhotonRecord> caustic, others;
    for (const PhotonRecord& p : photons) {
        (photon_is_caustic(p.normal) ? caustic : others).push_back(p);
    }
    const std::vector<Query> queries = floor_queries(100);
    const auto expect_alike = [&](const Answers& part, const Answers& alone) {
        for (std::size_t i = 0; i < queries.size(); ++i) {
            EXPECT_NEAR(part.of[i].sums.indirect.g, alone.of[i].sums.indirect.g,
                        1e-5 * alone.of[i].sums.indirect.g)
                << i;
            EXPECT_NEAR(part.of[i].sums.caustic.g, alone.of[i].sums.caustic.g,
                        1e-5 * alone.of[i].sums.caustic.g)
                << i;
        }
    };
    // Area samples lie among the other photons, so a caustic's estimate is not corrected.
    for (const std::uint64_t area_samples : {0u, 5000u}) {
        SCOPED_TRACE(area_samples);
        expect_alike(gather(device(), photons, queries, 150, 0.7f, gather_budget, true,
                            area_samples, map_caustic),
                     gather(device(), caustic, queries, caustic_k, caustic_radius));
        expect_alike(
            gather(device(), photons, queries, 150, 0.7f, gather_budget, true, area_samples,
                   map_indirect),
            gather(device(), others, queries, 150, 0.7f, gather_budget, true, area_samples));
    }
}

TEST_F(GatherNearest, EachPartReachesAsFarAsItsOwnNeighbours) {
    const Scene scene = load_asset("cornell_glass.glb");
    RenderSettings settings = settings_of("knn", 8, 1);
    settings.photons = 20'000;
    const RenderStatistics automatic = render(scene, settings).statistics;
    settings.neighbours = 4;
    const RenderStatistics few = render(scene, settings).statistics;
    EXPECT_LT(few.radius, 0.7 * automatic.radius);
    EXPECT_EQ(few.caustic_neighbours, automatic.caustic_neighbours);
    settings.neighbours.reset();
    settings.caustic_neighbours = 16 * automatic.caustic_neighbours;
    const RenderStatistics many = render(scene, settings).statistics;
    EXPECT_EQ(many.neighbours, automatic.neighbours);
    EXPECT_GT(many.caustic_radius, 1.5 * automatic.caustic_radius);
}

TEST_F(GatherNearest, EvenlySpreadPhotonsGiveTheirDensity) {
    // The mean is right for any k, and at edges and in corners too, thanks to the area samples.
    const std::size_t count = 40'000;
    std::vector<PhotonRecord> photons = floor_photons(count);
    for (PhotonRecord& p : photons) {
        p.flux_r = p.flux_g = p.flux_b = 4.0f / float(count);
        p.normal &= ~photon_caustic_bit;
    }
    const auto mean_at = [&](const std::vector<Query>& queries, std::uint32_t k,
                             std::uint64_t area_samples) {
        double sum = 0;
        for (const Answer& answer :
             gather(device(), photons, queries, k, 1, gather_budget, true, area_samples).of) {
            sum += answer.sums.indirect.g;
        }
        return sum / static_cast<double>(queries.size()) / (floor_albedo / double(pi));
    };
    std::vector<Query> inside = floor_queries(4000);
    std::vector<Query> at_edge;
    for (Query& q : inside) {
        q.position *= 0.8f;
        at_edge.push_back({{1, 0, q.position.z}});
    }
    for (const std::uint32_t k : {20u, 150u}) {
        EXPECT_NEAR(mean_at(inside, k, 0), 1, 0.03) << k;
    }
    EXPECT_NEAR(mean_at(at_edge, 150, 0), 0.5, 0.03);
    EXPECT_NEAR(mean_at(at_edge, 150, 40'000), 1, 0.04);
}

} // namespace
} // namespace argand::testing
