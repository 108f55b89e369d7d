#include "methods/scenes.hpp"
#include "scene/gltf.hpp"
#include "sweep/fake.hpp"

#include <set>

namespace argand::testing {
namespace {

using ::testing::Contains;
using ::testing::IsSupersetOf;
using ::testing::Not;

Scene asset(const std::string& name) { return load_gltf(ARGAND_SOURCE_DIR "/assets/" + name); }

LearntBandwidths learnt() {
    RenderStatistics statistics;
    statistics.radius = 0.25;
    statistics.neighbours = 50;
    statistics.smoothing = 1;
    return {{"footprints", statistics}, {"photons", statistics}, {"knn", statistics}};
}

std::set<std::string> swept_options(const Scene& scene, const std::string& method,
                                    Extent extent = Extent::full, const RenderSettings& base = {}) {
    std::set<std::string> names;
    for (const Setting& setting : sweep(scene, base, {method}, learnt(), extent)) {
        EXPECT_EQ(setting.render.method, method);
        names.insert(setting.option);
    }
    return names;
}

TEST(Sweep, VariesEveryOptionOfAMethod) {
    const Scene glass = asset("cornell_glass.glb");
    EXPECT_EQ(swept_options(glass, "path"), (std::set<std::string>{"default", "spp", "bounces"}));
    EXPECT_THAT(swept_options(glass, "photons"),
                IsSupersetOf({"default", "spp", "photons", "radius", "query-cell", "leaf-size",
                              "wide-codes", "photon-sampling", "final-gather", "bounces"}));
    EXPECT_THAT(swept_options(glass, "knn"), Contains("k"));
    EXPECT_THAT(swept_options(glass, "photons"), Not(Contains("k")));
    EXPECT_THAT(swept_options(glass, "footprints"),
                IsSupersetOf({"smoothing", "caustic-smoothing", "flatness", "uniform-kernel",
                              "paper-axes", "paper-reemission"}));
}

TEST(Sweep, VariesOneOptionAtATime) {
    const std::vector<Setting> settings =
        sweep(asset("cornell_glass.glb"), {}, method_names(), learnt(), Extent::full);
    std::set<std::string> keys;
    for (const Setting& setting : settings) {
        EXPECT_TRUE(keys.insert(parameter_key(setting.render)).second)
            << parameter_key(setting.render);
        RenderSettings base;
        base.method = setting.render.method;
        const auto changed = parameters(setting.render), usual = parameters(base);
        ASSERT_EQ(changed.size(), usual.size());
        for (std::size_t i = 0; i < changed.size(); ++i) {
            EXPECT_EQ(changed[i] != usual[i], changed[i].first == setting.option)
                << parameter_key(setting.render);
        }
    }
}

TEST(Sweep, LeavesOutCausticOptionsWithoutMirrorOrGlass) {
    EXPECT_THAT(swept_options(asset("cornell_area.glb"), "footprints"),
                Not(Contains("caustic-smoothing")));
}

TEST(Sweep, VariesRoughnessOnlyIfItChangesTheFollowedLobes) {
    EXPECT_THAT(swept_options(asset("cornell_area.glb"), "photons"),
                Not(Contains("follow-roughness")));
    EXPECT_THAT(swept_options(asset("glossy.glb"), "photons"), Contains("follow-roughness"));
}

TEST(Sweep, VariesNothingInAnUnlitScene) {
    Scene dark;
    add_floor(dark, 1, 0, add_material(dark, lambertian(glm::vec3(0.5f))));
    EXPECT_EQ(swept_options(dark, "footprints"), std::set<std::string>{"default"});
    EXPECT_EQ(swept_options(dark, "path"), std::set<std::string>{"default"});
}

TEST(Sweep, LeavesOutPhotonOptionsIfNothingIsEstimated) {
    Scene scene;
    scene.sky = glm::vec3(1);
    add_floor(scene, 1, 0, add_material(scene, mirror()));
    EXPECT_EQ(swept_options(scene, "photons"), (std::set<std::string>{"default", "spp"}));
}

TEST(Sweep, LeavesOutEstimationOptionsWithoutPhotons) {
    RenderSettings none;
    none.photons = 0;
    EXPECT_EQ(swept_options(asset("cornell_area.glb"), "photons", Extent::full, none),
              (std::set<std::string>{"default", "spp", "photons", "bounces"}));
}

TEST(Sweep, IgnoresAMethodNamedTwice) {
    const Scene scene = asset("cornell_area.glb");
    const auto count = [&](const std::vector<std::string>& methods) {
        return sweep(scene, {}, methods, learnt(), Extent::quick).size();
    };
    EXPECT_EQ(count({"path", "path"}), count({"path"}));
    EXPECT_EQ(count({"path", "knn", "path"}), count({"path", "knn"}));
}

TEST(Sweep, QuickVariesFewerOptions) {
    const Scene scene = asset("cornell_area.glb");
    EXPECT_EQ(swept_options(scene, "knn", Extent::quick),
              (std::set<std::string>{"default", "spp", "photons", "radius", "k"}));
}

TEST(Parameters, AreOptionsOfArgandRender) {
    RenderSettings settings;
    settings.method = "footprints";
    EXPECT_EQ(command_options(settings), "--method footprints");
    settings.photons = 5;
    settings.radius = 0.125;
    settings.footprints.uniform_kernel = true;
    EXPECT_EQ(command_options(settings),
              "--method footprints --photons 5 --radius 0.125 --uniform-kernel");
}

} // namespace
} // namespace argand::testing
