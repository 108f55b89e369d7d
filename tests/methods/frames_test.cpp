// What later frames of a film may no longer do: allocate memory and compile kernels.
#include "moving_scene.hpp"
#include "rendering.hpp"
#include "support/recording_device.hpp"
#include "world/world.hpp"

namespace argand::testing {
namespace {

class Frames : public EveryMethod {
protected:
    void expect_none_allocates(Scene scene) {
        // Nothing is free at first, and the device's other tests must not be asked for more.
        Device& device = open_anew();
        RecordingDevice recording(device);
        RenderSettings settings = settings_of(GetParam(), 16, 4);
        settings.photons = 6'000;
        settings.photons_per_pass = 3'000;
        World world(recording, scene);
        Session session(world, scene, settings);
        std::uint64_t allocations = 0;
        std::size_t variants = 0;
        for (std::uint32_t frame = 0; frame < 12; ++frame) {
            // There and back, so that all kinds of light and surface were seen.
            move_to(frame == 0 ? 1.0 : 0.1 + 0.8 * std::abs(std::sin(frame)), scene);
            world.update(scene);
            session.begin_frame(frame);
            finish(session, [](double) { return true; });
            if (frame >= 2) {
                EXPECT_EQ(device.blocks().allocations, allocations) << frame;
                EXPECT_EQ(recording.variants().size(), variants) << frame;
            }
            allocations = device.blocks().allocations;
            variants = recording.variants().size();
        }
    }
};

TEST_P(Frames, AfterTheSecondAllocateAndCompileNothing) { expect_none_allocates(moving_scene()); }

TEST_P(Frames, AfterTheSecondAllocateAndCompileNothingWhereLightsAndMaterialsChange) {
    expect_none_allocates(changing_scene());
}

INSTANTIATE_METHODS(Frames);

} // namespace
} // namespace argand::testing
