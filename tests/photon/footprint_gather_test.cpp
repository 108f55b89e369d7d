// Density estimation over footprints made by hand, compared with the sum in double precision over
// the photons and footprints of the map.
#include "photon/map_queries.hpp"
#include "shared/footprint.h"
#include "shared/photon.h"
#include "world/world.hpp"

#include <optional>
#include <random>

namespace argand::testing {
namespace {

constexpr float floor_albedo = 0.5f;
constexpr float flatness = 0.4f;

struct Splat {
    PhotonRecord photon{};
    glm::vec3 u{0}, v{0}; ///< its positional differentials
};

/// The estimates of the device, and the photons and footprints of its map.
struct Sums {
    std::vector<Gathered> sums;
    std::vector<PhotonRecord> photons;
    std::vector<glm::uvec4> footprints;
    bool finished = true;
};

struct GatherSettings {
    std::uint32_t leaf_size = 0;
    std::uint32_t budget = gather_budget;
    bool uniform_kernel = false;
    bool careful = true;
    std::uint64_t area_samples = 0;
    std::uint32_t part = map_whole;
    std::optional<FrontierSettings> frontier; ///< none: through the tree
};

/// A scale with which the semi-axes of caustic photons equal their differentials. The axes of other
/// photons are compressed.
FootprintScale plain_scale() {
    FootprintScale s{};
    s.spacing = s.diffuse = s.caustic = 1;
    s.radius_min = s.caustic_min = 1e-6f;
    s.radius_max = s.caustic_max = 1e6f;
    s.flatness = flatness;
    return s;
}

Sums gather(Device& device, const std::vector<Splat>& splats, const std::vector<Query>& queries,
            const GatherSettings& settings = {}) {
    const DeviceScene scene =
        upload_scene(device, floor_scene(lambertian(glm::vec3(floor_albedo)), 1),
                     make_plan({}, {.everything = true}));
    PhotonWorkspace workspace =
        make_photon_workspace(device, splats.size(), {.extents = extents_differentials});
    std::vector<PhotonRecord> photons;
    std::vector<glm::uvec4> offsets;
    std::size_t stored = 0;
    for (const Splat& splat : splats) {
        const uvec2 u = pack_dual(splat.u);
        const uvec2 v = pack_dual(splat.v);
        photons.push_back(splat.photon);
        offsets.emplace_back(u.x, u.y, v.x, v.y);
        stored += splat.photon.normal != no_photon ? 1 : 0;
    }
    const PhotonMap map =
        build_photon_map(device, scene, workspace, store(device, workspace, photons, offsets),
                         {.area_samples = settings.area_samples,
                          .leaf_size = settings.leaf_size,
                          .footprints = plain_scale(),
                          .frontier = settings.frontier});

    Sums result;
    FootprintEstimator estimator(device, scene.plan, settings.uniform_kernel, settings.budget);
    result.sums =
        answers(device, estimator, map, queries,
                {.until_complete = settings.careful, .part = settings.part}, result.finished);
    const std::size_t kept = stored + map.area_samples;
    result.photons = download<PhotonRecord>(device, map.photons, kept);
    result.footprints = download<glm::uvec4>(device, map.footprints, kept);
    return result;
}

/// Weight of one photon at a query, in double precision.
struct Weight {
    double value = 0;       ///< flux per area
    double center = 0;      ///< the value at the footprint's centre
    bool uncertain = false; ///< rounding decides whether the footprint contains the query
};

/// The ellipsoid |A x| <= 1, its axes the columns of the inverse M; a plane of unit normal m
/// through its centre cuts out an ellipse of area pi |det M| / |Mᵀ m|.
Weight weight_at(const PhotonRecord& photon, const glm::uvec4& footprint, const Query& query,
                 bool uniform_kernel) {
    const glm::dvec3 a(unpack_dual(footprint.x, footprint.y));
    const glm::dvec3 b(unpack_dual(footprint.z, footprint.w));
    const glm::dvec3 n(unpack_photon_normal(photon.normal));
    const glm::dvec3 m(unpack_unit(pack_unit(query.normal)));
    const double inverse_area = std::abs(glm::dot(glm::cross(a, b), n));
    const glm::dmat3 inverse_axes =
        glm::transpose(glm::dmat3(a, b, n * (std::sqrt(inverse_area) / double(flatness))));
    const glm::dmat3 axes = glm::inverse(inverse_axes);
    const glm::dvec3 offset = glm::dvec3(query.position) - glm::dvec3(photon.x, photon.y, photon.z);
    const glm::dvec3 x = inverse_axes * offset;
    const double q = glm::dot(x, x);
    const double cut =
        double(pi) * std::abs(glm::determinant(axes)) / glm::length(glm::transpose(axes) * m);
    const double kernel = uniform_kernel ? 1 : 2 * (1 - q);
    Weight weight;
    weight.center = (uniform_kernel ? 1 : 2) / cut;
    const double bend = bend_beyond({query.position, glm::vec3(m)}, n, offset);
    weight.uncertain = std::abs(q - 1) < 1e-5 || std::abs(bend) < 1e-5;
    const bool same_surface = bend <= 0 && glm::dot(n, m) >= double(same_surface_cosine);
    weight.value = q <= 1 && same_surface ? kernel / cut : 0;
    return weight;
}

void expect_exact_sums(const Sums& gathered, const std::vector<Query>& queries,
                       bool uniform_kernel = false) {
    ASSERT_TRUE(gathered.finished);
    for (std::size_t k = 0; k < queries.size(); ++k) {
        Gathered sum;
        Gathered tolerance;
        for (std::size_t i = 0; i < gathered.photons.size(); ++i) {
            const PhotonRecord& p = gathered.photons[i];
            const Weight weight = weight_at(p, gathered.footprints[i], queries[k], uniform_kernel);
            if (weight.value == 0 && !weight.uncertain) {
                continue;
            }
            const glm::dvec3 scattered =
                glm::dvec3(p.flux_r, p.flux_g, p.flux_b) * double(floor_albedo) / double(pi);
            const bool caustic = photon_is_caustic(p.normal);
            (caustic ? sum.caustic : sum.indirect) += scattered * weight.value;
            const bool jumps = weight.uncertain && uniform_kernel;
            (caustic ? tolerance.caustic : tolerance.indirect) +=
                scattered * weight.center * (jumps ? 1 : 1e-5);
        }
        for (int channel = 0; channel < 3; ++channel) {
            EXPECT_NEAR(gathered.sums[k].indirect[channel], sum.indirect[channel],
                        tolerance.indirect[channel])
                << k;
            EXPECT_NEAR(gathered.sums[k].caustic[channel], sum.caustic[channel],
                        tolerance.caustic[channel])
                << k;
        }
    }
}

class GatherFootprints : public RenderTest {
protected:
    GatherFootprints() : random_(11) {}

    float uniform(float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random_);
    }

    /// A skewed footprint of about this size.
    Splat splat(glm::vec3 position, float size, bool caustic = true, glm::vec3 normal = {0, 1, 0}) {
        const Frame f = make_frame(normal);
        const float turn = uniform(0, 6.28f);
        const float skew = turn + uniform(0.5f, 2.5f);
        Splat s;
        s.photon = {position.x,       position.y,
                    position.z,       pack_photon_normal(normal, caustic),
                    uniform(0.1f, 1), uniform(0.1f, 1),
                    uniform(0.1f, 1), pack_unit({0, 1, 0})};
        s.u = (f.x * std::cos(turn) + f.y * std::sin(turn)) * (size * uniform(0.3f, 3));
        s.v = (f.x * std::cos(skew) + f.y * std::sin(skew)) * size;
        // Undoes the compression of footprints of photons that are not caustic.
        const auto compressible = [](glm::vec3 x) {
            return x * float(std::pow(glm::length(x), 3));
        };
        if (!caustic) {
            s.u = compressible(s.u);
            s.v = compressible(s.v);
        }
        return s;
    }

    /// A round footprint of this size, of a photon that is not caustic.
    Splat round_splat(glm::vec3 position, float size, glm::vec3 normal = {0, 1, 0}) {
        Splat s = splat(position, 1, false, normal);
        const Frame f = make_frame(normal);
        s.u = f.x * std::pow(size, 4.0f); // undoes the compression
        s.v = f.y * std::pow(size, 4.0f);
        return s;
    }

    /// Evenly spread photons on the floor that bring an irradiance of 1, with footprints of this
    /// size.
    std::vector<Splat> even_floor(float size) {
        constexpr int side = 200;
        const auto across = [](int i) { return (2 * float(i) + 1) / side - 1; };
        std::vector<Splat> splats;
        for (int i = 0; i < side * side; ++i) {
            Splat s = round_splat({across(i % side), 0, across(i / side)}, size);
            s.photon.flux_r = s.photon.flux_g = s.photon.flux_b = 4.0f / (side * side);
            splats.push_back(s);
        }
        return splats;
    }

    /// Photons on a bumpy floor: tangent planes are tilted against one another, and offsets leave
    /// them.
    std::vector<Splat> bumpy(std::size_t count, float size) {
        std::vector<Splat> splats;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 normal =
                glm::normalize(glm::vec3(uniform(-0.4f, 0.4f), 1, uniform(-0.4f, 0.4f)));
            splats.push_back(splat({uniform(-1, 1), uniform(-0.02f, 0.02f), uniform(-1, 1)}, size,
                                   i % 3 == 0, normal));
        }
        return splats;
    }

    std::vector<Query> bumpy_queries(std::size_t count) {
        std::vector<Query> queries;
        for (std::size_t i = 0; i < count; ++i) {
            const glm::vec3 normal =
                glm::normalize(glm::vec3(uniform(-0.2f, 0.2f), 1, uniform(-0.2f, 0.2f)));
            queries.push_back({{uniform(-1, 1), uniform(-0.02f, 0.02f), uniform(-1, 1)}, normal});
        }
        return queries;
    }

    std::mt19937 random_;
};

TEST_F(GatherFootprints, IsTheSumOverFootprintsThatReachTheQuery) {
    const std::vector<Splat> splats = bumpy(4001, 0.1f);
    const std::vector<Query> queries = bumpy_queries(67);
    for (const bool uniform_kernel : {false, true}) {
        for (const std::uint32_t leaf_size : {0u, 1u, 2u, 16u, most_photons_a_leaf}) {
            SCOPED_TRACE(::testing::Message()
                         << "leaves of " << leaf_size << ", uniform " << uniform_kernel);
            const GatherSettings settings{
                .leaf_size = leaf_size, .uniform_kernel = uniform_kernel, .careful = false};
            expect_exact_sums(gather(device(), splats, queries, settings), queries, uniform_kernel);
        }
        const FrontierSettings little{.query_leaf = 2, .memory = least_frontier_memory};
        for (const FrontierSettings& frontier : {FrontierSettings(), little}) {
            SCOPED_TRACE(::testing::Message() << "simultaneous, " << frontier.memory << " bytes");
            expect_exact_sums(gather(device(), splats, queries,
                                     {.uniform_kernel = uniform_kernel, .frontier = frontier}),
                              queries, uniform_kernel);
        }
    }
}

TEST_F(GatherFootprints, SimultaneousAnswersEqualThoseOfTheTree) {
    const std::vector<Splat> splats = bumpy(3001, 0.1f);
    const std::vector<Query> queries = bumpy_queries(403);
    for (const std::uint32_t part : {map_whole, map_indirect, map_caustic}) {
        for (const std::uint64_t area_samples : {0u, 1000u}) {
            SCOPED_TRACE(::testing::Message() << part << ", " << area_samples);
            GatherSettings settings{.area_samples = area_samples, .part = part};
            const Sums tree = gather(device(), splats, queries, settings);
            settings.frontier = FrontierSettings();
            const Sums found = gather(device(), splats, queries, settings);
            EXPECT_EQ(found.footprints, tree.footprints);
            for (std::size_t i = 0; i < queries.size(); ++i) {
                for (int channel = 0; channel < 3; ++channel) {
                    EXPECT_RELATIVE(found.sums[i].indirect[channel], tree.sums[i].indirect[channel],
                                    1e-5);
                    EXPECT_RELATIVE(found.sums[i].caustic[channel], tree.sums[i].caustic[channel],
                                    1e-5);
                }
            }
            EXPECT_EQ(found.sums[0].indirect.g > 0, part != map_caustic);
            EXPECT_EQ(found.sums[0].caustic.g > 0, part != map_indirect);
        }
    }
}

TEST_F(GatherFootprints, AnyNumberOfPhotonsAndAnySize) {
    for (const std::size_t count : {0u, 1u, 2u, 3u, 7u, 64u, 65u, 100'003u}) {
        for (const float size : {0.01f, 0.3f, 4.0f}) {
            if (count > 1000 && size > 1) {
                continue;
            }
            SCOPED_TRACE(::testing::Message() << count << " of size " << size);
            std::vector<Splat> splats = bumpy(count, size);
            for (std::size_t i = 3; i < count; i += 7) {
                splats[i].photon.normal = no_photon;
            }
            std::vector<Query> queries = bumpy_queries(9);
            if (count > 0) {
                const PhotonRecord& p = splats[0].photon;
                queries.push_back({{p.x, p.y, p.z}});
            }
            const Sums gathered = gather(device(), splats, queries);
            expect_exact_sums(gathered, queries);
            if (count > 0) {
                EXPECT_GT(gathered.sums.back().caustic.g, 0);
            } else {
                EXPECT_EQ(gathered.sums.front(), Gathered());
            }
        }
    }
}

TEST_F(GatherFootprints, MillionInOnePointIsTheExactSum) {
    std::vector<Splat> splats;
    for (int i = 0; i < 1'000'000; ++i) {
        splats.push_back(splat({0.25f, 0, -0.5f}, 0.1f, i % 5 == 0));
    }
    const std::vector<Query> queries{{{0.25f, 0, -0.5f}}, {{0.2f, 0, -0.5f}}, {{-0.9f, 0, 0.9f}}};
    const Sums gathered = gather(device(), splats, queries);
    expect_exact_sums(gathered, queries);
    EXPECT_GT(gathered.sums[1].caustic.g, 0);
    EXPECT_EQ(gathered.sums[2], Gathered());
    expect_exact_sums(
        gather(device(), splats, queries, {.budget = 3000, .frontier = FrontierSettings()}),
        queries);
    // One dispatch does not complete the queries: this is reported, and nothing is added.
    const Sums hurried = gather(device(), splats, {queries[0]}, {.careful = false});
    EXPECT_FALSE(hurried.finished);
    EXPECT_EQ(hurried.sums[0], Gathered());
}

TEST_F(GatherFootprints, InterruptedQueriesGiveTheSameBits) {
    const std::vector<Splat> splats = bumpy(1000, 0.2f);
    const std::vector<Query> queries = bumpy_queries(30);
    for (const std::uint32_t leaf_size : {1u, 16u, most_photons_a_leaf}) {
        const Sums whole =
            gather(device(), splats, queries, {.leaf_size = leaf_size, .budget = 60'000});
        for (const std::uint32_t budget : {3u, 100u, 1001u}) {
            const Sums parts =
                gather(device(), splats, queries, {.leaf_size = leaf_size, .budget = budget});
            EXPECT_EQ(parts.sums, whole.sums) << leaf_size << ", " << budget;
        }
    }
    const std::vector<Splat> few(splats.begin(), splats.begin() + 60);
    EXPECT_EQ(gather(device(), few, queries, {.budget = 1}).sums,
              gather(device(), few, queries).sums);
}

TEST_F(GatherFootprints, TellsHowUnevenLightIs) {
    const std::vector<Splat> even = even_floor(0.3f);
    std::vector<Splat> half = even;
    for (Splat& s : half) {
        if (s.photon.x < 0) {
            s.photon.flux_r = s.photon.flux_g = s.photon.flux_b = 0;
        }
    }
    const auto uneven = [&](const std::vector<Splat>& splats, glm::vec3 at,
                            std::uint64_t area_samples) {
        return gather(device(), splats, {{at}}, {.area_samples = area_samples}).sums[0].uneven;
    };
    EXPECT_NEAR(uneven(even, {0, 0, 0}, 40'000), 0, 0.003);
    EXPECT_NEAR(uneven(even, {1, 0, 0.1f}, 40'000), 0, 0.003);
    EXPECT_NEAR(uneven(half, {0, 0, 0}, 40'000), std::pow(16 / (15 * double(pi)), 2) * 3, 0.02);
    EXPECT_EQ(uneven(half, {0, 0, 0}, 0), 0);
}

TEST_F(GatherFootprints, LeavesOutOtherSidesAndOtherSurfaces) {
    const float height = 0.3f;
    // Height of a surface that is taken for another one at 0.1 from the query.
    const float above = 0.5f * flat_tolerance * 0.1f;
    const auto circle = [&](glm::vec3 position, glm::vec3 normal = {0, 1, 0}) {
        Splat s = splat(position, 1, true, normal);
        const Frame f = make_frame(normal);
        s.u = f.x * height;
        s.v = f.y * height;
        return s;
    };
    const std::vector<Splat> reach{circle({0.1f, 0, 0}), circle({0.1f, 0.9f * above, 0}),
                                   circle({0.1f, -0.9f * above, 0}),
                                   circle({0, 0, 0}, glm::normalize(glm::vec3(1, 1.8f, 0)))};
    const std::vector<Splat> others{
        circle({0.31f, 0, 0}),         circle({0.1f, 1.1f * above, 0}),
        circle({0, 0, 0}, {0, -1, 0}), circle({0.01f, -5e-6f, 0}, {0, -1, 0}),
        circle({0, 0, 0}, {1, 0, 0}),  circle({0, 0, 0}, glm::normalize(glm::vec3(1, 0.4f, 0)))};
    for (const Splat& splat : reach) {
        const Sums one = gather(device(), {splat}, {Query{}});
        expect_exact_sums(one, {Query{}});
        EXPECT_GT(one.sums[0].caustic.g, 0);
    }
    for (const Splat& splat : others) {
        EXPECT_EQ(gather(device(), {splat}, {Query{}}).sums[0], Gathered());
    }
    // Photons on the other side of the floor count there only.
    EXPECT_GT(gather(device(), {others[3]}, {Query{.normal = {0, -1, 0}}}).sums[0].caustic.g, 0);
}

TEST_F(GatherFootprints, EdgesOfSurfacesLoseNothing) {
    // The estimate is the same in the middle, at an edge and in a corner.
    const std::vector<Splat> splats = even_floor(0.3f);
    const std::vector<Query> queries{{{0, 0, 0}}, {{1, 0, 0.1f}}, {{-0.9f, 0, 0.1f}}, {{1, 0, 1}}};
    for (const Gathered& sum : gather(device(), splats, queries, {.area_samples = 40'000}).sums) {
        EXPECT_RELATIVE(sum.indirect.g, floor_albedo / double(pi), 0.03);
    }
    const std::vector<Gathered> plain = gather(device(), splats, queries).sums;
    EXPECT_RELATIVE(plain[1].indirect.g, 0.5 * floor_albedo / double(pi), 0.03);
    EXPECT_RELATIVE(plain[3].indirect.g, 0.25 * floor_albedo / double(pi), 0.03);
}

// The feet of things that stand on a floor have photons of other sizes.
TEST_F(GatherFootprints, OtherSurfacesDoNotChangeEdges) {
    std::vector<Splat> splats = even_floor(0.1f);
    std::vector<Query> queries;
    for (std::size_t i = 0; i < 40'000; ++i) {
        splats.push_back(round_splat({uniform(-1, 1), 0.01f, uniform(-1, 1)}, 0.6f, {0, 0, 1}));
    }
    for (int i = 0; i < 9; ++i) {
        queries.push_back({{0.96f, 0, 0.1f * float(i)}});
    }
    for (const Gathered& sum : gather(device(), splats, queries, {.area_samples = 40'000}).sums) {
        EXPECT_RELATIVE(sum.indirect.g, floor_albedo / double(pi), 0.05);
    }
}

// Light that rises and falls along x, and footprints that grow with it. If area samples followed
// their sizes, estimates over such strips would have 1.055 times the light, by integration; with
// the mean size over half of a footprint's area they have 0.9995 times.
TEST_F(GatherFootprints, LightIsNotGainedWhereSizesVary) {
    constexpr int side = 100, points = 60;
    constexpr double depth = 0.8, turn = 6 * double(pi);
    const auto light_at = [](double x) { return 1 + depth * std::cos(turn * x); };
    const auto light_up_to = [](double x) { return x + 1 + depth * std::sin(turn * x) / turn; };
    std::vector<Splat> splats;
    for (int column = 0; column < side; ++column) {
        double low = -1, high = 1;
        for (int step = 0; step < 40; ++step) {
            const double middle = (low + high) / 2;
            (light_up_to(middle) < 2 * (column + 0.5) / side ? low : high) = middle;
        }
        const auto size = static_cast<float>(0.2 * std::sqrt(light_at(low)));
        for (int row = 0; row < side; ++row) {
            Splat s = round_splat({float(low), 0, (2 * float(row) + 1) / side - 1}, size);
            s.photon.flux_r = s.photon.flux_g = s.photon.flux_b = 4.0f / (side * side);
            splats.push_back(s);
        }
    }
    std::vector<Query> queries;
    for (int i = 0; i < points; ++i) { // over three periods
        queries.push_back({{(float(i) + 0.5f) / points - 0.5f, 0, uniform(-0.5f, 0.5f)}});
    }
    const auto mean_of = [&](std::uint64_t area_samples) {
        double sum = 0;
        for (const Gathered& g :
             gather(device(), splats, queries, {.area_samples = area_samples}).sums) {
            sum += g.indirect.g;
        }
        return sum / points / (floor_albedo / double(pi));
    };
    EXPECT_NEAR(mean_of(0), 1, 0.001);
    EXPECT_NEAR(mean_of(10'000), 1, 0.015);
}

// Reads through texels or storage buffers, with or without subgroups, give the same photons in the
// same order.
TEST_F(GatherFootprints, EveryWayToReadTheMapGivesTheSameBits) {
    const std::vector<Splat> splats = bumpy(5003, 0.1f);
    const std::vector<Query> queries = bumpy_queries(200);
    const Sums first = gather(device(), splats, queries, {.area_samples = 1000});
    EXPECT_NE(first.sums[0], Gathered());
    for (const DeviceSetting& setting : variant_settings()) {
        const Sums other = gather(open(setting), splats, queries, {.area_samples = 1000});
        EXPECT_EQ(other.sums, first.sums) << setting.name;
        EXPECT_EQ(other.footprints, first.footprints) << setting.name;
    }
}

} // namespace
} // namespace argand::testing
