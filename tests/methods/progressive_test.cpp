// Progressive photon mapping: the formula, the sequence of widths, and the error that falls with
// them.
#include "rendering.hpp"

#include "methods/photon_numbers.hpp"
#include "methods/plan_render.hpp"
#include "photon/map_queries.hpp"
#include "shared/photon.h"
#include "world/world.hpp"

#include <bit>
#include <cmath>
#include <random>

namespace argand::testing {
namespace {

bool proceed(double /*share*/) { return true; }

class Progressive : public RenderTest {
protected:
    /// The records of a pass's photons, as the renderer traces them.
    std::vector<PhotonRecord> photons_of(const Scene& scene, const PhotonPass& pass) {
        const DeviceScene on_device =
            upload_scene(device(), scene, plan_render(scene, settings_of("progressive", 1, 1)));
        PhotonWorkspace workspace = make_photon_workspace(device(), pass.count);
        device().fill(workspace.flux_sums, 0);
        const std::optional<StoredPhotons> stored =
            trace_photons(device(), on_device, workspace, pass, 1e-9f);
        return download<PhotonRecord>(device(), workspace.photons, stored.value().slots);
    }

    /// The radiance of a Lambertian surface by the paper's formula, in double precision: the flux
    /// of all photons in a ball, which the surface scatters, over the area of a disc. Flux is
    /// divided by the pass's number of photon paths already.
    static glm::dvec3 radiance_of(const std::vector<PhotonRecord>& photons, const Query& query,
                                  double radius, const glm::dvec3& albedo) {
        glm::dvec3 flux(0);
        for (const PhotonRecord& p : photons) {
            const glm::dvec3 to = glm::dvec3(p.x, p.y, p.z) - glm::dvec3(query.position);
            const double cosine =
                glm::dot(glm::dvec3(unpack_unit(p.direction)), glm::dvec3(query.normal));
            if (p.normal != no_photon && glm::dot(to, to) < radius * radius && cosine > 0) {
                flux += glm::dvec3(p.flux_r, p.flux_g, p.flux_b);
            }
        }
        return flux * albedo / double(pi) / (double(pi) * radius * radius);
    }
};

TEST_F(Progressive, UniformBallIsThePapersSumOverAnyPhotons) {
    std::mt19937 random(7);
    const auto uniform = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    std::vector<PhotonRecord> photons;
    photons.reserve(5'000);
    for (int i = 0; i < 5'000; ++i) {
        const glm::vec3 normal =
            glm::normalize(glm::vec3(uniform(-1, 1), uniform(-1, 1), uniform(0.1f, 1)));
        const bool above = i % 4 != 0; // the others come from below and do not count
        photons.push_back({uniform(-1, 1), uniform(-1, 1), uniform(-1, 1),
                           pack_photon_normal(normal, i % 3 == 0), uniform(0.1f, 1),
                           uniform(0.1f, 1), uniform(0.1f, 1),
                           pack_unit(glm::normalize(glm::vec3(0.5f, above ? 1.0f : -1.0f, 0)))});
    }
    std::vector<Query> queries;
    queries.reserve(100);
    for (int i = 0; i < 100; ++i) {
        queries.push_back({{uniform(-1, 1), uniform(-1, 1), uniform(-1, 1)}});
    }
    const DeviceScene scene = upload_scene(device(), floor_scene(lambertian(glm::vec3(0.5f)), 1),
                                           make_plan({}, {.everything = true}));
    PhotonWorkspace workspace = make_photon_workspace(device(), photons.size());
    const PhotonMap map =
        build_photon_map(device(), scene, workspace, store(device(), workspace, photons),
                         {.area_samples = 1'000}); // which must not correct it
    for (const double radius : {0.2, 0.7, 4.0}) {
        RadiusEstimator estimator(device(), scene.plan, {radius, radius}, gather_budget,
                                  {.uniform_kernel = true, .ball = true});
        bool finished = false;
        const std::vector<Gathered> found =
            answers(device(), estimator, map, queries, {.until_complete = true}, finished);
        for (std::size_t i = 0; i < queries.size(); ++i) {
            const glm::dvec3 sum = found[i].indirect + found[i].caustic;
            const glm::dvec3 expected = radiance_of(photons, queries[i], radius, glm::dvec3(0.5));
            for (int channel = 0; channel < 3; ++channel) {
                EXPECT_RELATIVE(sum[channel], expected[channel], 1e-4) << radius;
            }
        }
    }
}

// Keller et al. 2010, section 1, over the photons that each pass stored.
TEST_F(Progressive, PictureIsTheMeanOfThePapersSumsWithItsRadii) {
    Scene scene = room_scene();
    const glm::vec3 point(0.6f, -1, 0.3f);
    scene.cameras = {parallel_rays(point + glm::vec3(0.05f, 0.3f, 0), point, 1e-6f)};
    RenderSettings settings = settings_of("progressive", 1, 1);
    settings.photons = 6'000;
    settings.photons_per_pass = 2'000; // three parts, which count as passes
    settings.query_cell = 0;
    settings.disc = {.uniform_kernel = true, .ball = true};
    settings.progressive.first_radius = 0.4;
    settings.progressive.passes = 2;
    const RenderResult result = render(scene, settings);
    ASSERT_EQ(result.statistics.passes, 6u);
    EXPECT_EQ(result.statistics.photons_emitted, 12'000u);
    // Of the material under the point.
    const glm::dvec3 albedo(scene.materials[scene.triangle_material[4]].base_color);
    glm::dvec3 expected(0);
    for (std::uint32_t pass = 0; pass < 6; ++pass) {
        const std::uint64_t paths = 2'000ull * (pass + 1);
        const double radius = 0.4 * std::pow(static_cast<double>(paths) / 2'000, -0.25);
        expected += radiance_of(photons_of(scene, {.seed = settings.seed,
                                                   .first = 2'000ull * pass,
                                                   .count = 2'000,
                                                   .bounces = settings.bounces}),
                                {point}, radius, albedo) /
                    6.0;
    }
    const glm::dvec3 found = mean(layer(result, "indirect"));
    EXPECT_GT(expected.r, 0);
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_RELATIVE(found[channel], expected[channel], 1e-4);
    }
}

/// Widths of the last pass.
RenderStatistics widths(Session& session) { return session.result().statistics; }

TEST_F(Progressive, EveryWidthFollowsTheLawAndResumesWithTheSameBits) {
    const Scene scene = room_scene();
    World world(device(), scene);
    for (const char* method : {"photons", "footprints", "knn", "progressive"}) {
        SCOPED_TRACE(method);
        RenderSettings settings = settings_of(method, 6, 1);
        settings.photons = 1'000;
        settings.progressive = {.on = true, .first_radius = {}, .exponent = 0.2, .passes = 9};
        Session session(world, scene, settings);
        session.begin_frame(settings.seed);
        RenderStatistics first;
        std::map<std::uint64_t, std::vector<std::uint8_t>> states;
        std::map<std::uint64_t, RenderResult> results;
        while (const std::optional<PassPlan> plan = session.next_pass()) {
            ASSERT_TRUE(session.step(*plan, proceed));
            const RenderStatistics now = widths(session);
            const std::uint64_t before =
                results.empty() ? 0 : results.rbegin()->second.statistics.photons_emitted;
            const double photons = static_cast<double>(now.photons_emitted - before) / 1'000;
            first = session.passes() == 1 ? now : first;
            const double by = std::pow(static_cast<double>(now.photons_emitted) / 1'000, -0.2);
            EXPECT_EQ(now.radius, first.radius * by);
            EXPECT_EQ(now.caustic_radius, first.caustic_radius * by);
            EXPECT_EQ(now.smoothing, first.smoothing * by);
            EXPECT_EQ(now.neighbours, std::max(std::round(first.neighbours * by * by * photons),
                                               std::min<double>(8, first.neighbours)));
            EXPECT_EQ(photons > 1,
                      session.passes() > 1 && now.neighbours > 0 && first.neighbours * by * by < 8);
            states[session.passes()] = session.save();
            results[session.passes()] = session.result();
        }
        EXPECT_EQ(session.passes(), 9u);
        EXPECT_GT(first.radius, 0);
        EXPECT_EQ(first.smoothing > 0, builtin_methods().at(method).abilities.footprints);
        for (const std::uint64_t passes : {1, 2, 7}) {
            Session other(world, scene, settings);
            other.resume(states[passes], settings.seed);
            while (const std::optional<PassPlan> plan = other.next_pass()) {
                ASSERT_TRUE(other.step(*plan, proceed));
                EXPECT_TRUE(same_bits(other.result(), results[other.passes()]));
                EXPECT_EQ(widths(other).radius, results[other.passes()].statistics.radius);
            }
            EXPECT_EQ(other.passes(), 9u);
        }
    }
}

TEST(PhotonNumbers, PassesOfAnySizeTakeEachNumberOfASeedOnce) {
    PhotonNumbers numbers;
    std::map<std::uint32_t, std::uint64_t> next; // by the seed of photons
    std::uint32_t seeds_of_five = 0;
    for (std::uint64_t pass = 0; pass < 30; ++pass) {
        const std::uint64_t count = 1'000'000'000 + 7 * pass * pass;
        const PhotonPass photons = numbers.next(5, count);
        EXPECT_EQ(photons.count, count);
        EXPECT_LE(photons.first + count, 0xffffffffu);
        seeds_of_five += next.count(photons.seed) == 0 ? 1 : 0;
        EXPECT_EQ(photons.first, next[photons.seed]);
        next[photons.seed] = photons.first + count;
    }
    EXPECT_EQ(next.count(5), 1u);
    EXPECT_EQ(seeds_of_five, 8u); // four passes each
    const PhotonPass other = numbers.next(6, 10);
    EXPECT_EQ(other.seed, 6u);
    EXPECT_EQ(other.first, 0u);
    Archive saved;
    numbers.persist(saved);
    const std::vector<std::uint8_t> bytes = std::move(saved).take_bytes();
    PhotonNumbers loaded;
    Archive archive(bytes);
    loaded.persist(archive);
    for (const std::uint32_t seed : {5u, 6u, 7u}) {
        const PhotonPass a = numbers.next(seed, 10), b = loaded.next(seed, 10);
        EXPECT_EQ(a.seed, b.seed);
        EXPECT_EQ(a.first, b.first);
    }
}

// With k(n) = k1 m / n1 (n / n1)^(-2a), where m photons of the pass's n1 in the first one.
TEST_F(Progressive, SlowPassesGrowWhereKIsAtItsLeast) {
    const Scene scene = room_scene();
    World world(device(), scene);
    RenderSettings settings = settings_of("knn", 6, 1);
    settings.photons = 400;
    settings.photons_per_pass = 400;
    settings.neighbours = 24;
    settings.progressive = {.on = true, .first_radius = 0.9, .exponent = 0.25, .passes = 40};
    Session session(world, scene, settings);
    session.begin_frame(settings.seed);
    std::map<std::uint64_t, std::vector<std::uint8_t>> states;
    std::map<std::uint64_t, RenderResult> results;
    std::uint64_t before = 0;
    double last = 1;
    while (const std::optional<PassPlan> plan = session.next_pass()) {
        ASSERT_TRUE(session.step(*plan, proceed));
        const RenderStatistics now = widths(session);
        const double n = static_cast<double>(now.photons_emitted) / 400;
        const double m = static_cast<double>(now.photons_emitted - before) / 400;
        const double k = 24 * m / std::sqrt(n);
        if (n <= 9) { // 24 / √9 = 8
            EXPECT_EQ(m, 1);
        } else {
            EXPECT_GE(m, last);
            EXPECT_LE(m, 8); // times photons_per_pass, at most
            EXPECT_TRUE(m == 8 || std::abs(k - 8) < 0.05) << m << ", " << k;
        }
        EXPECT_EQ(now.neighbours, std::max(std::round(k), 8.0));
        EXPECT_EQ(now.radius, 0.9 * std::pow(n, -0.25));
        before = now.photons_emitted;
        last = m;
        states[session.passes()] = session.save();
        results[session.passes()] = session.result();
    }
    // dn/di = n1/3 √(n/n1): √n grows by 1/6 a pass after the ninth.
    EXPECT_NEAR(std::sqrt(static_cast<double>(before) / 400), 3 + 31.0 / 6, 0.1);
    for (const std::uint64_t passes : {9, 30}) {
        Session other(world, scene, settings);
        other.resume(states[passes], settings.seed);
        while (const std::optional<PassPlan> plan = other.next_pass()) {
            ASSERT_TRUE(other.step(*plan, proceed));
            const RenderResult& whole = results[other.passes()];
            EXPECT_TRUE(same_bits(other.result(), whole)) << other.passes();
            EXPECT_EQ(other.result().statistics.photons_emitted, whole.statistics.photons_emitted);
            EXPECT_EQ(other.result().statistics.flux.emitted, whole.statistics.flux.emitted);
        }
    }
    session.begin_frame(settings.seed); // with the memory of the large passes
    for (const std::uint64_t passes : {1, 2}) {
        ASSERT_TRUE(session.step(*session.next_pass(), proceed));
        EXPECT_TRUE(same_bits(session.result(), results[passes]));
        EXPECT_EQ(session.result().statistics.flux.emitted,
                  results[passes].statistics.flux.emitted);
    }
    settings.progressive.passes = 140;
    Session longer(world, scene, settings);
    longer.resume(states[40], settings.seed);
    while (const std::optional<PassPlan> plan = longer.next_pass()) {
        before = widths(longer).photons_emitted;
        ASSERT_TRUE(longer.step(*plan, proceed));
    }
    EXPECT_EQ(widths(longer).photons_emitted - before, 8u * 400u);
    EXPECT_EQ(widths(longer).neighbours, 8u);
}

TEST_F(Progressive, PassesGrowNoLargerThanTheDeviceStores) {
    Device& small = open({"small", "", "storage_range=1MiB"}); // 32,768 photons
    const Scene scene = room_scene();
    World world(small, scene);
    RenderSettings settings = settings_of("knn", 6, 1);
    settings.photons = 1'500;
    settings.neighbours = 2; // as is the least
    settings.progressive = {.on = true, .first_radius = {}, .exponent = 0.45, .passes = 12};
    Session session(world, scene, settings);
    session.begin_frame(settings.seed);
    std::vector<std::uint64_t> emitted{0}, stored{0};
    while (const std::optional<PassPlan> plan = session.next_pass()) {
        ASSERT_TRUE(session.step(*plan, proceed));
        emitted.push_back(widths(session).photons_emitted);
        stored.push_back(widths(session).photons_stored);
    }
    ASSERT_EQ(emitted.size(), 13u);
    EXPECT_EQ(emitted[12] - emitted[11], emitted[11] - emitted[10]);
    EXPECT_GT(emitted[12] - emitted[11], 4u * 1'500);
    EXPECT_GT(stored[12] - stored[11], 32'768 / 3);
    EXPECT_LE(stored[12] - stored[11], 32'768u);
}

// Below the room lie 2,000 m². Once the radius has fallen, samples of all areas would be too few;
// then they lie in the room only.
TEST_F(Progressive, EdgesAreCorrectedHoweverSmallTheRadius) {
    const Scene room = room_scene();
    Scene above_ground = room;
    add_floor(above_ground, 22.4f, -3, add_material(above_ground, lambertian(glm::vec3(0.5f))));
    RenderSettings settings = settings_of("progressive", 24, 4);
    settings.photons = 20'000;
    settings.progressive = {.on = true, .first_radius = 0.3, .exponent = 0.25};
    const PassPlan wide{.expected = 1, .keeps_width = true};
    const PassPlan narrow{.expected = 100, .keeps_width = true};

    World room_alone(device(), room);
    Session expected(room_alone, room, settings);
    expected.begin_frame(0);
    World world(device(), above_ground);
    Session session(world, above_ground, settings);
    session.begin_frame(0);
    std::vector<std::vector<std::uint8_t>> states;
    for (const PassPlan& plan : {wide, narrow, narrow}) {
        expected.step(plan, proceed);
        session.step(plan, proceed);
        states.push_back(session.save());
    }
    const glm::dvec3 all = mean(layer(expected.result(), "indirect"));
    const RenderResult result = session.result();
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_RELATIVE(mean(layer(result, "indirect"))[channel], all[channel], 0.01);
    }
    for (const std::size_t passes : {1, 2}) { // before the decision, and after it
        Session other(world, above_ground, settings);
        other.resume(states[passes - 1], 0);
        for (std::size_t i = passes; i < 3; ++i) {
            other.step(narrow, proceed);
        }
        EXPECT_TRUE(same_bits(other.result(), result)) << passes;
    }
}

// Few photons lie in the glossy lobes of metals, which scatter very different shares of them. An
// estimate that is left out because their noise makes its light uneven has more light than the
// others.
TEST_F(Progressive, SlowPassesOfFewPhotonsKeepTheLightOfGlossySurfaces) {
    const Scene scene = load_asset("gloss_only.glb");
    const RenderResult& expected = render_once("gloss", scene, settings_of("path", 24, 512));
    for (const char* method : {"photons", "footprints", "knn"}) {
        RenderSettings settings = settings_of(method, 24, 4);
        settings.photons = settings.photons_per_pass = 10'000;
        settings.progressive = {.on = true, .first_radius = {}, .exponent = 0.25, .passes = 16};
        // It was 0.93 when photons counted alike, whatever share of them the lobe scatters.
        EXPECT_RELATIVE(mean(layer(render(scene, settings), "indirect")).g,
                        mean(layer(expected, "indirect")).g, 0.025)
            << method;
    }
}

// Most photons are aimed through the window. The others carry a hundred times as much flux, and few
// of them lie in a disc: an estimate that is left out for their sake has more light than the
// others. Sixteen passes had 0.88, 0.90 and 0.87 of the light when all counted alike.
TEST_F(Progressive, SlowPassesOfFewPhotonsKeepTheLightThroughAWindow) {
    const Scene scene = load_asset("window_room.glb");
    const RenderResult& expected = render_once("window room", scene, settings_of("path", 24, 1024));
    for (const std::string method : {"photons", "footprints", "knn"}) {
        SCOPED_TRACE(method);
        RenderSettings settings = settings_of(method, 24, 4);
        settings.photons = settings.photons_per_pass = 20'000;
        settings.progressive = {.on = true, .first_radius = {}, .exponent = 0.25, .passes = 8};
        const double found = mean(layer(render(scene, settings), "indirect")).g;
        if (method != "knn") { // whose few nearest photons have 0.93 of the light
            EXPECT_RELATIVE(found, mean(layer(expected, "indirect")).g, 0.06);
        }
        settings.least_coverage = 0; // all estimates are taken
        EXPECT_RELATIVE(found, mean(layer(render(scene, settings), "indirect")).g, 0.015);
    }
}

TEST_F(Progressive, FirstPassHasTheRadiusThatIsGivenOrLearntForOnePass) {
    const Scene scene = room_scene();
    RenderSettings settings = settings_of("progressive", 6, 1);
    settings.photons = 4'000;
    RenderSettings fixed = settings;
    fixed.method = "photons";
    EXPECT_EQ(render(scene, settings).statistics.radius, render(scene, fixed).statistics.radius);
    // Of an image of four parts it is the radius for a part, not for the image.
    fixed.photons = 1'000;
    settings.photons_per_pass = 1'000;
    EXPECT_EQ(render(scene, settings).statistics.radius,
              render(scene, fixed).statistics.radius * std::pow(4.0, -0.25));
    settings.progressive.first_radius = 0.125;
    settings.progressive.passes = 4;
    EXPECT_EQ(render(scene, settings).statistics.radius, 0.125 * std::pow(16.0, -0.25));
    // A caller may ask for the width of another pass, as pilots do.
    World world(device(), scene);
    Session session(world, scene, settings);
    session.begin_frame(0);
    for (const double expected : {1.0, 8.0}) {
        session.step({.expected = expected, .keeps_width = true}, proceed);
        EXPECT_EQ(widths(session).radius, 0.125 * std::pow(expected, -0.25));
    }
    session.step({.expected = 8}, proceed);
    EXPECT_EQ(widths(session).radius, 0.125 * std::pow(3.0, -0.25));
}

/// The error of the indirect layer after 16, 32, ... passes.
struct ErrorAfter {
    double passes = 0, variance = 0, squared_bias = 0;
};

/// A scene, and a first radius whose bias shows.
struct Start {
    const char* scene;
    double radius;
};

class ProgressiveErrors : public Progressive {
protected:
    static constexpr std::uint32_t seeds = 8;

    /// Of one bounce of light. settings.progressive.passes: a power of 2.
    std::vector<ErrorAfter> errors(const Scene& scene, RenderSettings settings) {
        RenderSettings truth = settings_of("path", settings.width, 8192);
        truth.bounces = 1;
        truth.seed = 101;
        const Image a = layer(render_once(scene.name + ", 101", scene, truth), "indirect");
        truth.seed = 202;
        const Image b = layer(render_once(scene.name + ", 202", scene, truth), "indirect");
        settings.bounces = truth.bounces;
        World world(device(), scene);
        Session session(world, scene, settings);
        std::map<std::uint64_t, std::vector<Image>> images;
        for (std::uint32_t seed = 1; seed <= seeds; ++seed) {
            session.begin_frame(seed);
            while (const std::optional<PassPlan> plan = session.next_pass()) {
                EXPECT_TRUE(session.step(*plan, proceed));
                if (session.passes() >= 16 && std::has_single_bit(session.passes())) {
                    images[session.passes()].push_back(*find_layer(session.layers(), "indirect"));
                }
            }
        }
        std::vector<ErrorAfter> found;
        for (const auto& [passes, of_seeds] : images) {
            double error = 0;
            for (const Image& image : of_seeds) {
                error += rel_mse(image, a, b) / seeds;
            }
            const double variance = rel_variance(of_seeds, a, b);
            found.push_back({static_cast<double>(passes), variance, error - variance});
            RecordProperty(std::to_string(passes),
                           fmt::format("variance {:.4g}, squared bias {:.4g}", variance,
                                       found.back().squared_bias));
        }
        return found;
    }
};

class ProgressiveError : public ProgressiveErrors, public ::testing::WithParamInterface<Start> {
protected:
    RenderSettings settings() const {
        RenderSettings settings = settings_of("progressive", 12, 1);
        settings.photons = 400;
        settings.disc = {.uniform_kernel = true, .ball = true};
        settings.progressive.first_radius = GetParam().radius;
        settings.progressive.passes = 256;
        return settings;
    }
};

/// Least-squares slope of log variance over log passes.
double slope_of_noise(const std::vector<ErrorAfter>& errors) {
    double x = 0, y = 0, xx = 0, xy = 0;
    const auto n = static_cast<double>(errors.size());
    for (const ErrorAfter& e : errors) {
        const double log_passes = std::log(e.passes), log_variance = std::log(e.variance);
        x += log_passes;
        y += log_variance;
        xx += log_passes * log_passes;
        xy += log_passes * log_variance;
    }
    return (n * xy - x * y) / (n * xx - x * x);
}

// Variance of density goes with one over the photons and one over the disc's area: n^(-1 + 2a) for
// a = 1/4. Bias falls, because the discs shrink.
TEST_P(ProgressiveError, SlowFallsAsTheLawSays) {
    RenderSettings random = settings();
    random.photon_sampling = Sampling::random; // passes are independent
    const std::vector<ErrorAfter> found = errors(load_asset(GetParam().scene), random);
    ASSERT_EQ(found.size(), 5u);
    EXPECT_NEAR(slope_of_noise(found), -0.5, 0.07);
    EXPECT_GT(found.front().squared_bias, 0);
    EXPECT_LT(found.back().squared_bias, 0.6 * found.front().squared_bias);
}

// Scrambled Sobol' points, and the points of a lattice, which a seed only moves, so that eight
// seeds tell their noise.
TEST_P(ProgressiveError, SlowFallsAtLeastAsFastWithEvenPoints) {
    for (const bool deterministic : {false, true}) {
        SCOPED_TRACE(deterministic);
        RenderSettings even = settings();
        even.deterministic = deterministic;
        const std::vector<ErrorAfter> found = errors(load_asset(GetParam().scene), even);
        ASSERT_EQ(found.size(), 5u);
        EXPECT_LT(slope_of_noise(found), -0.43);
        EXPECT_GT(found.front().squared_bias, 0);
        EXPECT_LT(found.back().squared_bias, 0.6 * found.front().squared_bias);
    }
}

// From the second pass on k is 8 and passes grow: n rises as the square of the passes i. Each pass
// has the same noise, so variance falls as 1/i. Bias goes on falling with n.
TEST_F(ProgressiveErrors, SlowFallWithPassesThatGrow) {
    RenderSettings settings = settings_of("knn", 12, 1);
    settings.photons = 100;
    settings.neighbours = 8;
    settings.photon_sampling = Sampling::random;
    settings.progressive = {.on = true, .first_radius = {}, .exponent = 0.25, .passes = 64};
    const std::vector<ErrorAfter> found = errors(load_asset("cornell_area.glb"), settings);
    ASSERT_EQ(found.size(), 3u);
    EXPECT_NEAR(slope_of_noise(found), -1, 0.2);
    EXPECT_GT(found.back().squared_bias, 0);
    EXPECT_LT(found.back().squared_bias, 0.3 * found.front().squared_bias);
}

INSTANTIATE_TEST_SUITE_P(SlowScenes, ProgressiveError,
                         ::testing::Values(Start{"closed_box.gltf", 1},
                                           Start{"cornell_area.glb", 0.4}),
                         [](const auto& test) {
                             const std::string name = test.param.scene;
                             return name.substr(0, name.find('.'));
                         });

} // namespace
} // namespace argand::testing
