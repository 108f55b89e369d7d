// The balance of the photons' flux, summed in fixed point.
#include "rendering.hpp"

#include "photon/photon_map.hpp"
#include "scene/light_power.hpp"
#include "shared/photon.h"
#include "world/world.hpp"

#include <cstdint>

namespace argand::testing {
namespace {

constexpr std::uint32_t unlimited = 0xffff;

struct Traced {
    // Emitted, absorbed, escaped, cut and lost, of three channels each.
    std::array<std::int64_t, flux_words> sums{};
    double unit = 0;
    glm::dvec3 power{0};
    std::uint64_t count = 0;
    std::vector<PhotonRecord> photons; // without empty slots

    glm::dvec3 flux(std::size_t kind) const {
        return glm::dvec3(sums[3 * kind], sums[3 * kind + 1], sums[3 * kind + 2]) * unit;
    }
    glm::dvec3 emitted() const { return flux(0); }
    glm::dvec3 absorbed() const { return flux(1); }
    glm::dvec3 escaped() const { return flux(2); }
    glm::dvec3 cut() const { return flux(3); }
    glm::dvec3 stored() const {
        glm::dvec3 sum(0);
        for (const PhotonRecord& p : photons) {
            sum += glm::dvec3(p.flux_r, p.flux_g, p.flux_b);
        }
        return sum;
    }
    bool balances() const {
        bool balanced = true;
        for (std::size_t channel = 0; channel < 3; ++channel) {
            balanced = balanced && sums[12 + channel] == 0 &&
                       sums[channel] == sums[3 + channel] + sums[6 + channel] + sums[9 + channel];
        }
        return balanced;
    }
};

class Flux : public RenderTest {
protected:
    Traced trace(const Scene& scene, std::uint32_t bounces, std::uint64_t count = 20'000,
                 float follow_roughness = 0.25f) {
        const DeviceScene on_device =
            upload_scene(device(), scene, make_plan(scene, {.follow_roughness = follow_roughness}));
        PhotonWorkspace workspace = make_photon_workspace(device(), count);
        Traced traced;
        traced.power = on_device.light_table.power;
        traced.count = count;
        traced.unit = std::max({traced.power.r, traced.power.g, traced.power.b}) /
                      static_cast<double>(count) / (1 << 18);
        const auto unit = static_cast<float>(traced.unit);
        traced.unit = unit;
        const auto stored = trace_photons(device(), on_device, workspace,
                                          {.seed = 3, .count = count, .bounces = bounces}, unit);
        EXPECT_TRUE(stored.has_value());
        const auto sums = download<std::int64_t>(device(), workspace.flux_sums, 12);
        std::copy(sums.begin(), sums.end(), traced.sums.begin());
        for (const PhotonRecord& p :
             download<PhotonRecord>(device(), workspace.photons, stored ? stored->slots : 0)) {
            if (p.normal != no_photon) {
                traced.photons.push_back(p);
            }
        }
        return traced;
    }
};

void expect_near(const glm::dvec3& actual, const glm::dvec3& expected, double relative) {
    for (int channel = 0; channel < 3; ++channel) {
        EXPECT_RELATIVE(actual[channel], expected[channel], relative) << "channel " << channel;
    }
}

TEST_F(Flux, EmittedIsAbsorbedEscapedOrCutToTheUnit) {
    const Scene scenes[] = {room_scene(),
                            load_asset("cornell_glass.glb"),
                            load_asset("cornell_mirror.glb"),
                            load_asset("courtyard.glb"),
                            load_asset("sky_room.glb"),
                            load_asset("closed_box.gltf"),
                            load_asset("glossy.glb"),
                            load_asset("veil.glb")};
    for (const Scene& scene : scenes) {
        for (const std::uint32_t bounces : {0u, 1u, 2u, unlimited}) {
            SCOPED_TRACE(scene.name + ", " + std::to_string(bounces));
            const Traced traced = trace(scene, bounces, 5000);
            EXPECT_TRUE(traced.balances());
            EXPECT_GT(traced.emitted().g, 0);
            if (bounces == unlimited) {
                EXPECT_EQ(traced.cut(), glm::dvec3(0));
                EXPECT_GT(traced.absorbed().g, 0);
            } else {
                EXPECT_GT(traced.cut().g, 0);
            }
            if (bounces == 0) {
                EXPECT_TRUE(traced.photons.empty());
            }
            // Roulette decides what passes the veil, and its difference is absorbed.
            if (bounces == 0 && scene.name != "veil.glb") {
                EXPECT_EQ(traced.absorbed(), glm::dvec3(0));
            }
        }
    }
}

TEST_F(Flux, NothingEscapesFromAClosedRoom) {
    EXPECT_EQ(trace(room_scene(), unlimited).escaped(), glm::dvec3(0));
}

TEST_F(Flux, BlackRoomAbsorbsWhatIsEmittedAndAWhiteOneNothingUntilItIsCut) {
    Scene scene = box_scene(lambertian(glm::vec3(0)));
    scene.lights = {point_light({0.2f, 0.1f, 0}, {1, 2, 3})};
    const Traced black = trace(scene, unlimited);
    EXPECT_EQ(black.absorbed(), black.emitted());
    scene.materials[0] = lambertian(glm::vec3(1));
    const Traced white = trace(scene, 20);
    EXPECT_TRUE(white.balances());
    expect_near(white.cut(), white.emitted(), 1e-4);
}

Scene white_glossy_room() {
    Material white = lambertian(glm::vec3(1));
    white.specular = 1;
    white.roughness = 0.2f;
    Scene scene = box_scene(white);
    scene.lights = {point_light({0.2f, 0.1f, 0}, glm::vec3(1))};
    return scene;
}

TEST_F(Flux, AWhiteGlossyRoomGainsNothing) {
    const Traced traced = trace(white_glossy_room(), 40);
    EXPECT_TRUE(traced.balances());
    EXPECT_LT(traced.cut().g, 1.01 * traced.emitted().g);
    EXPECT_GT(traced.cut().g, 0.5 * traced.emitted().g);
}

TEST_F(Flux, EmittedIsTheLightsPower) {
    Scene scene = floor_scene(lambertian(glm::vec3(0.5f)), 1);
    const glm::vec3 color(1, 0.5f, 2);
    const double radius = 0.5 * glm::length(glm::vec3(2, 0, 2));
    const auto emitted = [&](const Light& light) {
        scene.lights = {light};
        return trace(scene, 0).emitted();
    };
    const Light point = point_light({0, 1, 0}, color);
    expect_near(emitted(point), emitted_power(point), 1e-5);
    const Light spot = spot_light({0, 1, 0}, {0, -1, 0}, color, 0.3f, 0.6f);
    expect_near(emitted(spot), emitted_power(spot), 1e-5);
    const Light sun = directional_light({0, -1, 0}, color);
    expect_near(emitted(sun), glm::dvec3(color) * double(pi) * radius * radius, 1e-3);

    scene.lights.clear();
    scene.sky = color;
    expect_near(trace(scene, 0).emitted(),
                glm::dvec3(color) * 4.0 * double(pi) * double(pi) * radius * radius, 1e-3);
    scene.sky.reset();
    for (const bool double_sided : {false, true}) {
        scene.materials[0] = emitter(color);
        scene.materials[0].double_sided = double_sided;
        expect_near(trace(scene, 0).emitted(), emitted_power(scene, 0) + emitted_power(scene, 1),
                    1e-5);
    }
}

TEST_F(Flux, PowerIsSharedAmongLights) {
    Scene scene = floor_scene(emitter({1, 1, 1}), 1);
    scene.lights = {point_light({0, 1, 0}, glm::vec3(3)),
                    spot_light({0, 2, 0}, {0, -1, 0}, glm::vec3(9), 0.3f, 0.6f)};
    const glm::dvec3 power = emitted_power(scene, 0) + emitted_power(scene, 1) +
                             emitted_power(scene.lights[0]) + emitted_power(scene.lights[1]);
    // Lights are not chosen in proportion to power, so photons carry different flux.
    expect_near(trace(scene, 0).emitted(), power, 1e-3);
}

TEST_F(Flux, PhotonsOfPointSkyAndSunArriveWhereTheyShould) {
    // The share of a point light's photons that hits a square of known solid angle: a cube's face
    // has 4 pi / 6.
    Scene scene;
    add_quad(scene, {-1, -1, -1}, {2, 0, 0}, {0, 2, 0},
             add_material(scene, lambertian(glm::vec3(0))));
    scene.lights = {point_light({0, 0, 0}, glm::vec3(1))};
    const auto share = [&](double expected) {
        const Traced traced = trace(scene, unlimited);
        const double sigma =
            std::sqrt(expected * (1 - expected) / static_cast<double>(traced.count));
        EXPECT_NEAR(traced.absorbed().g / traced.emitted().g, expected, 5 * sigma);
    };
    share(1.0 / 6);
    // The square (area 4) over the bounding sphere's disc (radius sqrt 2).
    scene.lights = {directional_light({0, 0, -1}, glm::vec3(1))};
    share(4 / (2 * double(pi)));
    // The sky's irradiance pi on both sides of the square, over 4 pi² r².
    scene.lights.clear();
    scene.sky = glm::vec3(1);
    share(2 * 4 * double(pi) / (4 * double(pi) * double(pi) * 2));
}

TEST_F(Flux, StoredAtADepthIsWhatArrivesAtThatDepth) {
    // All surfaces are flat and Lambertian, so every arrival is stored without a weight. Paths do
    // not depend on the limit of bounces: a larger limit only adds photons at the last depth,
    // where paths are truncated.
    const Scene scene = room_scene();
    glm::dvec3 stored_before(0);
    for (std::uint32_t depth = 1; depth <= 4; ++depth) {
        SCOPED_TRACE(depth);
        const Traced traced = trace(scene, depth);
        const glm::dvec3 stored = traced.stored();
        expect_near(stored - stored_before, traced.cut(), 2e-5);
        EXPECT_GT(traced.cut().g, 0);
        stored_before = stored;
    }
}

TEST_F(Flux, StoredFluxIsAGeometricSeriesInAClosedBox) {
    const double albedo = 0.6;
    Scene scene = box_scene(lambertian(glm::vec3(albedo)));
    scene.lights = {point_light({0.1f, 0.3f, -0.2f}, glm::vec3(1))};
    for (std::uint32_t depth = 1; depth <= 5; ++depth) {
        const Traced traced = trace(scene, depth);
        const double arriving = std::pow(albedo, depth);
        // Roulette ends a photon or keeps it.
        const double sigma =
            std::sqrt(arriving * (1 - arriving) / static_cast<double>(traced.count));
        EXPECT_NEAR(traced.cut().g / traced.emitted().g, arriving, 5 * sigma) << depth;
    }
}

TEST_F(Flux, MirrorsAndGlassStoreNothingAndLoseNothing) {
    // In a closed box of mirrors all flux arrives at every depth, and none is stored.
    Scene scene = box_scene(mirror());
    scene.lights = {point_light({0.1f, 0.3f, -0.2f}, glm::vec3(1))};
    const Traced mirrors = trace(scene, 10);
    EXPECT_TRUE(mirrors.photons.empty());
    expect_near(mirrors.cut(), mirrors.emitted(), 1e-5);
    // Glass in a black room: all light that it scatters reaches the walls.
    Scene room = box_scene(lambertian(glm::vec3(0)));
    add_sphere(room, {0.3f, 0, 0}, 0.5f, 8, false, add_material(room, glass(1.5f, true)));
    room.lights = {point_light({-0.5f, 0, 0}, glm::vec3(1))};
    const Traced glasses = trace(room, unlimited);
    EXPECT_EQ(glasses.absorbed(), glasses.emitted());
}

TEST_F(Flux, PhotonsKnowWhetherTheyCameByMirrorsAlone) {
    // A mirror in a room: some photons belong to its caustic, others do not.
    Scene scene = room_scene();
    const auto caustics = [&] {
        const Traced traced = trace(scene, 1);
        std::size_t n = 0;
        for (const PhotonRecord& p : traced.photons) {
            n += photon_is_caustic(p.normal) ? 1 : 0;
        }
        return std::pair(n, traced.photons.size());
    };
    EXPECT_EQ(caustics().first, 0u);
    scene.materials[2] = mirror();
    const auto [caustic, all] = caustics();
    EXPECT_GT(caustic, 0u);
    EXPECT_LT(caustic, all);
}

TEST_F(Flux, RendersReportTheLightsPower) {
    Scene scene = room_scene();
    RenderSettings settings = settings_of("photons", 4, 8);
    settings.photons = 30'000;
    const glm::dvec3 power = emitted_power(scene.lights[0]);
    for (const std::string limit : {"", "storage_range=1MiB"}) {
        Device& limited = open({.name = "limited", .disable = "", .limit = limit});
        const RenderStatistics statistics = testing::render(limited, scene, settings).statistics;
        EXPECT_EQ(statistics.passes > 1, !limit.empty());
        EXPECT_EQ(statistics.photons_emitted, settings.photons);
        for (std::size_t channel = 0; channel < 3; ++channel) {
            const FluxSums& flux = statistics.flux;
            EXPECT_EQ(flux.emitted[channel], flux.absorbed[channel] + flux.escaped[channel] +
                                                 flux.cut[channel] + flux.lost[channel]);
            EXPECT_RELATIVE(static_cast<double>(flux.emitted[channel]) * flux.unit,
                            power[static_cast<int>(channel)], 1e-4);
        }
    }
}

} // namespace
} // namespace argand::testing
