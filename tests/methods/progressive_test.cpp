// Progressive photon mapping: the formula, the sequence of widths, and the error that falls with
// them.
#include "rendering.hpp"

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
            const auto pass = static_cast<double>(session.passes());
            first = session.passes() == 1 ? now : first;
            const double by = std::pow(pass, -0.2);
            EXPECT_EQ(now.radius, first.radius * by);
            EXPECT_EQ(now.caustic_radius, first.caustic_radius * by);
            EXPECT_EQ(now.smoothing, first.smoothing * by);
            EXPECT_EQ(now.neighbours, std::max(std::round(first.neighbours * by * by),
                                               std::min<double>(8, first.neighbours)));
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

class ProgressiveError : public Progressive, public ::testing::WithParamInterface<Start> {
protected:
    static constexpr std::uint64_t most_passes = 256;
    static constexpr std::uint32_t seeds = 8;

    std::vector<ErrorAfter> errors(const Scene& scene) {
        RenderSettings truth = settings_of("path", 12, 8192);
        truth.bounces = 1;
        truth.seed = 101;
        const Image a = layer(render(scene, truth), "indirect");
        truth.seed = 202;
        const Image b = layer(render(scene, truth), "indirect");
        RenderSettings settings = settings_of("progressive", 12, 1);
        settings.photons = 400;
        settings.bounces = truth.bounces;
        settings.photon_sampling = Sampling::random; // passes are independent
        settings.disc = {.uniform_kernel = true, .ball = true};
        settings.progressive.first_radius = GetParam().radius;
        settings.progressive.passes = most_passes;
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
        }
        return found;
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
    const std::vector<ErrorAfter> found = errors(load_asset(GetParam().scene));
    ASSERT_EQ(found.size(), 5u);
    for (const ErrorAfter& e : found) {
        RecordProperty(
            std::to_string(int(e.passes)),
            fmt::format("variance {:.4g}, squared bias {:.4g}", e.variance, e.squared_bias));
    }
    EXPECT_NEAR(slope_of_noise(found), -0.5, 0.07);
    EXPECT_GT(found.front().squared_bias, 0);
    EXPECT_LT(found.back().squared_bias, 0.6 * found.front().squared_bias);
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
