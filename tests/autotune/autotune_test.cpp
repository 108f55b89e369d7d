#include "autotune/autotune.hpp"
#include "base/clock.hpp"
#include "image/mean.hpp"
#include "image/metrics.hpp"
#include "methods/plan_render.hpp"
#include "support/expect_error.hpp"
#include "support/noisy_image.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <thread>

namespace argand {
namespace {

using testing::noisy;
using testing::true_radiance;

/// A fake renderer. Each pass has independent noise, of the given deviation for 16 samples. All
/// methods except `path` also have bias, which shrinks as ErrorModel predicts, and take longer.
class FakePasses {
public:
    double direct_deviation = 0; // noise of the layer `direct`, which has no bias
    double path_deviation = 1, map_deviation = 0.2, map_bias = 0.05;
    double path_seconds = 0.002, map_seconds = 0.004;
    // Maps are this much noisier after their first passes, as if those had missed rare photons.
    double hidden_noise = 1;
    std::uint64_t interrupted_after = 1'000'000;
    std::uint64_t most_passes = 1'000'000; // of one render, as if random numbers ran out

    RenderPasses passes() {
        return [this](const RenderSettings& settings, const OnPass& on_pass) {
            const bool is_path = settings.method == "path";
            const double work =
                settings.samples / 16.0; // relative to a pilot's pass of so small a picture
            RenderResult result;
            const auto pixels = static_cast<std::size_t>(settings.width * settings.height);
            const Image black{settings.width, settings.height,
                              std::vector<glm::vec3>(pixels, glm::vec3(0))};
            result.layers = {{"", black}, {"direct", black}};
            Image &mean = result.layers[0].image, &direct = result.layers[1].image;
            std::uint64_t done = 0;
            const auto layers = [&] { return result.layers; };
            while (done < most_passes) {
                const std::optional<PassPlan> plan = on_pass({done, layers});
                if (!plan) {
                    break;
                }
                streams.insert(plan->stream);
                const double bias = is_path ? 0 : map_bias * std::pow(plan->expected, -1 / 6.0);
                const double map_noise = map_deviation * (done < pilot_passes ? 1 : hidden_noise);
                const double deviation = (is_path ? path_deviation : map_noise) / std::sqrt(work);
                const Image pass = noisy(settings.width, settings.height, bias, deviation, ++seed_);
                ++done;
                const Image lamps = noisy(settings.width, settings.height, -true_radiance,
                                          direct_deviation / std::sqrt(work), seed_ + 1'000'000);
                for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
                    mean.pixels[i] += (pass.pixels[i] + lamps.pixels[i] - mean.pixels[i]) /
                                      static_cast<float>(done);
                    direct.pixels[i] +=
                        (lamps.pixels[i] - direct.pixels[i]) / static_cast<float>(done);
                }
                std::this_thread::sleep_for(
                    std::chrono::duration<double>(work * (is_path ? path_seconds : map_seconds)));
                if (++total == interrupted_after) {
                    result.statistics.interrupted = true;
                    break;
                }
            }
            result.statistics.passes = done;
            result.statistics.samples = done * settings.samples;
            methods.push_back(settings.method);
            return result;
        };
    }

    std::vector<std::string> methods; ///< of all renders; the last one is the final render
    std::set<std::uint32_t> streams;
    std::uint64_t total = 0;

private:
    std::uint32_t seed_ = 0;
};

Scene box() {
    Scene scene;
    scene.name = "box";
    scene.materials.resize(1);
    scene.cameras.resize(1);
    return scene;
}

RenderSettings small() {
    RenderSettings settings;
    settings.width = settings.height = 48;
    return settings;
}

double true_error(const Image& picture) {
    const Image truth = noisy(picture.width, picture.height, 0, 0, 0);
    return rel_mse(picture, truth, truth);
}

AutotunedRender tune(FakePasses& fake, const Scene& scene, const Target& target,
                     const UserSet& user_set = {}, const RenderSettings& settings = small()) {
    return autotune(fake.passes(), scene, settings, user_set, target,
                    [](const AutotunedRender&) {});
}

TEST(Autotune, FastestMethodReachesTheError) {
    FakePasses fake;
    // The usual bias: its square is 0.0017 at the initial bandwidth.
    fake.map_bias = 0.08;
    const AutotunedRender tuned = tune(fake, box(), {.error = 0.001, .seconds = {}});
    EXPECT_TRUE(tuned.reached());
    EXPECT_NE(fake.methods.back(), "path");
    EXPECT_EQ(fake.methods.back(), tuned.candidates.front().settings.method);
    // The number of passes depends on measured times. A witness allows a factor of 1.5.
    EXPECT_NEAR(true_error(tuned.result.layers[0].image) / 0.001, 1, 0.5);
    EXPECT_EQ(fake.streams.size(), 2u);
}

TEST(Autotune, BiasIsPartOfTheError) {
    FakePasses fake;
    fake.map_bias = 0.1;
    fake.path_deviation = 0.3;
    // Squared bias is 0.0025 at the initial bandwidth. It takes 10^5 passes to fall to the target.
    const AutotunedRender tuned = tune(fake, box(), {.error = 0.0003, .seconds = {}});
    EXPECT_TRUE(tuned.reached());
    EXPECT_EQ(fake.methods.back(), "path");
    EXPECT_NEAR(true_error(tuned.result.layers[0].image) / 0.0003, 1, 0.33);
}

TEST(Autotune, BudgetIncludesPilots) {
    FakePasses fake;
    const Clock::time_point start = Clock::now();
    const AutotunedRender tuned = tune(fake, box(), {.error = {}, .seconds = 0.6});
    const double seconds = seconds_since(start);
    EXPECT_GT(seconds, 0.45);
    EXPECT_LT(seconds, 0.9);
    ASSERT_TRUE(tuned.measured);
    EXPECT_GT(tuned.measured->noise, 0);
    EXPECT_GT(tuned.result.statistics.passes, 20u);
}

TEST(Autotune, ReportsAnErrorThatTheBudgetDoesNotAllow) {
    FakePasses fake;
    const Target target{.error = 1e-6, .seconds = 0.3};
    const AutotunedRender tuned = tune(fake, box(), target);
    EXPECT_FALSE(tuned.reached());
    EXPECT_THAT(describe_outcome(tuned), ::testing::HasSubstr("is not reached"));
}

TEST(Autotune, RefusesAnErrorThatTakesTooLong) {
    FakePasses fake;
    EXPECT_THAT(testing::error_of([&] { tune(fake, box(), {.error = 1e-9, .seconds = {}}); }),
                ::testing::HasSubstr("allow a larger error"));
}

TEST(Autotune, RefusesAtOnceAnErrorThatTheGivenMethodCannotReach) {
    FakePasses fake;
    RenderSettings settings = small();
    settings.method = "photons";
    const Clock::time_point start = Clock::now();
    EXPECT_THAT(testing::error_of([&] {
                    tune(fake, box(), {.error = 1e-7, .seconds = {}}, {.method = true}, settings);
                }),
                ::testing::HasSubstr("allow a larger error"));
    EXPECT_LT(seconds_since(start), 2);
}

TEST(Autotune, MeasuresUnusuallyLargeBias) {
    FakePasses fake;
    // A squared bias of 0.25, 150 times the usual one, of the method that the user has set.
    fake.map_bias = 1;
    fake.path_deviation = 0.3;
    RenderSettings settings = small();
    settings.method = "photons";
    const AutotunedRender tuned =
        tune(fake, box(), {.error = 0.01, .seconds = 0.5}, {.method = true}, settings);
    EXPECT_FALSE(tuned.reached());
    ASSERT_TRUE(tuned.measured);
    EXPECT_NEAR(tuned.measured->error() / true_error(tuned.result.layers[0].image), 1, 0.5);
}

TEST(Autotune, EndsInTimeIfNoiseDoesNotFall) {
    const Target target{.error = 1e-8, .seconds = {}};
    const Candidate candidate{
        .settings = small(), .model = {.fixed = 0.01}, .seconds_per_pass = 0.001, .passes = 100};
    RunControl control(target, candidate, {}, false, 0);
    const ImagePair halves{noisy(16, 16, 0, 0.5, 1), noisy(16, 16, 0, 0.5, 2)};
    Image mean = halves[0];
    for (std::uint64_t done = 0;
         const std::optional<PassPlan> plan = control({done, [&] {
                                                           return std::vector<Layer>{{"", mean}};
                                                       }});) {
        ASSERT_LT(done, 1'000'000u);
        const Image& pass = halves[plan->stream];
        for (std::size_t i = 0; i < mean.pixels.size(); ++i) {
            mean.pixels[i] = (static_cast<float>(done) * mean.pixels[i] + pass.pixels[i]) /
                             static_cast<float>(done + 1);
        }
        ++done;
    }
    EXPECT_EQ(control.outcome(), RunOutcome::too_long);
}

TEST(Autotune, NoiseOfTheFirstPassesDoesNotEndARender) {
    // A firefly in each half.
    const Target target{.error = 1e-3, .seconds = {}};
    const Candidate candidate{
        .settings = small(), .model = {.fixed = 0.01}, .seconds_per_pass = 0.001, .passes = 100};
    RunControl control(target, candidate, {}, false, 0);
    Image mean;
    std::uint64_t done = 0;
    while (const std::optional<PassPlan> plan = control({done, [&] {
                                                             return std::vector<Layer>{{"", mean}};
                                                         }})) {
        ASSERT_LT(done, 100'000u);
        Image pass = noisy(16, 16, 0, 0.3, static_cast<std::uint32_t>(done + 1));
        if (done < 2) {
            pass.pixels[done] += glm::vec3(300);
        }
        mean = done == 0 ? pass : weighted_mean(mean, static_cast<double>(done), pass, 1);
        ++done;
        // Passes that take a millisecond promise hours for such noise.
        std::this_thread::sleep_for(std::chrono::milliseconds(done < 3 ? 50 : 0));
    }
    EXPECT_EQ(control.outcome(), RunOutcome::reached);
    EXPECT_GT(done, 16u);
}

TEST(Autotune, ARenderThatIsGivenUpLeavesTheBestPicture) {
    FakePasses fake;
    fake.hidden_noise = 3000; // than any pilot has
    fake.path_deviation = 3000;
    const AutotunedRender tuned = tune(fake, box(), {.error = 0.001, .seconds = {}});
    EXPECT_EQ(tuned.outcome, RunOutcome::too_long);
    EXPECT_FALSE(tuned.reached());
    EXPECT_LT(true_error(tuned.result.layers[0].image), 0.1);
    EXPECT_FALSE(tuned.result.statistics.interrupted);
    ASSERT_TRUE(tuned.measured);
    EXPECT_NEAR(tuned.measured->error() / true_error(tuned.result.layers[0].image), 1, 0.5);
    EXPECT_THAT(describe_outcome(tuned), ::testing::HasSubstr("it would take more than 3600 s"));
}

TEST(Autotune, PilotsEndEarlyIfFewPassesSuffice) {
    FakePasses fake;
    fake.interrupted_after = pilot_passes;
    const AutotunedRender few = tune(fake, box(), {.error = 0.01, .seconds = {}});
    EXPECT_FALSE(few.candidates.empty());
    fake.total = 0;
    EXPECT_TRUE(tune(fake, box(), {.error = 0.0005, .seconds = {}}).candidates.empty());
}

TEST(Autotune, PilotContinuesAsTheFinalRenderIfNoOtherIsWorthIt) {
    FakePasses fake;
    fake.map_bias = 0.08;
    const AutotunedRender tuned = tune(fake, box(), {.error = 0.005, .seconds = {}});
    EXPECT_TRUE(tuned.reached());
    // All other renders are of the witness.
    EXPECT_EQ(std::count(fake.methods.begin(), fake.methods.end(), "path") + 1,
              static_cast<std::ptrdiff_t>(fake.methods.size()));
    EXPECT_NE(fake.methods.back(), "path");
    EXPECT_NEAR(true_error(tuned.result.layers[0].image) / 0.005, 1, 0.33);
    ASSERT_TRUE(tuned.measured);
    EXPECT_EQ(tuned.measured->passes, static_cast<double>(tuned.result.statistics.passes));
}

TEST(Autotune, PilotsEndWhenTheirShareOfTheBudgetIsSpent) {
    FakePasses fake;
    fake.map_seconds = 0.2;
    fake.path_seconds = 0.2;
    fake.map_bias = 0.08;
    const AutotunedRender tuned = tune(fake, box(), {.error = {}, .seconds = 0.9});
    ASSERT_EQ(tuned.candidates.size(), 1u);
    EXPECT_EQ(fake.methods.size(), 1u);
    EXPECT_LT(tuned.pilot_seconds, 0.35);
    EXPECT_GE(tuned.result.statistics.passes, 2u);
    EXPECT_THAT(describe_pick(tuned), ::testing::HasSubstr("unknown error"));
    // The final render measures the bias, for which the pilot was too short.
    ASSERT_TRUE(tuned.measured);
    EXPECT_GT(tuned.measured->bias.value, 0.001);
    EXPECT_NEAR(tuned.measured->error() / true_error(tuned.result.layers[0].image), 1, 0.4);
}

TEST(Autotune, InterruptedRenderReportsItsError) {
    FakePasses fake;
    fake.interrupted_after =
        pilot_passes / 2 + 1; // the target is so easy that half a pilot is enough
    const AutotunedRender tuned = tune(fake, box(), {.error = 0.005, .seconds = {}});
    EXPECT_TRUE(tuned.result.statistics.interrupted);
    EXPECT_EQ(tuned.result.statistics.passes, 3u);
    ASSERT_TRUE(tuned.measured);
    EXPECT_EQ(tuned.measured->passes, 2);
    EXPECT_THAT(describe_outcome(tuned), ::testing::HasSubstr("is not reached"));
}

TEST(Autotune, ErrorOfOnePassIsUnknown) {
    FakePasses fake;
    fake.map_seconds = 0.2;
    const AutotunedRender tuned = tune(fake, box(), {.error = {}, .seconds = 0.3});
    EXPECT_EQ(tuned.result.statistics.passes, 1u);
    EXPECT_FALSE(tuned.measured);
    EXPECT_THAT(describe_outcome(tuned), ::testing::HasSubstr("error is unknown"));
}

TEST(Autotune, ScalesUpWhateverDominatesTheNoise) {
    FakePasses fake;
    fake.path_deviation = 5;
    const auto most = [&](const Target& target) {
        // Ends the final render early, so that the time allowed can be far longer than pilots take
        // even on a busy machine.
        fake.interrupted_after = fake.total + 40;
        RenderSettings numbers;
        numbers.photons = numbers.samples = 0;
        for (const Candidate& p : tune(fake, box(), target).candidates) {
            if (p.settings.method != "path") {
                numbers.photons = std::max(numbers.photons, p.settings.photons);
                numbers.samples = std::max(numbers.samples, p.settings.samples);
            }
        }
        return numbers;
    };
    const Target in_time{.error = {}, .seconds = 10};
    const RenderSettings with_noisy_photons = most(in_time);
    EXPECT_EQ(with_noisy_photons.photons, 200'000u);
    EXPECT_EQ(with_noisy_photons.samples, 16u);
    fake.direct_deviation = 1;
    const RenderSettings with_noisy_paths = most(in_time);
    EXPECT_EQ(with_noisy_paths.photons, 50'000u);
    EXPECT_GE(with_noisy_paths.samples, 64u);
    // No more samples than the picture needs.
    const std::uint32_t few = most({.error = 0.005, .seconds = {}}).samples;
    EXPECT_GE(few, 32u);
    EXPECT_LE(few, 128u);
}

TEST(Autotune, FinalGatherExcludesPath) {
    FakePasses fake;
    fake.map_bias = 1;
    fake.path_deviation = 0.1;
    RenderSettings settings = small();
    settings.final_gather = true;
    EXPECT_NE(tune(fake, box(), {.error = {}, .seconds = 0.5}, {}, settings)
                  .candidates.front()
                  .settings.method,
              "path");
    settings.final_gather = false;
    EXPECT_EQ(tune(fake, box(), {.error = {}, .seconds = 0.5}, {}, settings)
                  .candidates.front()
                  .settings.method,
              "path");
}

TEST(Autotune, KeepsTheMethodAndTheNumbersThatTheUserSet) {
    FakePasses fake;
    RenderSettings settings = small();
    settings.method = "knn";
    settings.samples = 2;
    settings.photons = 1234;
    const AutotunedRender tuned =
        tune(fake, box(), {.error = 0.002, .seconds = {}},
             {.method = true, .samples = true, .photons = true}, settings);
    EXPECT_EQ(fake.methods.back(), "knn");
    EXPECT_EQ(tuned.candidates.front().settings.photons, 1234u);
    EXPECT_EQ(tuned.candidates.front().settings.samples, 2u);
}

TEST(Autotune, InterruptedPilotsLeaveTheBestResult) {
    FakePasses fake;
    fake.map_bias = 0.08;
    fake.interrupted_after = 3;
    const AutotunedRender first = tune(fake, box(), {.error = 0.0005, .seconds = {}});
    EXPECT_TRUE(first.result.statistics.interrupted);
    EXPECT_EQ(first.result.statistics.passes, 3u);
    EXPECT_EQ(first.settings.method, fake.methods.back());
    EXPECT_TRUE(first.candidates.empty());
    // Two passes are complete, and tell their error.
    ASSERT_TRUE(first.measured);
    EXPECT_NEAR(first.measured->error() / true_error(first.result.layers[0].image), 1, 0.6);
    EXPECT_THAT(describe_outcome(first), ::testing::HasSubstr("while methods were tried"));
    fake.total = 0;
    fake.interrupted_after = pilot_passes + 1;
    const AutotunedRender second = tune(fake, box(), {.error = 0.0005, .seconds = {}});
    EXPECT_TRUE(second.result.statistics.interrupted);
    EXPECT_EQ(second.result.statistics.passes, pilot_passes);
    EXPECT_NE(second.settings.method, fake.methods.back());
    fake.total = 0;
    fake.interrupted_after = 1;
    const AutotunedRender none = tune(fake, box(), {.error = 0.0005, .seconds = {}});
    EXPECT_EQ(none.result.statistics.passes, 1u);
    EXPECT_FALSE(none.measured);
    EXPECT_THAT(describe_outcome(none), ::testing::HasSubstr("error is unknown"));
}

TEST(Autotune, RenderThatIsInterruptedEarlyLeavesTheBestPilot) {
    // Pilots have far more samples in all than the first passes of the final render.
    FakePasses fake;
    fake.direct_deviation = 1;
    fake.map_bias = 0.02;
    const Target target{.error = 1e-5, .seconds = {}};
    const AutotunedRender tuned =
        autotune(fake.passes(), box(), small(), {}, target, [&](const AutotunedRender&) {
            fake.interrupted_after = std::min(fake.interrupted_after, fake.total + 1);
        });
    EXPECT_FALSE(tuned.candidates.empty());
    EXPECT_TRUE(tuned.result.statistics.interrupted);
    EXPECT_EQ(tuned.result.statistics.passes, pilot_passes);
    EXPECT_NE(tuned.settings.method, "path"); // whose pilot has more error
    ASSERT_TRUE(tuned.measured);
    EXPECT_NEAR(tuned.measured->error() / true_error(tuned.result.layers[0].image), 1, 0.5);
    EXPECT_THAT(describe_outcome(tuned), ::testing::HasSubstr("is not reached"));
}

TEST(Autotune, TriesOtherMethodsWhenRandomNumbersRunOut) {
    FakePasses fake;
    fake.most_passes = pilot_passes - 1;
    const AutotunedRender tuned = tune(fake, box(), {.error = 0.0005, .seconds = {}});
    EXPECT_GT(fake.methods.size(), 2u);
    EXPECT_GT(tuned.candidates.size(), 1u);
    EXPECT_EQ(tuned.result.statistics.passes, pilot_passes - 1);
    EXPECT_FALSE(tuned.reached());
}

Scene with_point_light_and_mirror() {
    Scene scene = box();
    scene.lights.push_back(Light{});
    scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    scene.normals.resize(3, glm::vec3(0));
    scene.triangles = {{0, 1, 2}};
    scene.triangle_material = {0};
    scene.materials[0].metallic = 1;
    scene.materials[0].roughness = 0;
    return scene;
}

TEST(Autotune, PathIsBlindToCausticsOfDeltaLights) {
    Scene scene = with_point_light_and_mirror();
    EXPECT_TRUE(is_blind_to_caustics(scene));
    FakePasses fake;
    tune(fake, scene, {.error = 0.002, .seconds = {}});
    EXPECT_EQ(std::count(fake.methods.begin(), fake.methods.end(), "path"), 0);
    RenderSettings settings = small();
    settings.method = "path";
    EXPECT_THAT(testing::error_of([&] {
                    tune(fake, scene, {.error = 0.002, .seconds = {}}, {.method = true}, settings);
                }),
                ::testing::HasSubstr("leave --method out"));
    scene.materials[0].roughness = 1;
    EXPECT_FALSE(is_blind_to_caustics(scene));
    scene = with_point_light_and_mirror();
    scene.lights.clear();
    EXPECT_FALSE(is_blind_to_caustics(scene));
}

/// Far more bias than the noise of photons suggests: a squared bias of 0.09, where 0.002 is usual.
/// Pilots for large errors are too short to measure it.
FakePasses with_hidden_bias() {
    FakePasses fake;
    fake.map_bias = 0.6;
    return fake;
}

TEST(Autotune, WitnessConfirmsASmallBias) {
    FakePasses fake;
    fake.map_bias = 0.08;
    const AutotunedRender tuned = tune(fake, box(), {.error = 0.005, .seconds = {}});
    EXPECT_TRUE(tuned.reached());
    EXPECT_EQ(tuned.witness, "path");
    EXPECT_NE(tuned.settings.method, "path");
    EXPECT_LT(true_error(tuned.result.layers[0].image), 1.5 * 0.005);
    EXPECT_THAT(describe_outcome(tuned), ::testing::HasSubstr("confirmed by 'path'"));
}

TEST(Autotune, WitnessRefutesAHiddenBias) {
    FakePasses fake = with_hidden_bias();
    RenderSettings settings = small();
    settings.method = "photons";
    const AutotunedRender tuned =
        tune(fake, box(), {.error = 0.02, .seconds = 0.5}, {.method = true}, settings);
    EXPECT_FALSE(tuned.reached());
    EXPECT_EQ(tuned.settings.method, "photons");
    ASSERT_TRUE(tuned.measured);
    EXPECT_NEAR(tuned.measured->error() / true_error(tuned.result.layers[0].image), 1, 0.5);
}

TEST(Autotune, RendersWithTheWitnessIfThatIsFaster) {
    FakePasses fake = with_hidden_bias();
    const AutotunedRender tuned = tune(fake, box(), {.error = 0.02, .seconds = {}});
    EXPECT_TRUE(tuned.reached());
    EXPECT_EQ(tuned.settings.method, "path");
    EXPECT_EQ(tuned.candidates.front().settings.method, "path");
    EXPECT_GT(tuned.candidates[1].error, 0.02);
    EXPECT_LT(true_error(tuned.result.layers[0].image), 1.5 * 0.02);
}

TEST(Autotune, OverdueRenderGoesOnWithTheWitnessIfThatIsFaster) {
    FakePasses fake;
    fake.hidden_noise = 20;
    const AutotunedRender tuned = tune(fake, box(), {.error = 0.002, .seconds = {}});
    EXPECT_TRUE(tuned.reached());
    EXPECT_EQ(tuned.settings.method, "path");
    ASSERT_GE(tuned.candidates.size(), 2u);
    EXPECT_NE(tuned.candidates[1].settings.method, "path");
    EXPECT_GT(tuned.candidates[1].error, 0.002);
    EXPECT_LT(true_error(tuned.result.layers[0].image), 1.5 * 0.002);
}

TEST(Autotune, OverdueRenderGoesOnIfTheWitnessIsNoFaster) {
    FakePasses fake;
    fake.hidden_noise = 20;
    fake.path_deviation = 20;
    const AutotunedRender tuned = tune(fake, box(), {.error = 0.002, .seconds = 4});
    EXPECT_EQ(tuned.outcome, RunOutcome::unfinished);
    EXPECT_NE(tuned.settings.method, "path");
    // A pilot, and the passes that the witness lacked.
    EXPECT_EQ(std::count(fake.methods.begin(), fake.methods.end(), "path"), 2);
}

TEST(Autotune, SaysWhatNoWitnessCouldConfirm) {
    FakePasses fake;
    fake.map_bias = 0.08;
    fake.path_deviation = 50;
    fake.path_seconds = 0.02;
    const AutotunedRender tuned = tune(fake, box(), {.error = 0.005, .seconds = 0.5});
    EXPECT_EQ(tuned.outcome, RunOutcome::unconfirmed);
    EXPECT_FALSE(tuned.reached());
    EXPECT_THAT(describe_outcome(tuned), ::testing::HasSubstr("could not be confirmed by 'path'"));
}

TEST(Autotune, WhereTheUnbiasedMethodIsBlindNarrowPassesAreTheWitness) {
    const Scene scene = with_point_light_and_mirror();
    FakePasses fake;
    fake.map_bias = 0.08;
    const AutotunedRender small_bias = tune(fake, scene, {.error = 0.005, .seconds = {}});
    EXPECT_TRUE(small_bias.reached());
    EXPECT_EQ(small_bias.witness, small_bias.settings.method);
    fake = with_hidden_bias();
    const AutotunedRender large_bias = tune(fake, scene, {.error = 0.02, .seconds = {}});
    EXPECT_LT(true_error(large_bias.result.layers[0].image), 1.5 * 0.02);
    EXPECT_GT(large_bias.result.statistics.passes, 50u);
    EXPECT_EQ(std::count(fake.methods.begin(), fake.methods.end(), "path"), 0);
}

TEST(Autotune, ExplainsThePick) {
    FakePasses fake;
    const Target target{.error = 1e-4, .seconds = 0.5};
    std::string pick;
    autotune(fake.passes(), box(), small(), {}, target,
             [&](const AutotunedRender& picked) { pick = describe_pick(picked); });
    EXPECT_THAT(pick, ::testing::HasSubstr("expects relMSE"));
    EXPECT_THAT(pick, ::testing::HasSubstr("pilots took"));
    EXPECT_THAT(pick, ::testing::HasSubstr("not "));
}

} // namespace
} // namespace argand
