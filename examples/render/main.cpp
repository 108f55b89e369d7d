// Renders a glTF scene by photon mapping: render SCENE.glb PICTURE.exr (or .png)
#include "base/error.hpp"
#include "device/device.hpp"
#include "image/files.hpp"
#include "scene/gltf.hpp"
#include "session/render.hpp"
#include <cstdio>
#include <memory>

int main(int count, char** arguments) {
    if (count != 3) {
        std::fprintf(stderr, "usage: render SCENE.glb PICTURE.exr\n");
        return 2;
    }
    try {
        const argand::Scene scene = argand::load_gltf(arguments[1]);
        const std::unique_ptr<argand::Device> device = argand::open_device();

        argand::RenderSettings settings;
        settings.width = settings.height = 128;
        settings.photons = 600'000; // three passes of at most 262,144 photons each
        const argand::RenderResult result =
            argand::render(*device, scene, settings, [](double share) {
                std::printf("%3.0f %%\n", 100 * share);
                return true; // false would stop after the pass
            });
        argand::write_image(arguments[2], result.layers);
    } catch (const argand::Error& error) {
        std::fprintf(stderr, "render: %s\n", error.what());
        return 1;
    }
}
