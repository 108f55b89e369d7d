// Depth of field by a thin lens.
#include "methods/lens.hpp"

#include "rendering.hpp"
#include "world/world.hpp"

#include <cmath>

namespace argand::testing {
namespace {

class Lens : public EveryMethod {};

/// Mean place and variance of an image's light, in pixels.
struct Spot {
    double light = 0;
    glm::dvec2 mean{0}, variance{0};
};

Spot spot_of(const Image& image) {
    Spot spot;
    glm::dvec2 squares(0);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const double light = image.pixels[static_cast<std::size_t>(y * image.width + x)].g;
            const glm::dvec2 place(x + 0.5, y + 0.5);
            spot.light += light;
            spot.mean += light * place;
            squares += light * place * place;
        }
    }
    spot.mean /= spot.light;
    spot.variance = squares / spot.light - spot.mean * spot.mean;
    return spot;
}

// The image of a small lamp behind the plane of focus is a disc: the lens, seen from the lamp, on
// the image plane. Blur moves light, and neither adds nor takes any.
TEST_P(Lens, SmallLampBecomesADisc) {
    constexpr double distance = 4, focus = 2.5, aperture = 0.3;
    constexpr int size = 48;
    Scene scene;
    const std::uint32_t lamp = add_material(scene, emitter(glm::vec3(5)));
    add_quad(scene, {-0.05f, -0.05f, -4}, {0.1f, 0, 0}, {0, 0.1f, 0}, lamp);
    scene.cameras = {look_at({0, 0, 0}, {0, 0, -1}, 30)};
    RenderSettings settings = settings_of(GetParam(), size, 256);
    settings.photons = 0;
    const Spot sharp = spot_of(layer(render(scene, settings), ""));
    settings.aperture = aperture;
    settings.focus = focus;
    const Spot blurred = spot_of(layer(render(scene, settings), ""));
    EXPECT_RELATIVE(blurred.light, sharp.light, 0.01);
    const double disc = 0.5 * aperture * (distance - focus) / focus; // radius at the lamp
    const double pixels = size / (2 * std::tan(0.5 * 30 * double(pi) / 180) * distance);
    // Variances add up: of the lamp, of the disc, and of places within a pixel.
    const double variance =
        std::pow(0.1 * pixels, 2) / 12 + std::pow(disc * pixels, 2) / 4 + 1.0 / 12;
    for (int axis = 0; axis < 2; ++axis) {
        EXPECT_NEAR(blurred.mean[axis], 0.5 * size, 0.1);
        EXPECT_RELATIVE(blurred.variance[axis], variance, 0.02);
    }
    settings.focus.reset(); // on the lamp, which is in the middle
    const Spot focused = spot_of(layer(render(scene, settings), ""));
    EXPECT_RELATIVE(focused.variance.x, sharp.variance.x, 0.02);
}

// A lens changes what pixels see, not how light arrives there.
TEST_P(Lens, EveryMethodSeesTheSame) {
    const Scene scene = load_asset("cornell_area.glb");
    RenderSettings settings = settings_of(GetParam(), 16, 64);
    settings.own.clear();
    settings.photons = 200'000;
    settings.aperture = 0.3;
    settings.focus = 1.5;
    RenderSettings of_truth = settings;
    of_truth.method = "path";
    of_truth.samples = 2048;
    of_truth.seed = 1;
    const RenderResult& truth = render_once("lens", scene, of_truth);
    const RenderResult found = render(scene, settings);
    expect_same_layers(found, truth, 0.03);
    const auto error = [&](const RenderResult& result) {
        return compare(layer(result, ""), layer(truth, "")).rel_mse;
    };
    settings.aperture = 0;
    EXPECT_LT(2 * error(found), error(render(scene, settings)));
}

class Focus : public RenderTest {
protected:
    double focus_of(const Scene& scene) {
        const RenderSettings settings = settings_of("path", 9, 1);
        World world(device(), scene);
        const CameraRecord camera = camera_record(scene.cameras[0], 9, 9);
        return middle_distance(device(), world.on_device(scene, make_plan(scene, {})), camera, 9,
                               9);
    }
};

TEST_F(Focus, IsOnWhatIsInTheMiddle) {
    Scene scene;
    const std::uint32_t white = add_material(scene, lambertian(glm::vec3(0.5f)));
    add_quad(scene, {-1, -1, -4}, {2, 0, 0}, {0, 2, 0}, white);
    scene.cameras = {look_at({0, 0, 0}, {0, 0, -1}, 30)};
    EXPECT_NEAR(focus_of(scene), 4, 1e-5);
    // Along the axis, from wherever the camera looks.
    scene.cameras = {look_at({0.5f, 3, -1}, {0.5f, 0, -4}, 30)};
    EXPECT_NEAR(focus_of(scene), std::hypot(3, 3), 1e-5);
    scene.cameras = {look_at({0, 0, 0}, {0, 0, 1}, 30)};
    EXPECT_EQ(focus_of(scene), std::numeric_limits<double>::infinity());
}

INSTANTIATE_METHODS(Lens);

} // namespace
} // namespace argand::testing
