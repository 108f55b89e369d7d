#include "base/error.hpp"
#include "compare/backends.hpp"
#include "compare/paired_device.hpp"
#include "device/host/host_device.hpp"
#include "device_fixture.hpp"
#include "scene/gltf.hpp"
#include "session/render.hpp"

#include <cstring>
#include <filesystem>

namespace argand {
namespace {

RenderSettings small(const std::string& method) {
    RenderSettings settings;
    settings.method = method;
    settings.width = 24;
    settings.height = 24;
    settings.samples = 2;
    settings.photons = 5000;
    return settings;
}

/// Covers an area light, diffuse surfaces, glass, and a body that moves.
bool is_quick(const std::string& scene) {
    const std::string name = scene.substr(0, scene.find('.'));
    return name == "cornell_glass" || name == "dynamic_block";
}

/// The methods whose kernels differ, for other scenes than the quick ones.
const std::vector<std::string> different_methods = {"footprints", "knn", "photon-queue", "path"};

std::vector<std::string> scenes_that(bool quick) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(ARGAND_SOURCE_DIR "/assets")) {
        const std::string extension = entry.path().extension();
        if ((extension == ".glb" || extension == ".gltf") &&
            is_quick(entry.path().filename()) == quick) {
            names.push_back(entry.path().filename());
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

class Backends : public DeviceTest, public ::testing::WithParamInterface<std::string> {
protected:
    host::HostDevice host_{host::describe()};
};

/// Expects the same picture, and of each stage the same words where both devices round alike.
void expect_agreement(const BackendComparison& found, const Device& device,
                      const std::string& what) {
    EXPECT_TRUE(passes(found)) << what << ", relMSE " << found.rel_mse;
    for (const StageComparison& stage : found.isolated) {
        // lavapipe and the host round alike.
        const bool same_bits = device.info().kind != DeviceKind::cpu || stage.unequal == 0;
        EXPECT_TRUE(same_bits && passes_isolated(stage))
            << what << ": " << stage.name << ", " << stage.unequal << " unequal, " << stage.diverged
            << " diverged of " << stage.items;
    }
}

/// dynamic_block.glb, whose block is morphed, and skinned by its node and one that rests.
Scene skinned_block() {
    Scene scene = load_gltf(ARGAND_SOURCE_DIR "/assets/dynamic_block.glb");
    MovingMesh& block = scene.motion.meshes.at(0);
    MotionNode& carrier = scene.motion.nodes[block.node];
    carrier.keys.weights = KeyFrames{.times = {0, 1}, .values = {0, 1}};
    carrier.weights = {0};
    const auto resting = static_cast<std::uint32_t>(scene.motion.nodes.size());
    scene.motion.nodes.emplace_back().rest.translation = glm::dvec3(0, 1.3, 0.2);
    scene.motion.skins.push_back(
        {.joints = {block.node, resting}, .joint_from_mesh = {glm::dmat4(1), glm::dmat4(1)}});
    block.skin = 0;
    MorphTarget& wider = block.targets.emplace_back();
    for (const glm::vec3& position : block.positions) {
        const float share = position.x > 0 ? 0.7f : 0.1f;
        block.joint_weights.push_back({.joints = {0, 1}, .weights = {1 - share, share}});
        wider.positions.emplace_back(0.3f * position.x, 0, 0.1f);
    }
    return scene;
}

TEST_P(Backends, AgreeOnEveryStage) {
    Device& device = open();
    const Scene scene = GetParam() == "skinned_block"
                            ? skinned_block()
                            : load_gltf(ARGAND_SOURCE_DIR "/assets/" + GetParam());
    const Bounds box = bounds(scene);
    const double across = glm::distance(box.low, box.high);
    for (const std::string& method : is_quick(GetParam()) ? method_names() : different_methods) {
        RenderSettings settings = small(method);
        if (!is_quick(GetParam())) {
            settings.width = settings.height = 16;
            settings.photons = 2500;
        }
        if (across > 20) {
            // A room's small discs ask for a million area samples on all of its surroundings, which
            // would be compared after every command on them.
            settings.radius = 0.1 * across;
        }
        const BackendComparison found = compare_backends(device, host_, scene, settings);
        expect_agreement(found, device, method);
        EXPECT_GT(found.isolated.size(), 10u);
        const bool refits =
            std::any_of(found.isolated.begin(), found.isolated.end(),
                        [](const StageComparison& stage) { return stage.name == "ray_refit"; });
        EXPECT_EQ(refits, !scene.motion.meshes.empty());
    }
}

std::string name_of(const ::testing::TestParamInfo<std::string>& scene) {
    return scene.param.substr(0, scene.param.find('.'));
}

INSTANTIATE_TEST_SUITE_P(Assets, Backends, ::testing::ValuesIn(scenes_that(true)), name_of);
INSTANTIATE_TEST_SUITE_P(SlowSkinned, Backends, ::testing::Values("skinned_block"), name_of);
INSTANTIATE_TEST_SUITE_P(SlowAssets, Backends, ::testing::ValuesIn(scenes_that(false)), name_of);

class EstimatesOfBackends : public DeviceTest {
protected:
    host::HostDevice host_{host::describe()};
};

TEST_F(EstimatesOfBackends, AgreeOnSimultaneousQueries) {
    Device& device = open();
    const Scene scene = load_gltf(ARGAND_SOURCE_DIR "/assets/cornell_glass.glb");
    for (const std::string method : {"photons", "footprints"}) {
        RenderSettings settings = small(method);
        settings.query = QuerySearch::simultaneous;
        if (method == "photons") {
            // Parts of levels wait, and photons come in several batches.
            settings.photons = 1500;
            settings.frontier.memory = least_frontier_memory;
        }
        const BackendComparison found = compare_backends(device, host_, scene, settings);
        expect_agreement(found, device, method);
        EXPECT_TRUE(std::any_of(
            found.isolated.begin(), found.isolated.end(),
            [](const StageComparison& stage) { return stage.name == "frontier_copy"; }));
    }
}

TEST_F(EstimatesOfBackends, AgreeOnSplats) {
    Device& device = open();
    RenderSettings settings = small("image-space");
    settings.photons = 1500;
    settings.own = {{"estimate", "splats"}, {"map-size", "32"}};
    const BackendComparison found = compare_backends(
        device, host_, load_gltf(ARGAND_SOURCE_DIR "/assets/cornell_glass.glb"), settings);
    expect_agreement(found, device, "splats");
    EXPECT_TRUE(
        std::any_of(found.isolated.begin(), found.isolated.end(), [](const StageComparison& stage) {
            return stage.name == "photon_footprints";
        }));
}

/// A device that writes a wrong word after one kernel.
class FaultyDevice final : public host::HostDevice {
public:
    FaultyDevice(std::string kernel, std::size_t binding)
        : HostDevice(host::describe()), kernel_(std::move(kernel)), binding_(binding) {}

    void dispatch(const KernelInfo& kernel, const KernelArguments& arguments,
                  std::uint64_t threads) override {
        HostDevice::dispatch(kernel, arguments, threads);
        if (kernel.name == kernel_) {
            host::words_of(BufferView(*arguments.buffers[binding_])).front() ^= 0x00800000u;
        }
    }

private:
    std::string kernel_;
    std::size_t binding_;
};

class Faults : public DeviceTest {};

TEST_F(Faults, AreFoundOnlyInTheirStage) {
    const Scene scene = load_gltf(ARGAND_SOURCE_DIR "/assets/cornell_area.glb");
    const std::pair<const char*, std::size_t> faults[] = {
        {"photon_codes", 3}, {"photon_boxes", 4}, {"query_cells", 6}};
    for (const auto& [kernel, binding] : faults) {
        SCOPED_TRACE(kernel);
        host::HostDevice good(host::describe());
        FaultyDevice bad(kernel, binding);
        PairedDevice pair(good, bad, Pairing::isolated);
        render(pair, scene, small("photons"), [](double) { return true; });
        bool found = false;
        for (const StageComparison& stage : pair.comparisons()) {
            EXPECT_EQ(stage.unequal > 0, stage.name == kernel) << stage.name;
            found = found || stage.name == kernel;
        }
        EXPECT_TRUE(found) << "kernel " << kernel;
    }
}

/// A device whose kernels fail.
class BreakingDevice final : public host::HostDevice {
public:
    BreakingDevice() : HostDevice(host::describe()) {}

    void dispatch(const KernelInfo&, const KernelArguments&, std::uint64_t) override {
        throw DeviceFault("test", "broken");
    }
    void end_stage() override { throw DeviceFault("test", "broken still"); }
};

TEST_F(Faults, OfADeviceAreReportedOnce) {
    const Scene scene = load_gltf(ARGAND_SOURCE_DIR "/assets/cornell_area.glb");
    BreakingDevice device;
    try {
        render(device, scene, small("photons"), [](double) { return true; });
        ADD_FAILURE() << "no fault was reported";
    } catch (const DeviceFault& fault) {
        EXPECT_STREQ(fault.what(), "broken");
    }
}

TEST_F(Faults, ReachTheImageIfNotCorrected) {
    const Scene scene = load_gltf(ARGAND_SOURCE_DIR "/assets/cornell_area.glb");
    host::HostDevice good(host::describe());
    FaultyDevice bad("film_add", 2);
    EXPECT_FALSE(passes(compare_backends(good, bad, scene, small("path"))));
}

} // namespace
} // namespace argand
