// Solids in one another, against the closed formula of a stack of slabs.
#include "rendering.hpp"

#include <vector>

namespace argand::testing {
namespace {

constexpr double water_index = 1.33, glass_index = 1.5, absorption = 0.4;

/// A layer of a stack, from above.
struct Slab {
    double index = 1, thickness = 0, absorption = 0;
};

/// Reflectance for unpolarised light that comes from index n1 to n2 at these cosines.
double fresnel(double n1, double cosine1, double n2, double cosine2) {
    const double s = (n1 * cosine1 - n2 * cosine2) / (n1 * cosine1 + n2 * cosine2);
    const double p = (n1 * cosine2 - n2 * cosine1) / (n1 * cosine2 + n2 * cosine1);
    return (s * s + p * p) / 2;
}

/// Part of the light that passes slabs between air and air, with all reflections in between. They
/// do not interfere.
double transmitted(const std::vector<Slab>& slabs, double sine) {
    const auto cosine = [&](double n) { return std::sqrt(1 - sine * sine / (n * n)); };
    double passed = 1, reflected_up = 0; // by what is above, for light from below
    double index = 1, on_way = 1;        // of the slab above
    for (std::size_t i = 0; i <= slabs.size(); ++i) {
        const Slab below = i < slabs.size() ? slabs[i] : Slab{};
        const double r = fresnel(index, cosine(index), below.index, cosine(below.index));
        const double again = 1 - reflected_up * on_way * on_way * r;
        reflected_up = r + (1 - r) * (1 - r) * on_way * on_way * reflected_up / again;
        passed *= on_way * (1 - r) / again;
        index = below.index;
        on_way = std::exp(-below.absorption * below.thickness / cosine(below.index));
    }
    return passed;
}

struct Case {
    const char* name;
    glm::vec2 water, glass; // heights of their lower and upper sides
    float priority;         // of the water
    std::vector<Slab> slabs;
};

const Slab glass_slab{glass_index, 1, 0};
Slab water_slab(double thickness) { return {water_index, thickness, absorption}; }

const std::vector<Case> cases = {
    {"the glass keeps its shape", {-1.5f, 0.3f}, {0, 1}, 0, {glass_slab, water_slab(1.5)}},
    {"the water keeps its shape", {-1.5f, 0.3f}, {0, 1}, 1, {glass_slab, water_slab(1.8)}},
    {"a slab in water",
     {-1.5f, 1.5f},
     {-0.5f, 0.5f},
     0,
     {water_slab(1), glass_slab, water_slab(1)}},
    {"a slab that water displaces", {-1.5f, 1.5f}, {-0.5f, 0.5f}, 1, {water_slab(3)}},
    {"slabs apart", {-1.5f, -0.5f}, {0, 1}, 0, {glass_slab, {}, water_slab(1)}},
};

void add_slab(Scene& scene, glm::vec2 heights, float half, const Material& material) {
    add_box(scene, {-half, heights.x, -half}, {half, heights.y, half},
            add_material(scene, material), false);
}

void add_slabs(Scene& scene, const Case& c, float half) {
    Material water = glass(float(water_index), true);
    water.absorption = glm::vec3(float(absorption));
    water.priority = c.priority;
    add_slab(scene, c.water, half, water);
    add_slab(scene, c.glass, half, glass(float(glass_index), true));
}

class Nested : public EveryMethod {
protected:
    RenderSettings settings(std::uint32_t samples, std::uint64_t photons) const {
        RenderSettings s = settings_of(GetParam(), 8, samples);
        s.photons = photons;
        s.bounces = 64;
        return s;
    }
};

TEST_P(Nested, SlabsShowWhatIsBehindThem) {
    for (const Case& c : cases) {
        for (const double degrees : {0.0, 60.0}) {
            SCOPED_TRACE(::testing::Message() << c.name << ", " << degrees << "°");
            Scene scene;
            add_slabs(scene, c, 40);
            add_quad(scene, {-200, -3, 200}, {400, 0, 0}, {0, 0, -400},
                     add_material(scene, emitter(glm::vec3(1))));
            const glm::vec3 from(3 * std::tan(glm::radians(float(degrees))), 5, 0);
            const double seen = radiance(scene, settings(256, 1000), from, {0, 2, 0}, "direct").r;
            EXPECT_NEAR(seen, transmitted(c.slabs, std::sin(glm::radians(degrees))), 0.012);
        }
    }
}

// Estimates share these photons.
TEST_F(RenderTest, SlowPhotonsPassNestedSlabs) {
    RenderSettings settings = settings_of("photons", 2, 4);
    settings.photons = 200'000;
    settings.radius = 0.5;
    settings.bounces = 64;
    const int seeds = 4;
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        Scene scene;
        add_slabs(scene, c, 1);
        add_floor(scene, 0.9f, -3, add_material(scene, lambertian(glm::vec3(0.5f))));
        scene.lights = {directional_light({0, -1, 0}, glm::vec3(1))};
        scene.cameras = {parallel_rays({0, -2, 0.1f}, {0, -3, 0}, 0.1f)};
        double found = 0;
        for (int seed = 0; seed < seeds; ++seed) {
            settings.seed = std::uint64_t(seed);
            const RenderResult result = render(scene, settings);
            found += mean(layer(result, "caustic")).r / seeds;
            const auto& flux = result.statistics.flux;
            EXPECT_EQ(flux.emitted[0],
                      flux.absorbed[0] + flux.escaped[0] + flux.cut[0] + flux.lost[0]);
        }
        // A seed has a noise of 2 %.
        EXPECT_RELATIVE(found, 0.5 / pi * transmitted(c.slabs, 0), 0.04);
    }
}

INSTANTIATE_ESTIMATES(Nested);

} // namespace
} // namespace argand::testing
