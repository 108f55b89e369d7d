// Layers that describe what camera rays hit first, and the variance of pixels.
#include "rendering.hpp"
#include "session/features.hpp"
#include "world/world.hpp"

#include <cmath>

namespace argand::testing {
namespace {

constexpr FeatureLayers all_layers{.albedo = true, .normal = true, .depth = true, .id = true};

class Features : public RenderTest {
protected:
    std::vector<Layer> features(const Scene& scene, const RenderSettings& settings) {
        World world(device(), scene);
        return render_features(world, scene, settings, all_layers);
    }
};

/// The direction of length 1 along the camera's axis through a place of the picture, in pixels.
glm::dvec3 direction_at(const Camera& camera, int size, double x, double y) {
    const double half = std::tan(0.5 * double(camera.vertical_angle));
    return glm::dvec3(camera.forward) + half * (2 * x / size - 1) * glm::dvec3(camera.right) -
           half * (2 * y / size - 1) * glm::dvec3(camera.up);
}

TEST_F(Features, OfAPlaneAreThoseOfTheFormula) {
    constexpr int size = 13;
    constexpr glm::vec3 color(0.7f, 0.3f, 0.1f);
    Scene scene;
    const glm::dvec3 normal = glm::normalize(glm::dvec3(0.4, 0.2, 1)), point(0.1, 0.3, -5);
    const glm::dvec3 across = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), normal));
    const glm::dvec3 up = glm::cross(normal, across);
    add_quad(scene, glm::vec3(point - 40.0 * across - 40.0 * up), glm::vec3(80.0 * across),
             glm::vec3(80.0 * up), add_material(scene, lambertian(color)));
    scene.objects = {{.node = 6, .name = "plane", .first_triangle = 0}};
    scene.cameras = {look_at({0.5f, 0, 1}, {0, 0.2f, -5}, 50)};
    const std::vector<Layer> layers = features(scene, settings_of("path", size, 5));
    const Image &depth = *find_layer(layers, "depth"), &normals = *find_layer(layers, "normal");
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const auto i = static_cast<std::size_t>(y * size + x);
            const glm::dvec3 d = direction_at(scene.cameras[0], size, x + 0.5, y + 0.5);
            const glm::dvec3 eye(scene.cameras[0].position);
            EXPECT_RELATIVE(depth.pixels[i].x, glm::dot(point - eye, normal) / glm::dot(d, normal),
                            1e-5);
            EXPECT_NEAR(glm::distance(glm::dvec3(normals.pixels[i]), normal), 0, 1e-6);
            EXPECT_NEAR(glm::distance(find_layer(layers, "albedo")->pixels[i], color), 0, 1e-6);
            EXPECT_EQ(find_layer(layers, "id")->pixels[i].x, 7);
        }
    }
}

TEST_F(Features, OfASphereAreThoseOfTheFormula) {
    constexpr int size = 32;
    constexpr glm::dvec3 center(0, 0, -4);
    Scene scene;
    add_quad(scene, {-1, -3, -9}, {1, 0, 0}, {0, 1, 0}, add_material(scene, lambertian({0, 1, 0})));
    add_sphere(scene, glm::vec3(center), 1, 96, true,
               add_material(scene, lambertian({0.2f, 0.4f, 0.6f})));
    scene.objects = {{.node = 1, .name = "quad", .first_triangle = 0},
                     {.node = 3, .name = "sphere", .first_triangle = 2}};
    scene.cameras = {look_at({0, 0, 0}, {0, 0, -1}, 45)};
    const std::vector<Layer> layers = features(scene, settings_of("path", size, 16));
    int inside = 0, outside = 0;
    for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
            const auto i = static_cast<std::size_t>(y * size + x);
            const glm::dvec3 d = direction_at(scene.cameras[0], size, x + 0.5, y + 0.5);
            const double a = glm::dot(d, d), b = glm::dot(d, center);
            const double root = b * b - a * (glm::dot(center, center) - 1);
            const float id = find_layer(layers, "id")->pixels[i].x;
            const float depth = find_layer(layers, "depth")->pixels[i].x;
            if (root > 0.1) { // clear of the silhouette, which has facets
                const double t = (b - std::sqrt(root)) / a;
                EXPECT_RELATIVE(depth, t, 1e-3);
                EXPECT_EQ(id, 4);
                // A pixel's mean of normals differs from the one in its middle by the curvature.
                EXPECT_LT(glm::distance(glm::dvec3(find_layer(layers, "normal")->pixels[i]),
                                        t * d - center),
                          0.02);
                ++inside;
            } else if (root < -0.5 && y < size / 2) {
                EXPECT_EQ(id, 0);
                EXPECT_EQ(depth, std::numeric_limits<float>::infinity());
                EXPECT_EQ(find_layer(layers, "albedo")->pixels[i], glm::vec3(0));
                EXPECT_EQ(find_layer(layers, "normal")->pixels[i], glm::vec3(0));
                ++outside;
            }
        }
    }
    EXPECT_GT(inside, 200);
    EXPECT_GT(outside, 100);
}

TEST_F(Features, FollowTheCropAndTheFilterAndAnEdgeIsTheShareOfItsSamples) {
    Scene scene;
    add_quad(scene, {-4, -4, 0}, {4.1f, 0, 0}, {0, 8, 0},
             add_material(scene, lambertian(glm::vec3(0.5f))));
    scene.cameras = {parallel_rays({0, 0, 1}, {0, 0, 0}, 1)};
    RenderSettings settings = settings_of("path", 8, 64);
    const std::vector<Layer> whole = features(scene, settings);
    const Image& albedo = *find_layer(whole, "albedo");
    // The edge at 0.1 leaves 0.4 of the pixels from 0 to 0.25.
    EXPECT_NEAR(mean(albedo, 4, 0, 5, 8).g, 0.5 * 0.4, 0.005);
    settings.crop = CropRectangle{3, 2, 6, 7};
    const std::vector<Layer> part = features(scene, settings);
    for (const Layer& layer : part) {
        ASSERT_EQ(layer.image.width, 3);
        ASSERT_EQ(layer.image.height, 5);
        for (int i = 0; i < 15; ++i) {
            const int in_whole = (2 + i / 3) * 8 + 3 + i % 3;
            EXPECT_EQ(layer.image.pixels[static_cast<std::size_t>(i)],
                      find_layer(whole, layer.name)->pixels[static_cast<std::size_t>(in_whole)]);
        }
    }
    settings.crop.reset();
    settings.filter = PixelFilter::blackman_harris;
    const std::vector<Layer> filtered = features(scene, settings);
    EXPECT_EQ(mean(albedo, 3, 0, 4, 8).g, 0.5);
    EXPECT_LT(mean(*find_layer(filtered, "albedo"), 3, 0, 4, 8).g, 0.4999);
}

class Variance : public EveryMethod {};

// The scatter of repeated pictures says how far each of them may be off; the layer says so from one
// picture.
TEST_P(Variance, AgreesWithThatOfRepeatedPictures) {
    constexpr int size = 4, repetitions = 12;
    const Scene scene = room_scene();
    RenderSettings settings = settings_of(GetParam(), size, 8);
    settings.photons = 2000;
    settings.variance = true;
    settings.least_passes = 8;
    std::vector<glm::dvec3> sums(size * size, glm::dvec3(0)), squares(size * size, glm::dvec3(0));
    double told = 0;
    for (int i = 0; i < repetitions; ++i) {
        settings.seed = static_cast<std::uint32_t>(i);
        const RenderResult result = render(scene, settings);
        told += mean(layer(result, "variance")).g / repetitions;
        for (std::size_t p = 0; p < sums.size(); ++p) {
            const glm::dvec3 pixel(layer(result, "").pixels[p]);
            sums[p] += pixel;
            squares[p] += pixel * pixel;
        }
    }
    double scatter = 0;
    for (std::size_t p = 0; p < sums.size(); ++p) {
        const double m = sums[p].g / repetitions;
        scatter += (squares[p].g / repetitions - m * m) * repetitions / (repetitions - 1) /
                   static_cast<double>(sums.size());
    }
    // Sobol' points make the mean better than independent passes would. Twelve pictures tell a
    // variance within a factor of 2.
    EXPECT_LT(scatter, 2.5 * told);
    EXPECT_GT(scatter, 0.1 * told);
}

// With one sample a pass, the passes are single samples, each of which is like any other: the
// picture of one sample, repeated, has n times the variance of the mean of n independent ones.
TEST_F(Features, VarianceIsThatOfSingleSamplesOverTheirNumber) {
    constexpr int size = 4, repetitions = 400;
    constexpr std::uint32_t samples = 64;
    const Scene scene = room_scene();
    RenderSettings settings = settings_of("path", size, 1);
    World world(device(), scene);
    const auto render_in = [&](const RenderSettings& s) {
        return argand::render(world, scene, s, [](double) { return true; });
    };
    double sum = 0, told = 0;
    std::vector<double> sums(size * size), squares(size * size);
    for (int i = 0; i < repetitions; ++i) {
        settings.seed = static_cast<std::uint32_t>(1000 + i);
        const RenderResult result = render_in(settings);
        for (std::size_t p = 0; p < sums.size(); ++p) {
            const double g = layer(result, "").pixels[p].g;
            sums[p] += g;
            squares[p] += g * g;
        }
    }
    for (std::size_t p = 0; p < sums.size(); ++p) {
        sum += (squares[p] - sums[p] * sums[p] / repetitions) / (repetitions - 1) / (size * size);
    }
    settings.samples = samples;
    settings.least_passes = samples;
    settings.variance = true;
    constexpr int pictures = 8;
    for (int i = 0; i < pictures; ++i) {
        settings.seed = static_cast<std::uint32_t>(i);
        const RenderResult result = render_in(settings);
        told += mean(layer(result, "variance")).g * samples / pictures;
    }
    EXPECT_RELATIVE(told, sum, 0.1);
}

TEST_F(Features, APictureWithVarianceHasTheSameBits) {
    const Scene scene = room_scene();
    RenderSettings settings = settings_of("path", 7, 9);
    const RenderResult plain = render(scene, settings);
    settings.variance = true;
    settings.least_passes = 4;
    RenderResult result = render(scene, settings);
    ASSERT_EQ(result.layers.back().name, "variance");
    result.layers.pop_back();
    EXPECT_TRUE(same_bits(plain, result));
}

INSTANTIATE_METHODS(Variance);

} // namespace
} // namespace argand::testing
