// What later frames of a film may no longer do: allocate memory and compile kernels.
#include "moving_scene.hpp"
#include "rendering.hpp"
#include "support/recording_device.hpp"
#include "world/world.hpp"

namespace argand::testing {
namespace {

/// Renders frames at these times on a device that is new, and expects that those from number
/// `settled` on neither allocate nor compile.
void expect_settled(Device& device, Scene scene, const RenderSettings& settings,
                    const std::vector<double>& times, std::size_t settled) {
    RecordingDevice recording(device);
    World world(recording, scene);
    Session session(world, scene, settings);
    std::uint64_t allocations = 0;
    std::size_t variants = 0;
    for (std::size_t frame = 0; frame < times.size(); ++frame) {
        move_to(times[frame], scene);
        world.update(scene);
        session.begin_frame(0); // the memory for photons depends on the seed
        finish(session, [](double) { return true; });
        if (frame >= settled) {
            EXPECT_EQ(device.blocks().allocations, allocations) << frame;
            EXPECT_EQ(recording.variants().size(), variants) << frame;
        }
        allocations = device.blocks().allocations;
        variants = recording.variants().size();
    }
    EXPECT_LE(device.blocks().bytes, 3 * device.memory().peak);
}

class Frames : public EveryMethod {
protected:
    RenderSettings small() const {
        RenderSettings settings = settings_of(GetParam(), 16, 4);
        settings.photons = 6'000;
        settings.photons_per_pass = 3'000;
        return settings;
    }
};

// How many leaves a map has depends on the photons, and so do the blocks that the first frames
// take.
TEST_P(Frames, AfterTheThirdAllocateAndCompileNothing) {
    Scene scene = moving_scene();
    scene.motion.meshes.clear();
    std::vector<double> times;
    for (int frame = 0; frame < 8; ++frame) {
        times.push_back(frame / 8.0);
    }
    expect_settled(open_anew(), scene, small(), times, 3);
}

TEST_P(Frames, AllocateAndCompileNothingForSurfacesAndLightsSeenBefore) {
    const std::vector<double> again_and_again{0.9, 0.3, 0.6, 0.9, 0.3, 0.6, 0.9};
    for (const Scene& scene : {moving_scene(), changing_scene()}) {
        SCOPED_TRACE(scene.name);
        expect_settled(open_anew(), scene, small(), again_and_again, 4);
    }
}

INSTANTIATE_METHODS(Frames);

class ManyFrames : public RenderTest {
protected:
    void expect_settled_for(int frames, const std::string& method) {
        RenderSettings settings = settings_of(method, 4, 1);
        settings.photons = 300;
        std::vector<double> times;
        times.reserve(static_cast<std::size_t>(frames));
        for (int frame = 0; frame < frames; ++frame) {
            times.push_back(frame % 5 / 5.0);
        }
        Scene scene = moving_scene();
        scene.materials[0].emission = glm::vec3(0.5f); // of the meshes that move
        expect_settled(open_anew(), scene, settings, times, 10);
    }
};

TEST_F(ManyFrames, SlowAThousandAllocateAndCompileNothing) { expect_settled_for(1000, "path"); }

TEST_F(ManyFrames, SlowOfAPhotonMapAllocateAndCompileNothing) {
    expect_settled_for(100, "photons");
}

} // namespace
} // namespace argand::testing
